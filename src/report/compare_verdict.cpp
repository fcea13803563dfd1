#include "report/compare_verdict.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall {
namespace {

constexpr const char* kTrimmed = "without the worst 0.1 % of pixels";

using Measure = std::optional<ConfidenceInterval> VariantResult::*;

/// The most efficient by one measure; null where nothing was measured.
const VariantResult* leader(std::span<const VariantResult> variants, Measure measure) {
  const VariantResult* best = nullptr;
  for (const VariantResult& v : variants) {
    if (!(v.*measure)) continue;
    if (!best || (v.*measure)->value > (best->*measure)->value) best = &v;
  }
  return best;
}

std::string times(const VariantResult& v, Measure measure, const std::string& base) {
  const ConfidenceInterval& i = *(v.*measure);
  return fmt::format("{:.3g} times as efficient as {} (95 % interval {:.3g} to {:.3g})", i.value, base, i.low, i.high);
}

/// Whether the seeds leave open that the first, which all are held against, is as good as the leader; or another as good as it.
bool is_undecided(std::span<const VariantResult> variants, const VariantResult& leader, Measure measure) {
  if (&leader != &variants.front()) return (leader.*measure)->low < 1;
  const auto may_lead = [&](const VariantResult& v) { return v.*measure && (v.*measure)->high > 1; };
  return std::any_of(variants.begin() + 1, variants.end(), may_lead);
}

std::string undecided(std::span<const VariantResult> variants, const VariantResult& by_mse, const VariantResult& trimmed) {
  const bool mse = is_undecided(variants, by_mse, &VariantResult::efficiency);
  const bool cut = is_undecided(variants, trimmed, &VariantResult::efficiency_trimmed);
  if (mse && cut) return "; the seeds decide neither";
  if (mse) return "; by MSE the seeds do not decide";
  return cut ? fmt::format("; {} the seeds do not decide", kTrimmed) : "";
}

}  // namespace

std::string compare_verdict(std::span<const VariantResult> variants) {
  if (variants.size() < 2) return {};
  const VariantResult &base = variants.front(), *by_mse = leader(variants, &VariantResult::efficiency),
                      *trimmed = leader(variants, &VariantResult::efficiency_trimmed);
  if (!by_mse || !trimmed) return {};
  const std::string doubt = undecided(variants, *by_mse, *trimmed);
  if (by_mse == trimmed) {
    if (by_mse == &base) return fmt::format("{} is the most efficient, by MSE and {}{}.", base.name, kTrimmed, doubt);
    return fmt::format("{} is the most efficient: by MSE {}, {} {}{}.", by_mse->name,
                       times(*by_mse, &VariantResult::efficiency, base.name), kTrimmed,
                       times(*trimmed, &VariantResult::efficiency_trimmed, base.name), doubt);
  }
  const auto lead = [&](const VariantResult& v, Measure measure) {
    return v.name + (&v == &base ? " leads" : " leads, " + times(v, measure, base.name));
  };
  return fmt::format("The two measures disagree: by MSE {}; {} {}{}.", lead(*by_mse, &VariantResult::efficiency), kTrimmed,
                     lead(*trimmed, &VariantResult::efficiency_trimmed), doubt);
}

}  // namespace tyndall
