/// Paths that share what they find by mirrors, panes, metals, coats and veils, against paths that do not.
///
/// Pixels that share are not independent, so errors come from the spread between renders of whole blocks.
#include <doctest/doctest.h>

#include "support/measure.h"
#include "support/sharing.h"

using namespace tyndall;
using namespace tyndall::test;

// What mirrors and panes show is shared as what the camera sees: dark mirrors, whose paths roulette may end, bright ones behind
// fog that neighbours receive all along their rays as well, and panes that some rays pass and others do not.
TEST_CASE("sharing changes the noise alone: mirrors, and a room behind a pane") {
  const auto mirror = [](const std::string& rgb) {
    return block("Material \"conductor\" \"rgb reflectance\" [" + rgb +
                 "] \"float roughness\" 0\n"
                 "Shape \"bilinearmesh\" \"point3 P\" [-1.6 -1 1.9  1.2 -1 1.4  -1.6 1.4 1.9  1.2 1.4 1.4]\n");
  };
  const std::string pane = block(
      "Material \"thindielectric\" \"float eta\" 2.2\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-3 -3 -3.2  3 -3 -3.4  -3 3 -3.2  3 3 -3.4]\n");
  // Points alone: no light comes to walls by mirrors, where it would be rare and bright.
  const std::string lit = sharing_unlit_room() + point_light({-1.7f, 1.2f, 1.1f}, 3) + point_light({1.2f, -1, 0.6f}, 0.4f);
  const std::string dark = lit + mirror("0.3 0.2 0.25"), bright = lit + mirror("0.9 0.95 1");
  check_sharing("mirror", sharing_camera(3, 30) + dark, {}, 1.5);
  check_sharing("pane", sharing_camera(6) + dark + pane, {}, 1.3);
  const std::string fog = homogeneous("m", sharing_thin_fog()) + medium_box("m", "", {{-3, -3, -5}, {3, 3, 3}});
  check_sharing("mirror in fog", sharing_camera(4, 30) + bright + fog, {}, 1.5);
  const Coefficients thicker{.sigma_a = Rgb(0.25f), .sigma_s = {0.05f, 0.03f, 0.08f}, .g = 0.4f};
  const std::string alike = homogeneous("m", thicker) + medium_box("m", "", {{-3, -3, -5}, {3, 3, 3}});
  check_sharing("as neighbouring rays see it alike", sharing_camera(3, 14) + bright + alike, {}, 1.5, kManyToShare);
}

// Surfaces that do not scatter evenly offer the light that comes to them from where their path went on: narrow and wide
// metals, rough glass that others look through, and a sheet that lets light through, in a room where most paths meet them
// second. Paths whose colour the glass has split keep what they find.
TEST_CASE("sharing changes the noise alone: metals, rough glass and thin sheets") {
  const auto wall = [](const std::string& material, const std::string& corners) {
    return block("Material " + material + "\nShape \"bilinearmesh\" \"point3 P\" [" + corners + "]\n");
  };
  const std::string metal = "\"conductor\" \"rgb reflectance\" [0.9 0.7 0.4] \"float roughness\" ";
  const std::string floor = "-2 -1.8 -4  2 -1.8 -4  -2 -1.8 2  2 -1.8 2", left = "-2 -1.8 -4  -2 -1.8 2  -2 1.8 -4  -2 1.8 2";
  const std::string others = sharing_wall("0.7 0.7 0.7", "-2 1.8 -4  2 1.8 -4  -2 1.8 2  2 1.8 2") +
                             sharing_wall("0.1 0.7 0.2", "2 -1.8 -4  2 -1.8 2  2 1.8 -4  2 1.8 2") + sharing_end(2) +
                             sharing_end(-4) + emitting_square({0.6f, 0.9f, 1.9f}, 0.25f, 9);
  const std::string room = sharing_camera(5) + others + wall(metal + "0.05", floor) + wall(metal + "0.4", left);
  check_sharing("metals", room, {}, 3, kManyToShare);
  const auto glass = [](const std::string& eta) {
    return block("Material \"dielectric\" " + eta + " \"float roughness\" 0.2\nTranslate 0.3 -1 0.2\n" +
                 box_mesh({{-0.8f, -0.7f, -0.5f}, {0.7f, 0.7f, 0.5f}}));
  };
  const std::string white = sharing_camera(6) + others + sharing_wall("0.6 0.6 0.6", floor) + sharing_wall("0.8 0.1 0.1", left);
  check_sharing("glass", white + glass("\"float eta\" 1.5"), {}, 1.5, kManyToShare);
  check_sharing("glass of many colours", white + glass("\"spectrum eta\" \"glass-F11\""), {}, 1, kManyToShare);
  const std::string sheet = "\"diffusetransmission\" \"rgb reflectance\" [0.3 0.2 0.3] \"rgb transmittance\" [0.4 0.6 0.3]";
  check_sharing("sheet",
                sharing_camera(5) + others + sharing_wall("0.6 0.6 0.6", floor) + wall(sheet, left) +
                    wall(sheet, "-1.2 -1.6 0.2  1 -1.6 0.6  -1.2 0.8 0.2  1 0.8 0.6"),
                {}, 0.9, kManyToShare);
}

// Clear coats spread what comes to the surface under them, to all by a factor that others know, and mirror it besides: what
// they mirror is their path's own. Points have no images in mirrors, which would be most of the noise and are no one else's; a
// bright square has, too large for much noise.
TEST_CASE("sharing changes the noise alone: clear coats") {
  const auto coated = [](const std::string& rgb, const std::string& more, const std::string& corners) {
    return block("Material \"coateddiffuse\" \"float roughness\" 0 \"rgb reflectance\" [" + rgb + "] " + more +
                 "\nShape \"bilinearmesh\" \"point3 P\" [" + corners + "]\n");
  };
  const std::string room =
      sharing_wall("0.7 0.7 0.7", "-2 1.8 -4  2 1.8 -4  -2 1.8 2  2 1.8 2") + sharing_end(2) + sharing_end(-4) +
      coated("0.6 0.6 0.6", "", "-2 -1.8 -4  2 -1.8 -4  -2 -1.8 2  2 -1.8 2") +
      coated("0.8 0.1 0.1", "\"float thickness\" 0.3 \"float eta\" 2", "-2 -1.8 -4  -2 -1.8 2  -2 1.8 -4  -2 1.8 2") +
      coated("0.1 0.7 0.2", "\"float eta\" 0.7", "2 -1.8 -4  2 -1.8 2  2 1.8 -4  2 1.8 2") +
      point_light({-1.7f, 1.2f, 1.1f}, 3) + point_light({1.2f, -1, 0.6f}, 0.4f);
  check_sharing("coats", sharing_camera(5) + room, {}, 1.5, kManyToShare);
  check_sharing("coats with images", sharing_camera(5) + room + emitting_square({0, 0, 1.9f}, 1.5f, 0.6f), {}, 1.2,
                kManyToShare);
  const std::string fog = homogeneous("m", sharing_thin_fog()) + medium_box("m", "", {{-3, -3, -5}, {3, 3, 3}});
  check_sharing("coats in fog", sharing_camera(4) + room + fog, {}, 1.2, kManyToShare);
}

// Veils that stop half of the rays by chance, each as a hash of it says: what one path has passed another may not, but where
// the first went it has passed. Before walls, before fog, and before a sky. Most of the noise is what the camera's rays meet,
// which none share: little is gained or lost (0.91, 1.16 and 1.21).
TEST_CASE("sharing changes the noise alone: veils with alpha") {
  const auto veil = [](const std::string& alpha, const std::string& corners) {
    return block("Material \"diffuse\" \"rgb reflectance\" [0.3 0.6 0.7]\nShape \"bilinearmesh\" \"float alpha\" " + alpha +
                 " \"point3 P\" [" + corners + "]\n");
  };
  const std::string veils = veil("0.5", "-1.6 -1.7 0.4  1.5 -1.7 0.1  -1.6 1.2 0.4  1.5 1.2 0.1") +
                            veil("0.3", "0.5 -1.7 -2  0.6 -1.7 1  0.5 0.9 -2  0.6 0.9 1");
  check_sharing("veils", sharing_camera(5) + sharing_soft_room() + veils, {}, 0.8, kManyToShare);
  const std::string fog = homogeneous("m", sharing_thin_fog()) + medium_box("m", "", {{-3, -3, -5}, {3, 3, 3}});
  check_sharing("veils in fog", sharing_camera(4) + sharing_soft_room() + veils + fog, {}, 0.95, kManyToShare);
  const std::string open = sharing_sides() + sharing_end(-4) + sharing_things();
  check_sharing("veils before a sky", sharing_camera(3) + open + veils + environment(1), {}, 0.95);
}
