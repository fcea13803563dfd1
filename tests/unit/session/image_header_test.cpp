#include "session/image_header.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "tyndall/image_attributes.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall {
namespace {

TEST_CASE("the text of the options is as typed, and tells the nearest of settings apart") {
  RenderSettings s;
  s.splitting = 0.7f;
  CHECK(options_text(s).ends_with(" --splitting 0.7"));
  s.shadow_rays = 1;
  CHECK(options_text(s).ends_with(" --splitting 0.7 --shadow-rays 1"));
  for (const float splitting : {0.5f, 0.7f, 1e-3f, 0.1234567f}) {
    RenderSettings a, b;
    a.splitting = splitting;
    b.splitting = std::nextafter(splitting, 1.0f);
    CHECK(options_text(a) != options_text(b));
  }
}

TEST_CASE("an image tells what it was to end by") {
  const World world = build(read_scene_text("Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 Camera "
                                            "\"perspective\" WorldBegin LightSource \"point\" Shape \"sphere\"",
                                            "a.pbrt", ".")
                                .scene,
                            {});
  const auto rendered = [&](const RenderSettings& s) { return render(world, s).image; };
  RenderSettings plain, timed, better, both;
  plain.spp = timed.spp = better.spp = both.spp = 2;
  timed.time = both.time = 1000;
  better.error = 0.5;
  both.error_max = 0.25;
  const std::array all{plain, timed, better, both};
  for (const RenderSettings& s : all) {
    const Image image = rendered(s);
    for (const RenderSettings& other : all) CHECK(says_end(image, other) == (&s == &other));
  }
  CHECK_FALSE(rendered(plain).attributes.contains(attributes::kEnd));
  CHECK(std::get<std::string>(rendered(both).attributes.at(attributes::kEnd)) == "--time 1000 --error-max 0.25 --spp 2");
}

TEST_CASE("no matrix takes the world to the frame of a spherical or a realistic camera") {
  const std::string lenses = "\"realistic\" \"string lensfile\" \"" TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/lens/double.dat\"";
  for (const std::string& camera : {std::string("\"perspective\""), std::string("\"spherical\""), lenses}) {
    const std::string text =
        "Film \"rgb\" \"integer xresolution\" 2 \"integer yresolution\" 2 Camera " + camera + " WorldBegin Shape \"sphere\"";
    const Image image = render(build(read_scene_text(text, "a.pbrt", ".").scene), {.spp = 1}).image;
    CHECK(image.attributes.contains("worldToCamera"));
    CHECK(image.attributes.contains("worldToNDC") == (camera == "\"perspective\""));
  }
}

}  // namespace
}  // namespace tyndall
