// Names of files that hold the number of a frame, and scenes that have them.
#include <doctest/doctest.h>

#include "support/scratch.h"
#include "tyndall/frames.h"
#include "unit/io/reader_checks.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("printf's and Houdini's places are filled, to the width that they ask for") {
  const std::pair<const char*, const char*> cases[] = {{"a.%04d.vdb", "a.0042.vdb"}, {"a.%d", "a.42"},
                                                       {"%03d/%d", "042/42"},        {"a%1d", "a42"},
                                                       {"a.$F4.vdb", "a.0042.vdb"},  {"$F/smoke_$F2", "42/smoke_42"},
                                                       {"x%12d", "x000000000042"}};
  for (const auto& [name, filled] : cases) {
    CHECK_MESSAGE(names_frame(name), name);
    CHECK(with_frame(name, 42) == filled);
  }
  CHECK(with_frame("a.%04d", 123456) == "a.123456");
}

TEST_CASE("other uses of the characters stay") {
  for (const char* name : {"a.vdb", "100%", "%s", "%04x", "%0", "%", "$", "$FF", "$Final", "$F_x", "%123d", "$HIP/a", "$f4"}) {
    CHECK_MESSAGE(!names_frame(name), name);
    CHECK(with_frame(name, 7) == name);
  }
}

TEST_CASE("frames are listed with runs of three and more") {
  CHECK(frames_text({}) == "");
  CHECK(frames_text({1, 2, 3, 4}) == "1-4");
  CHECK(frames_text({1, 2, 5, 10, 11, 12}) == "1,2,5,10-12");
  CHECK(frames_text({3, 2, 1}) == "3,2,1");
}

namespace {

const char* const kMap = R"(WorldBegin Texture "t" "spectrum" "imagemap" "string filename" "map.%03d.png")";

std::string path_of(const SceneFile& file) { return std::get<ImageTexture>(file.scene.textures.back().kind).path; }

}  // namespace

TEST_CASE("a scene of a frame names the files of that frame") {
  const Scratch folder;
  write_bytes(folder / "s.pbrt", kMap);
  write_bytes(folder / "map.005.png", "");
  const SceneFile file = read_scene(folder / "s.pbrt", {.frame = 5});
  CHECK(path_of(file) == folder / "map.005.png");
  REQUIRE(file.frame_names.size() == 1);
  CHECK(file.frame_names[0].name == "map.%03d.png");
  CHECK_FALSE(file.frame_names[0].holds_scene);
  CHECK_CONTAINS(message_of([&] { read_scene(folder / "s.pbrt", {.frame = 6}); }), "\"map.006.png\" does not exist");
  CHECK_CONTAINS(message_of([&] { read_scene(folder / "s.pbrt"); }), "--frames");
  // Without a frame such a name is one like others.
  write_bytes(folder / "map.%03d.png", "");
  const SceneFile plain = read_scene(folder / "s.pbrt");
  CHECK(path_of(plain) == folder / "map.%03d.png");
  CHECK(plain.frame_names.empty());
}

TEST_CASE("what another frame lacks is found with its place, in included files too") {
  const Scratch folder;
  write_bytes(folder / "s.pbrt", std::string("WorldBegin\nInclude \"part.$F.pbrt\"\n"));
  const std::string part = std::string(kMap).substr(11);
  for (const char* frame : {"1", "2"}) write_bytes(folder / ("part." + std::string(frame) + ".pbrt"), part);
  write_bytes(folder / "map.001.png", "");
  const SceneFile file = read_scene(folder / "s.pbrt", {.frame = 1});
  CHECK(file.frame_names.size() == 2);
  require_frame(file, folder / "s.pbrt", 1);
  const std::string lacking = message_of([&] { require_frame(file, folder / "s.pbrt", 2); });
  CHECK_CONTAINS(lacking, "map.002.png");
  CHECK_CONTAINS(lacking, "frame 2");
  CHECK_CONTAINS(message_of([&] { require_frame(file, folder / "s.pbrt", 3); }), "s.pbrt:2:9: file \"part.3.pbrt\"");
  // An included file of another frame may name files of its own.
  write_bytes(folder / "part.2.pbrt", R"(Texture "t" "spectrum" "imagemap" "string filename" "other.png")");
  write_bytes(folder / "map.002.png", "");
  CHECK_CONTAINS(message_of([&] { require_frame(file, folder / "s.pbrt", 2); }), "other.png");
}
