/// Emitters that a lens blurs: drawn by the part of the lens that sees them, against the filter's samples.
#include <doctest/doctest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "report/block_test.h"
#include "support/block_renders.h"
#include "support/chi_squared.h"
#include "support/emitter_scene.h"
#include "support/sanitized.h"

namespace tyndall::test {
namespace {

constexpr double kLevel = 1e-3;
constexpr int kSpp = 16, kMore = 8;  // of what is drawn, and how many times as many of the filter's
constexpr int kBlock = 3;            // pixels: nearly normal means
constexpr double kDarkest = 0.01;    // of the picture's mean; darker ones are far from normal

BlockRenders renders_of(const std::string& text, JointStrategy joint, int spp, std::uint64_t seed) {
  Variant variant;
  variant.joint = joint;
  variant.budget = BudgetStrategy::fixed;
  return block_renders(Subject(text, variant), kBlock, spp, seed);
}

/// Block by block and in the mean, the filter with kMore times the samples; `worth`: how much less variance a drawn sample has
/// at least. A bias of 5 standard errors of a block's difference is found in half of all cases (144 differences).
void check_drawn(const char* name, const std::string& text, double worth) {
  CAPTURE(name);
  const BlockRenders drawn = renders_of(text, JointStrategy::points, kSpp, 1000),
                     found = renders_of(text, JointStrategy::off, kMore * kSpp, 2000);
  const double mean_found = image_mean(found.blocks, 1).mean;
  std::vector<BlockDifference> differences;
  for (const BlockDifference& d : block_test(drawn.blocks, found.blocks)) {
    const auto block = static_cast<std::size_t>(d.y * found.blocks.width + d.x);
    if (found.blocks.channels[static_cast<std::size_t>(d.channel)][block].mean > kDarkest * mean_found)
      differences.push_back(d);
  }
  const BlockDifference& w = worst(differences);
  const WelchResult mean = mean_test(drawn.blocks, found.blocks, 1);
  const double gain = kMore * found.pixel_variance / drawn.pixel_variance;
  std::printf("  %s: mean off by %+.3f %% +- %.3f %%, worst of %zu blocks %d %d t %.1f, variance %.2f times less\n", name,
              100 * mean.difference / mean_found, 100 * mean.standard_error / mean_found, differences.size(), w.x, w.y,
              w.welch.t, gain);
  CHECK(count_below(differences, sidak(kLevel, static_cast<int>(differences.size()))) == 0);
  CHECK(mean.p > kLevel);
  if (!kSanitized) CHECK(gain > worth);
}

const std::string kLens = " \"float lensradius\" 0.1 \"float focaldistance\" ";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string filtered(const std::string& text, const std::string& filter) {
  return "Integrator \"volpath\" \"integer maxdepth\" 0\n" + replaced(text, "gaussian", filter);
}

TEST_CASE("emitters that a lens blurs are drawn as bright as the filter finds them") {
  check_drawn("in focus, box", filtered(emitter_scene(kPerspective + kLens + "3"), "box"), 3);
  check_drawn("behind, gaussian", filtered(emitter_scene(kPerspective + kLens + "1.5"), "gaussian"), 3);
  check_drawn("before, mitchell", filtered(emitter_scene(kPerspective + kLens + "6"), "mitchell"), 3);
  check_drawn("orthographic", filtered(emitter_scene(kOrthographic + kLens + "2"), "box"), 5);
}

std::string bulb(const std::string& where) { return emitter("Translate " + where, "Shape \"sphere\" \"float radius\" 0.05\n"); }

std::string before_lens(const std::string& focus, const std::string& things) {
  return "Integrator \"volpath\" \"integer maxdepth\" 0\n" + before_camera(kPerspective + kLens + focus, things);
}

// What share of the lens sees an emitter differs between pixels, and from what its middle sees: rare and heavy finds, if shares
// of emitters did not know of it.
TEST_CASE("emitters beside others that more of the lens sees are not left to heavy finds") {
  const std::string edge_on =
      "Shape \"trianglemesh\" \"point3 P\" [0 -0.3 -0.5  0 0.3 -0.5  0.00001 0.3 0.5  0.00001 -0.3 0.5] "
      "\"integer indices\" [0 1 2 0 2 3]\n";
  check_drawn("edge-on", before_lens("1.5", emitter("", edge_on) + bulb("0.03 0 0.6")), 1.5);
  const std::string strip =
      "Shape \"trianglemesh\" \"point3 P\" [-0.05 -0.02 -1.5  0.05 -0.02 -1.5  0.5 0.02 2  0.4 0.02 2] "
      "\"integer indices\" [0 1 2 0 2 3]\n";
  check_drawn("through what is in focus", before_lens("3", emitter("", strip) + bulb("0.1 0 -1.5")), 1.5);
}

TEST_CASE("emitters that a lens blurs are as bright behind fog and boards, on one side alone, and lit by each other") {
  const std::string fog =
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.1 0.2 0.3] \"rgb sigma_s\" "
      "[0.05 0.05 0.05]\nMediumInterface \"\" \"fog\"\n";
  const std::string board =
      "AttributeBegin\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\nTranslate -0.5 0.2 -0.6\n"
      "Shape \"disk\" \"float radius\" 0.3\nAttributeEnd\n";
  std::string text = emitter_scene(kPerspective + kLens + "2") + board;
  text = replaced(text, "\"bool twosided\" true", "");
  text = replaced(text, "Camera", fog + "Camera");
  check_drawn("fog", "Integrator \"volpath\" \"integer maxdepth\" 2\n" + replaced(text, "gaussian", "box"), 1.5);
}

}  // namespace
}  // namespace tyndall::test
