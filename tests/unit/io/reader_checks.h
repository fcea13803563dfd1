/// Short ways to read scene texts in tests.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "tyndall/io.h"

namespace tyndall::test {

inline Scene read(const std::string& text) { return read_scene_text(text, "test.pbrt").scene; }

/// Reads `body` as the text after WorldBegin; it begins in line 1 of "test.pbrt".
inline SceneFile read_world_file(const std::string& body) { return read_scene_text("WorldBegin " + body, "test.pbrt"); }
inline std::size_t world_warnings(const std::string& body) { return read_world_file(body).warnings.size(); }
inline Scene read_world(const std::string& body) { return read_world_file(body).scene; }

template <typename Read>
std::string message_of(Read read) {
  try {
    read();
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::scene);
    return e.what();
  }
  return "no error";
}

inline std::string error_of(const std::string& text) {
  return message_of([&] { read_scene_text(text, "test.pbrt"); });
}
inline std::string world_error(const std::string& body) {
  return message_of([&] { read_world(body); });
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

#define CHECK_CONTAINS(text, part)                           \
  do {                                                       \
    const std::string contains_text = (text);                \
    INFO(contains_text);                                     \
    CHECK(::tyndall::test::contains(contains_text, (part))); \
  } while (false)

inline Rgb constant(const Scene& scene, TextureId id) { return std::get<ConstantTexture>(scene.textures.at(id).kind).value; }
inline const Material& last_material(const Scene& scene) { return scene.materials.back(); }

/// A folder that goes away with the object.
class TempFolder {
 public:
  TempFolder() {
    char name[] = "/tmp/tyndall_io_XXXXXX";
    REQUIRE(mkdtemp(name) != nullptr);
    path_ = name;
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = std::filesystem::path(path_) / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file.string();
  }

 private:
  std::string path_;
};

}  // namespace tyndall::test
