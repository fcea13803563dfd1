/// Paths that share what they find behind panes, against paths that do not.
#include <doctest/doctest.h>

#include "support/sharing.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

std::string pane(const std::string& corners, const std::string& eta) {
  return block("Material \"thindielectric\" \"float eta\" " + eta + "\nShape \"bilinearmesh\" \"point3 P\" [" + corners +
               "]\n");
}

/// With a window of a quarter of the end wall, some of which has panes, one behind the other.
std::string glazed_room() {
  return sharing_sides() + sharing_things() + sharing_wall("0.5 0.5 0.6", "-2 -1.8 2  0 -1.8 2  -2 1.8 2  0 1.8 2") +
         sharing_wall("0.5 0.5 0.6", "0 -1.8 2  2 -1.8 2  0 0 2  2 0 2") +
         pane("-0.3 -0.2 2.1  1.3 -0.2 2  -0.3 2 2  1.3 2 1.9", "2") +
         pane("0.4 -0.2 1.7  2 -0.2 1.7  0.4 2 1.7  2 2 1.7", "1.5");
}

/// A ceiling of rough metal below the other, beyond z = 0.3.
std::string metal_ceiling() {
  return block(
      "Material \"conductor\" \"float roughness\" 0.25\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-2 1.7 0.3  2 1.7 0.3  -2 1.7 2  2 1.7 2]\n");
}

/// By a pane, which a smaller one stands before. The point in the other half is seen through none: all that comes from there
/// has been scattered there.
std::string divided_room() {
  return sharing_sides() + sharing_end(2) + sharing_end(-4) + metal_ceiling() +
         pane("-2 -1.8 0.2  1.2 -1.8 -0.2  -2 1.8 0.2  1.2 1.8 -0.2", "2.2") +
         pane("-1 -1 -0.5  0.4 -1 -0.5  -1 0.6 -0.6  0.4 0.6 -0.6", "1.5") + point_light({0.2f, 0.2f, 1}, 3);
}

/// Green hardly comes through: what flights weigh differs by channel.
const Coefficients kFog{.sigma_a = {0.02f, 0.6f, 0.1f}, .sigma_s = {0.1f, 0.05f, 0.08f}, .g = 0.4f};

std::string fog() { return homogeneous("f", kFog) + medium_box("f", "", {{-3, -3, -5}, {3, 3, 3}}); }

const Coefficients kSmoke{.sigma_a = {0.02f, 0.4f, 1.5f}, .sigma_s = {1.5f, 1, 0.7f}, .g = 0.3f};

}  // namespace

// Two bounces are enough for a direction through one pane: who is behind two finds nothing in it.
TEST_CASE("sharing what lies behind panes changes the noise alone: a sky behind a window") {
  check_sharing("two bounces", sharing_camera(2) + glazed_room() + environment(1), {}, 2);
  check_sharing("four bounces", sharing_camera(4) + glazed_room() + environment(1), {}, 2);
  check_sharing("in fog", sharing_camera(4) + glazed_room() + environment(1) + fog(), {}, 2.5);
}

TEST_CASE("sharing what lies behind panes changes the noise alone: a room beyond one") {
  check_sharing("surfaces", sharing_camera(5) + divided_room(), {}, 1.4);
  check_sharing("few bounces", sharing_camera(3) + divided_room(), {}, 1.4);
  check_sharing("in fog", sharing_camera(5) + divided_room() + fog(), {}, 0.9);
  check_sharing("in smoke", sharing_camera(5) + divided_room() + sharing_smoke(kSmoke), {}, 1.5);
}
