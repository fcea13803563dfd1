/// Paths that share what they find in media, against paths that do not.
///
/// Pixels that share are not independent, so errors come from the spread between renders of whole blocks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/measure.h"
#include "support/sharing.h"

using namespace tyndall;
using namespace tyndall::test;

// Of a fog of three colours every path passes another part; some start or end outside, or pass its boundary twice.
TEST_CASE("sharing changes the noise alone: homogeneous fog") {
  const std::string fog = homogeneous("m", sharing_thin_fog());
  check_sharing("everywhere", sharing_camera(5) + sharing_room() + fog + medium_box("m", "", {{-3, -3, -5}, {3, 3, 3}}), {},
                1.5);
  check_sharing("in the middle",
                sharing_camera(5) + sharing_room() + fog + medium_box("m", "", {{-1.5f, -1.79f, -1.5f}, {0.3f, 1, 1.5f}}), {},
                1.5);
  check_sharing("by collisions", sharing_camera(5) + sharing_room() + fog + medium_box("m", "", {{-3, -3, -5}, {3, 3, 3}}),
                {.media = MediaStrategy::vertex}, 0.8);  // collisions beside the lights decide, which none share
}

// The rays of a block are closer together than light goes between collisions: finds are received all along them, and on what is
// behind. In three colours, one of which hardly passes; under a sky; with a grid, known by look-ups alone, before some of them;
// and where little gets through, so that roulette decides who receives behind it.
TEST_CASE("sharing changes the noise alone: fog as neighbouring rays see it alike") {
  constexpr float kNarrow = 16;
  const Coefficients colours{.sigma_a = {0.02f, 0.05f, 0.1f}, .sigma_s = {0.25f, 0.15f, 0.4f}, .g = 0.4f};
  const Bounds3 everywhere{{-3, -3, -5}, {3, 3, 3}}, middle{{-1.5f, -1.79f, -2.5f}, {0.3f, 1, 1.5f}};
  const std::string fog = homogeneous("m", colours);
  check_sharing("everywhere", sharing_camera(5, kNarrow) + sharing_soft_room() + fog + medium_box("m", "", everywhere), {}, 3,
                kManyToShare);
  check_sharing("in the middle", sharing_camera(5, kNarrow) + sharing_soft_room() + fog + medium_box("m", "", middle), {}, 3,
                kManyToShare);
  const std::string lit = emitting_square({-1.2f, 1.2f, 0.5f}, 0.4f, 5) + environment(0.3f);
  // Nearly a furnace: what collides is as bright as what passes, so that a path alone has next to no noise. Sharing takes twice
  // its variance there, and measured budgets leave it out.
  check_sharing("under a sky", sharing_camera(4, kNarrow) + lit + fog + medium_box("m", "", middle), {}, 0.45);

  Grid grid{{{-0.1f, -0.6f, -1}, {0.4f, 0, 0}}, 4, 4, 4, {}};  // for some rays of a block
  for (int i = 0; i < 64; ++i) grid.density.push_back(2 * float(i % 11));
  const std::string smoke = uniform_grid("s", colours, grid) + medium_box("s", "", grid.bounds);
  check_sharing("a grid in it",
                sharing_camera(3, kNarrow) + sharing_soft_room() + fog + medium_box("m", "", everywhere) + smoke, {}, 2);
  const std::string thick = homogeneous("m", {.sigma_a = Rgb(0.05f), .sigma_s = {0.4f, 0.5f, 0.6f}, .g = -0.3f});
  check_sharing("thick", sharing_camera(3, 8) + sharing_soft_room() + thick + medium_box("m", "", everywhere), {}, 3,
                kManyToShare);
}

TEST_CASE("sharing changes the noise alone: smoke that leaves some ways open, from which paths are sent toward it") {
  Coefficients smoke = sharing_thin_fog();
  smoke.sigma_s = {3, 2, 1.5f};
  check_sharing("smoke", sharing_camera(5) + sharing_room() + sharing_smoke(smoke), {}, 1.3);
}

TEST_CASE("sharing changes the noise alone: a fire that scatters its own light") {
  const Bounds3 hearth{{-0.7f, -1.8f, -0.6f}, {0.7f, -0.2f, 0.8f}};
  Grid flames{hearth, 8, 8, 8, {}};
  for (int i = 0; i < 512; ++i) {
    const float v = 0.5f + std::sin(1.9f * (i % 8)) * std::cos(1.3f * (i / 64)) - 0.06f * (i / 8 % 8);
    flames.density.push_back(std::max(v, 0.0f));
  }
  const Coefficients burning{.sigma_a = {1, 1.5f, 2}, .sigma_s = {3, 2.5f, 2}, .g = 0.4f, .Le = {8, 4, 1}};
  const std::string fire =
      sharing_camera(5) + sharing_unlit_room() + uniform_grid("fire", burning, flames) + medium_box("fire", "", hearth);
  for (const EmissionStrategy emission : {EmissionStrategy::automatic, EmissionStrategy::paths, EmissionStrategy::lights})
    check_sharing("fire", fire, {.emission = emission}, 1.05);
}

// Finds in media are scattered toward neighbours with the density of the direction that the sun's aureole drew.
TEST_CASE("sharing changes the noise alone: a cloud under a sun") {
  const Coefficients drops{.sigma_a = {0.02f, 0.05f, 0.1f}, .sigma_s = {3, 2, 1.5f}, .g = 0.8f};
  Grid grid{{{-1.5f, -1.7f, -1.5f}, {0.6f, 1, 1.5f}}, 4, 4, 4, {}};
  for (int i = 0; i < 64; ++i) grid.density.push_back(0.2f * float(i % 11));
  const std::string light = distant_light({1, -2, 1}, 3) + environment(0.2f);
  check_sharing("cloud", sharing_camera(12) + light + uniform_grid("m", drops, grid) + medium_box("m", "", grid.bounds), {},
                0.7);
}
