/// Sequences: names of files that hold the number of a frame, and what is kept from one frame to the next.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tyndall {

/// Whether `name` holds a place for a frame's number: printf's %d and %04d, or $F and $F4 as Houdini writes them.
bool names_frame(std::string_view name);
/// `name` with `frame` in those places, filled with zeros to the width that they ask for.
std::string with_frame(std::string_view name, int frame);
/// "1-48,60": runs of three and more with a dash.
std::string frames_text(const std::vector<int>& frames);

/// What was made of files, for the next scene that names them: pass the same one to what reads and builds the scenes of a
/// sequence (SceneReading, BuildSettings). A file that was written to is read again. For one thread at a time.
class KeptFiles {
 public:
  /// What a file is made to. Two uses of a file stand beside each other; of one use, the last `details` alone are kept.
  struct Use {
    std::string path, name, details{};
  };

  /// What `make` gave for this use of the file as it is now; calls `make` when there is no such thing.
  template <typename T>
  std::shared_ptr<const T> get(const Use& use, const std::function<T()>& make) {
    return std::static_pointer_cast<const T>(find_or_make(use, [&] { return std::make_shared<const T>(make()); }));
  }

  void begin_scene();  ///< from here on, what is asked for belongs to the next scene
  void drop_others();  ///< forgets all files that were not asked for since begin_scene()

  std::size_t made() const { return made_; }      ///< times that a file was read and made to something
  std::size_t reused() const { return reused_; }  ///< times that this was not needed

 private:
  using Made = std::shared_ptr<const void>;
  struct Entry {
    std::string stamp;  ///< of the file, and the details
    Made made;
  };
  Made find_or_make(const Use& use, const std::function<Made()>& make);

  std::map<std::pair<std::string, std::string>, Entry> entries_;  ///< by path and name of the use
  std::set<std::string> wanted_;                                  ///< paths asked for since begin_scene()
  std::size_t made_ = 0, reused_ = 0;
};

/// kept->get(), or without any what `make` gives.
template <typename T>
std::shared_ptr<const T> get_kept(KeptFiles* kept, const KeptFiles::Use& use, const std::function<T()>& make) {
  return kept ? kept->get<T>(use, make) : std::make_shared<const T>(make());
}

}  // namespace tyndall
