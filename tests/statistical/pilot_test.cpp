/// What is measured before a render changes its noise alone, is the same for every part of the picture, and pays.
#include "session/pilot.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "report/block_test.h"
#include "support/block_image.h"
#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr int kResolution = 64, kBlock = 8;
constexpr Bounds3 kRoom{{-3, -3, -3}, {3, 3, 3}};

/// A floor under so many lights above a grille, whose bars hide others from every place.
std::string hall(int lights, bool grille, const std::string& media = "") {
  std::string text =
      view({.eye = {0, -0.4f, -2.6f}, .look = {0, -1, 0}, .fov_degrees = 45, .resolution = kResolution, .max_depth = 4});
  text += diffuse_plane(1.5f, 4, 0.6f);
  if (grille) {
    std::string bars;
    for (int i = 0; i < 12; ++i) {
      const std::string x = std::to_string(-2.2f + 0.4f * float(i)), end = std::to_string(-2.0f + 0.4f * float(i));
      bars += "Shape \"bilinearmesh\" \"point3 P\" [" + x + " 0 -3 " + end + " 0 -3 " + x + " 0 3 " + end + " 0 3]\n";
    }
    text += block("Material \"diffuse\" \"rgb reflectance\" [0.2 0.2 0.2]\n" + bars);
  }
  for (int i = 0; i < lights; ++i) {
    const float a = 2.4f * float(i), r = 2 * std::sqrt((float(i) + 0.5f) / float(lights));
    text += point_light({r * std::cos(a), 0.8f, r * std::sin(a)}, 20 / float(lights));
  }
  return text + media;
}

std::string fog() {
  return homogeneous("m", {.sigma_a = {0.02f, 0.05f, 0.1f}, .sigma_s = {0.3f, 0.15f, 0.05f}, .g = 0.4f}) +
         medium_box("m", "", kRoom);
}

/// Means over blocks, whose pixels' noise is correlated.
MeanImage blocks_of(const std::string& text, BudgetStrategy budget, std::uint64_t seed) {
  Subject subject(text, {.reuse = ReuseStrategy::pixels, .budget = budget});
  MeanImageBuilder blocks;
  for (int i = 0; i < fewer(40); ++i) {
    blocks.add(block_image(subject.render(4, seed + static_cast<std::uint64_t>(i)), kBlock));
  }
  CHECK_MESSAGE(subject.faults().empty(), subject.faults());
  return blocks.result();
}

void check_agree(const char* name, const std::string& text) {
  CAPTURE(name);
  constexpr double kLevel = 1e-4;
  const MeanImage fixed = blocks_of(text, BudgetStrategy::fixed, 100),
                  measured = blocks_of(text, BudgetStrategy::measured, 900);
  const auto differences = block_test(measured, fixed);
  CHECK(count_below(differences, sidak(kLevel, static_cast<double>(differences.size()))) == 0);
  const WelchResult mean = mean_test(measured, fixed, 1);
  std::printf("  %s: mean off by %+.3f %% +- %.3f %%\n", name, 100 * mean.difference / image_mean(fixed, 1).mean,
              100 * mean.standard_error / image_mean(fixed, 1).mean);
  CHECK(mean.p > kLevel);
}

LightBudget budget_of(const std::string& text, std::uint64_t seed = 1, PixelBounds crop = {0, 0, kResolution, kResolution}) {
  Scene scene = read_scene_text(text, "test.pbrt").scene;
  scene.film.crop = crop;
  const World world = build(std::move(scene), {});
  RenderSettings settings;
  settings.max_depth = 4;
  settings.seed = seed;
  settings.reuse = ReuseStrategy::pixels;
  settings.budget = BudgetStrategy::measured;
  ThreadPool pool(2);
  const SampleContext context{
      world.parts(), world.parts().built.lights.selector(settings.lights), nullptr, settings, {.max_depth = 4}};
  const auto budget = measured_budget(context, pool);
  REQUIRE(budget);
  return *budget;
}

}  // namespace

TEST_CASE("a measured budget changes the noise alone") {
  check_agree("a hall", hall(200, true));
  check_agree("a hall in fog", hall(200, true, fog()));
}

TEST_CASE("a crop, and any number of threads, have the bits of the whole picture with a measured budget") {
  Scene scene = read_scene_text(hall(200, true, fog()), "test.pbrt").scene;
  const Variant one{.threads = 1, .reuse = ReuseStrategy::pixels, .budget = BudgetStrategy::measured};
  Variant two = one;
  two.threads = 2;
  const Image whole = Subject(scene, one).render(2, 1);
  scene.film.crop = {20, 11, 45, 39};
  const Image crop = Subject(scene, two).render(2, 1);
  bool same = true;
  for (int y = 0; y < crop.height(); ++y) {
    for (int x = 0; x < crop.width(); ++x) same = same && crop.rgb(x, y) == whole.rgb(x + 20, y + 11);
  }
  CHECK(same);
}

TEST_CASE("a crop has the budget of the whole picture") {
  const auto numbers = [](const LightBudget& b) {
    return std::array{b.vertex.candidates, b.vertex.shadow_rays, b.span.candidates, b.span.shadow_rays};
  };
  const std::string scene = hall(200, true, fog());
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    CHECK(numbers(budget_of(scene, seed)) == numbers(budget_of(scene, seed, {20, 11, 45, 39})));
}

// Bars leave it to chance whether a light arrives: rays are what is missing. Four lights without them leave nothing to chance
// that is worth more than the path itself. Of two blocks each, so that half a unit or so is chance.
TEST_CASE("budgets follow what lights leave to chance") {
  double hidden = 0, open = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    hidden += budget_of(hall(200, true), seed).vertex.shadow_rays / 4.0;
    open += budget_of(hall(4, false), seed).vertex.shadow_rays / 4.0;
  }
  std::printf("  shadow rays at the first vertex: %.1f behind bars, %.1f under four lights\n", hidden, open);
  CHECK(hidden > 1.5 * open);
}

// Thin smoke among lights is seen alike by neighbours. A cloud so dense that each meets its own is not worth the connections.
TEST_CASE("collisions are shared where that pays") {
  const auto cloud = [](float density) {
    Grid grid{{{-1.5f, -1.45f, -1.5f}, {1.5f, 0.5f, 1.5f}}, 4, 4, 4, {}};
    for (int i = 0; i < 64; ++i) grid.density.push_back(density * (1 + 0.1f * float(i % 11)));
    return uniform_grid("m", {.sigma_a = Rgb(0.001f), .sigma_s = Rgb(1), .g = 0.85f}, grid) + medium_box("m", "", grid.bounds);
  };
  CHECK(budget_of(hall(20, false, cloud(1))).collisions_shared == true);
  CHECK(budget_of(hall(1, false, cloud(300))).collisions_shared == false);
  CHECK_FALSE(budget_of(hall(20, false, fog())).collisions_shared);
}

TEST_CASE("nothing is measured where there is nothing to decide") {
  const World world = world_of(hall(1, false), {});
  RenderSettings settings;
  settings.budget = BudgetStrategy::measured;
  ThreadPool pool(1);
  const auto decides = [&](const World& w, const RenderSettings& s) {
    return measured_budget({w.parts(), w.parts().built.lights.selector(s.lights), nullptr, s, {.max_depth = s.max_depth}}, pool)
        .has_value();
  };
  CHECK_FALSE(decides(world, settings));
  const World many = world_of(hall(5, false), {});
  CHECK(decides(many, settings));
  RenderSettings fixed = settings, direct = settings, given = settings;
  fixed.budget = BudgetStrategy::fixed;
  direct.max_depth = 1;
  given.candidates = given.shadow_rays = 3;
  CHECK_FALSE(decides(many, fixed));
  CHECK_FALSE(decides(many, direct));
  CHECK_FALSE(decides(many, given));
}
