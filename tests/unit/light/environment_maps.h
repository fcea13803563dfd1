/// Environment maps written to a scratch folder for tests.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tyndall/io.h"

namespace tyndall::test {

/// A file that is removed at the end of the scope.
class ScratchMap {
 public:
  ScratchMap(const std::string& name, int width, int height, const std::function<Rgb(int, int)>& texel)
      : path_((std::filesystem::temp_directory_path() / ("tyndall_light_test_" + name + ".exr")).string()) {
    Image image;
    image.data = image.display = {0, 0, width, height};
    for (const char* c : {"R", "G", "B"}) image.add_channel(c);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Rgb value = texel(x, y);
        for (int c = 0; c < 3; ++c)
          image.channels[static_cast<std::size_t>(c)].values[static_cast<std::size_t>(y * width + x)] = value[c];
      }
    write_exr(image, path_);
  }
  ~ScratchMap() { std::filesystem::remove(path_); }
  ScratchMap(const ScratchMap&) = delete;
  ScratchMap& operator=(const ScratchMap&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace tyndall::test
