#include "report/compare_verdict.h"

#include <doctest/doctest.h>

using namespace tyndall;

namespace {

VariantResult variant(const std::string& name, std::optional<ConfidenceInterval> by_mse,
                      std::optional<ConfidenceInterval> trimmed) {
  VariantResult v;
  v.name = name;
  v.efficiency = by_mse;
  v.efficiency_trimmed = trimmed;
  return v;
}

const VariantResult kBase = variant("plain", {{1, 1, 1}}, {{1, 1, 1}});

std::string verdict(const std::vector<VariantResult>& variants) { return compare_verdict(variants); }

}  // namespace

TEST_CASE("a comparison's sentence names the leader by both measures, with their intervals") {
  CHECK(verdict({kBase, variant("tree", {{3.14159, 2.5, 4}}, {{2, 1.9, 2.1}}), variant("power", {{2, 1, 4}}, {{1.5, 1, 2}})}) ==
        "tree is the most efficient: by MSE 3.14 times as efficient as plain (95 % interval 2.5 to 4), without the worst 0.1 % "
        "of "
        "pixels 2 times as efficient as plain (95 % interval 1.9 to 2.1).");
  CHECK(
      verdict({kBase, variant("power", {{0.5, 0.4, 0.6}}, {{0.9, 0.8, 1.1}})}) ==
      "plain is the most efficient, by MSE and without the worst 0.1 % of pixels; without the worst 0.1 % of pixels the seeds "
      "do not decide.");
  CHECK(verdict({kBase, variant("power", {{0.5, 0.4, 0.6}}, {{0.9, 0.8, 0.95}})}) ==
        "plain is the most efficient, by MSE and without the worst 0.1 % of pixels.");
}

TEST_CASE("a comparison's sentence names no leader without doubt where the first leads but others may be as good") {
  CHECK(verdict({kBase, variant("tree", {{0.5, 0.4, 0.6}}, {{0.5, 0.4, 0.6}}),
                 variant("b", {{0.8, 0.5, 1.4}}, {{0.8, 0.5, 1.3}})}) ==
        "plain is the most efficient, by MSE and without the worst 0.1 % of pixels; the seeds decide neither.");
  CHECK(verdict({kBase, variant("a", {{2, 1.5, 3}}, {{0.9, 0.8, 1.2}})}) ==
        "The two measures disagree: by MSE a leads, 2 times as efficient as plain (95 % interval 1.5 to 3); without the worst "
        "0.1 % of pixels plain leads; without the worst 0.1 % of pixels the seeds do not decide.");
}

TEST_CASE("a comparison's sentence says when the measures disagree and when the seeds do not decide") {
  CHECK(verdict({kBase, variant("joint", {{23, 0.8, 660}}, {{0.62, 0.6, 0.64}})}) ==
        "The two measures disagree: by MSE joint leads, 23 times as efficient as plain (95 % interval 0.8 to 660); without the "
        "worst "
        "0.1 % of pixels plain leads; by MSE the seeds do not decide.");
  CHECK(verdict({kBase, variant("a", {{2, 1.5, 3}}, {{1.1, 1, 1.2}}), variant("b", {{1.5, 1.2, 2}}, {{1.3, 0.9, 1.9}})}) ==
        "The two measures disagree: by MSE a leads, 2 times as efficient as plain (95 % interval 1.5 to 3); without the worst "
        "0.1 % of "
        "pixels b leads, 1.3 times as efficient as plain (95 % interval 0.9 to 1.9); without the worst 0.1 % of pixels the "
        "seeds do not "
        "decide.");
}

TEST_CASE("a comparison of one variant, or of none that was measured, has no sentence") {
  CHECK(verdict({kBase}).empty());
  CHECK(verdict({}).empty());
  CHECK(verdict({variant("a", {}, {}), variant("b", {}, {})}).empty());
}
