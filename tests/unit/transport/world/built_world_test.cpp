#include <doctest/doctest.h>

#include "support/scene_text.h"
#include "tyndall/error.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall {
namespace {

std::string trouble_with(Scene scene) {
  try {
    build(std::move(scene));
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("media that a scene does not have are refused, at boundaries and around the camera") {
  const Scene fog = read_scene_text("WorldBegin\n" + test::homogeneous("m", {.sigma_s = Rgb(1)}) +
                                        test::medium_box("m", "", {{-1, -1, -1}, {1, 1, 1}}),
                                    "fog.pbrt")
                        .scene;
  CHECK(trouble_with(fog).empty());
  Scene within = fog, without = fog, around = fog;
  within.boundaries.at(0).inside = 1;
  without.boundaries.at(0).outside = 99;
  around.camera.medium = 7;
  CHECK(trouble_with(within).find("boundary's medium does not exist") != std::string::npos);
  CHECK(trouble_with(without).find("boundary's medium does not exist") != std::string::npos);
  CHECK(trouble_with(around).find("camera's medium does not exist") != std::string::npos);
}

}  // namespace tyndall
