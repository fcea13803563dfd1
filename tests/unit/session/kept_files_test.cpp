// Scenes of a sequence, built one after the other: what they share is read once, and the pictures keep their bits.
#include <doctest/doctest.h>

#include <filesystem>

#include "support/scratch.h"
#include "tyndall/frames.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Smoke of a file a frame; a mesh, a texture, an environment and a projected picture that are always the same.
const char* const kScene = R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 0 1 -4  0 0.5 0  0 1 0
Camera "perspective" "float fov" 45
WorldBegin
LightSource "infinite" "string filename" "sky.exr"
LightSource "projection" "string filename" "sky.exr" "float scale" 3
Texture "t" "spectrum" "imagemap" "string filename" "sky.exr"
Material "diffuse" "texture reflectance" "t"
Shape "plymesh" "string filename" "floor.ply"
MakeNamedMedium "m" "string type" "nanovdb" "string filename" "smoke.%02d.vdb" "rgb sigma_s" [3 3 3]
Material "interface"
MediumInterface "m" ""
Scale 0.2 0.2 0.2
Shape "sphere" "float radius" 10
)";

class Shot {
 public:
  Shot() {
    namespace fs = std::filesystem;
    write_bytes(folder_ / "shot.pbrt", kScene);
    const std::string volumes = std::string(TYNDALL_SOURCE_DIR) + "/volumes/mantaflow_smoke/mantaflow_smoke_00";
    fs::copy_file(volumes + "25.vdb", folder_ / "smoke.01.vdb");
    fs::copy_file(volumes + "50.vdb", folder_ / "smoke.02.vdb");
    fs::create_hard_link(folder_ / "smoke.02.vdb", folder_ / "smoke.03.vdb");
    TriangleMesh floor;
    floor.positions = {{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}};
    floor.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    floor.indices = {0, 1, 2, 0, 2, 3};
    write_file(encode_ply(floor), folder_ / "floor.ply");
    Image sky;
    sky.data = sky.display = {0, 0, 4, 4};
    for (const char* name : {"R", "G", "B"}) sky.add_channel(name).values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 3, 4, 5, 6, 7};
    write_exr(sky, folder_ / "sky.exr");
  }

  World build_frame(int frame, KeptFiles* kept) const {
    if (kept) kept->begin_scene();
    Scene scene = read_scene(folder_ / "shot.pbrt", {.frame = frame, .kept = kept}).scene;
    return build(std::move(scene), {.kept = kept});
  }
  Image render_frame(int frame, KeptFiles* kept) const {
    return render(build_frame(frame, kept), {.spp = 2, .threads = 1}).image;
  }
  const Scratch& folder() const { return folder_; }

 private:
  Scratch folder_;
};

/// Uses of files: the hashes of the sky, the smoke; mesh, texture, light (the environment's), projection, medium.
constexpr std::size_t kUses = 7, kUsesOfSmoke = 2;

}  // namespace

TEST_CASE("frames share what their files hold, and nothing but the new file is read") {
  const Shot shot;
  KeptFiles kept;
  shot.build_frame(1, &kept);
  CHECK(kept.made() == kUses);
  shot.build_frame(2, &kept);
  CHECK(kept.made() == kUses + kUsesOfSmoke);
  CHECK(kept.reused() == kUses - kUsesOfSmoke);
  shot.build_frame(2, &kept);
  CHECK(kept.made() == kUses + kUsesOfSmoke);
  // Frame 1's smoke was forgotten when frame 2 came.
  shot.build_frame(1, &kept);
  CHECK(kept.made() == kUses + 2 * kUsesOfSmoke);
}

TEST_CASE("pictures of kept files have the bits of those read anew") {
  const Shot shot;
  KeptFiles kept;
  for (const int frame : {1, 2, 2, 1}) {
    const Image with = shot.render_frame(frame, &kept), without = shot.render_frame(frame, nullptr);
    REQUIRE(with.channels.size() == without.channels.size());
    for (std::size_t i = 0; i < with.channels.size(); ++i) CHECK(with.channels[i].values == without.channels[i].values);
    CHECK(std::get<std::string>(with.attributes.at("tyndall/sceneHash")) ==
          std::get<std::string>(without.attributes.at("tyndall/sceneHash")));
  }
}

TEST_CASE("a medium whose coefficients or place change is made anew from its file") {
  const Shot shot;
  KeptFiles kept;
  for (const auto& [from, to] : {std::pair("[3 3 3]", "[4 3 3]"), {"MakeNamed", "Scale 1 1 0.9 MakeNamed"}}) {
    write_bytes(shot.folder() / "shot.pbrt", kScene);
    shot.build_frame(1, &kept);
    std::string text = kScene;
    write_bytes(shot.folder() / "shot.pbrt", text.replace(text.find(from), std::string(from).size(), to));
    const std::size_t made = kept.made();
    const Image with = shot.render_frame(1, &kept), without = shot.render_frame(1, nullptr);
    CHECK(kept.made() == made + 1);
    CHECK(with.find("R")->values == without.find("R")->values);
  }
}

TEST_CASE("a build says of a kept medium what it said when it was read") {
  const Shot shot;
  KeptFiles kept;
  const World first = shot.build_frame(1, &kept), again = shot.build_frame(1, &kept);
  CHECK_FALSE(first.summary().notes.empty());
  CHECK(first.summary().notes == again.summary().notes);
  CHECK(first.summary().volume_bytes == again.summary().volume_bytes);
}
