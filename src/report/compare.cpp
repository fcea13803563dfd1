#include "report/compare.h"

#include <algorithm>
#include <set>

namespace tyndall {
namespace {

using Runs = std::vector<RaceRun>;  // of one variant, by seed

std::vector<double> collect(const Runs& runs, const std::function<double(const RaceRun&)>& value) {
  std::vector<double> values;
  for (const RaceRun& r : runs) values.push_back(value(r));
  return values;
}

double mean_of(const Runs& runs, const std::function<double(const RaceRun&)>& value) {
  double sum = 0;
  for (const RaceRun& r : runs) sum += value(r);
  return sum / static_cast<double>(runs.size());
}

const RaceCheckpoint& last(const RaceRun& run) { return run.checkpoints.back(); }

CurvePoint curve_point(const Runs& runs, const std::function<const RaceCheckpoint&(const RaceRun&)>& at) {
  CurvePoint p;
  p.seconds = mean_of(runs, [&](const RaceRun& r) { return at(r).seconds; });
  p.samples = mean_of(runs, [&](const RaceRun& r) { return at(r).samples; });
  p.mse = mean_of(runs, [&](const RaceRun& r) { return at(r).error.mse; });
  const auto relmse = collect(runs, [&](const RaceRun& r) { return at(r).error.relmse; });
  const double mean = mean_of(runs, [&](const RaceRun& r) { return at(r).error.relmse; });
  p.relmse = mean_interval(relmse).value_or(ConfidenceInterval{mean, mean, mean});
  return p;
}

/// Runs of equal time end at different counts; the curve has the powers of two that all reached, and the end.
std::vector<CurvePoint> curve_of(const Runs& runs) {
  std::size_t common = runs.front().checkpoints.size() - 1;
  for (const RaceRun& r : runs) common = std::min(common, r.checkpoints.size() - 1);
  std::vector<CurvePoint> curve;
  for (std::size_t i = 0; i < common; ++i) {
    curve.push_back(curve_point(runs, [i](const RaceRun& r) -> const RaceCheckpoint& { return r.checkpoints[i]; }));
  }
  curve.push_back(curve_point(runs, last));
  return curve;
}

/// Points of the curve from the first on whose mean error is well above the reference's noise. That is taken off, but
/// not without error: relMSE divides by the reference, which is dark where its noise made it so.
std::size_t trusted_points(const std::vector<CurvePoint>& curve, double noise) {
  constexpr double kWellAbove = 10;
  std::size_t n = 0;
  while (n < curve.size() && curve[n].relmse.value > kWellAbove * noise) ++n;
  return n;
}

/// One slope a seed over its first `points` checkpoints, so that their spread is the slope's error.
std::optional<ConfidenceInterval> slope_of(const Runs& runs, std::size_t points, double (*x)(const RaceCheckpoint&)) {
  std::vector<double> slopes;
  for (const RaceRun& r : runs) {
    std::vector<ErrorPoint> known;
    for (std::size_t i = 0; i < std::min(points, r.checkpoints.size()); ++i) {
      known.push_back({x(r.checkpoints[i]), r.checkpoints[i].error.relmse});
    }
    if (const auto slope = log_slope(known)) slopes.push_back(*slope);
  }
  if (slopes.size() < runs.size()) return std::nullopt;
  return mean_interval(slopes);
}

std::array<double, 3> mean_color(const Runs& runs) {
  std::array<double, 3> mean{};
  for (int k = 0; k < 3; ++k) mean[k] = mean_of(runs, [k](const RaceRun& r) { return r.mean_rgb[k]; });
  return mean;
}

ErrorMetrics mean_error(const Runs& runs) {
  ErrorMetrics mean;
  for (double ErrorMetrics::*m :
       {&ErrorMetrics::mse, &ErrorMetrics::relmse, &ErrorMetrics::relmse_trimmed, &ErrorMetrics::mape, &ErrorMetrics::smape}) {
    mean.*m = mean_of(runs, [m](const RaceRun& r) { return last(r).error.*m; });
  }
  if (!last(runs.front()).error.stated) return mean;
  mean.stated.emplace();
  for (double StatedErrors::*m : {&StatedErrors::relmse, &StatedErrors::relmse_trimmed, &StatedErrors::within_two})
    (*mean.stated).*m = mean_of(runs, [m](const RaceRun& r) { return (*last(r).error.stated).*m; });
  return mean;
}

void add_health(const Runs& runs, VariantResult& v) {
  for (const RaceRun& r : runs) {
    v.non_finite += r.report.non_finite;
    v.majorant_violations += r.report.majorant_violations;
    v.caps_hit += r.report.caps_hit;
    v.parity_errors += r.report.parity_errors;
  }
}

double build_seconds_of(const World& world, LightStrategy strategy) {
  for (const LightStrategyBuild& b : world.summary().light_strategies) {
    if (b.strategy == strategy) return b.seconds;
  }
  return 0;
}

/// As a picture of its own. Empty where all pixels have as many.
Image sample_counts_of(const Image& image, const RenderReport& report) {
  Image counts;
  const Channel* channel = image.find("SampleCount");
  if (!channel || report.least_samples == report.most_samples) return counts;
  counts.data = image.data;
  counts.display = image.display;
  counts.add_channel("Y");
  counts.channels.front().values = channel->values;
  return counts;
}

WorkParts mean_work(const Runs& runs) {
  WorkParts mean;
  for (const auto& [name, part] : kWorkParts)
    mean.*part = mean_of(runs, [p = part](const RaceRun& r) { return r.report.work.*p; });
  return mean;
}

VariantResult summarize(const CompareVariant& variant, const Runs& runs, double noise) {
  VariantResult v;
  v.name = variant.name;
  v.options = variant.options;
  add_health(runs, v);
  v.given_up = runs.empty() || std::any_of(runs.begin(), runs.end(), [](const RaceRun& r) { return r.given_up; });
  if (v.given_up) return v;
  v.samples = mean_of(runs, [](const RaceRun& r) { return last(r).samples; });
  v.seconds = mean_of(runs, [](const RaceRun& r) { return last(r).seconds; });
  v.least_samples = runs.front().report.least_samples;
  for (const RaceRun& r : runs) {
    v.least_samples = std::min(v.least_samples, r.report.least_samples);
    v.most_samples = std::max(v.most_samples, r.report.most_samples);
  }
  v.error = mean_error(runs);
  v.curve = curve_of(runs);
  const std::size_t trusted = trusted_points(v.curve, noise);
  v.slope = slope_of(runs, trusted, [](const RaceCheckpoint& c) { return c.seconds; });
  v.slope_samples = slope_of(runs, trusted, [](const RaceCheckpoint& c) { return double(c.samples); });
  v.near_noise = v.error.relmse < noise;
  v.mean_rgb = mean_color(runs);
  v.image = runs.front().image;
  v.sample_counts = sample_counts_of(v.image, runs.front().report);
  return v;
}

/// Error x time of each run at its end.
std::vector<double> costs(const Runs& runs, double ErrorMetrics::*metric) {
  return collect(runs, [metric](const RaceRun& r) { return last(r).error.*metric * last(r).seconds; });
}

/// What is shown: the plan's variants, each followed by itself filtered if there is a filter.
std::vector<CompareVariant> shown_variants(const ComparePlan& plan) {
  std::vector<CompareVariant> shown;
  for (const CompareVariant& v : plan.variants) {
    shown.push_back(v);
    if (plan.filter.apply) shown.push_back({v.name + " " + plan.filter.name, v.options + " " + plan.filter.option, v.settings});
  }
  return shown;
}

/// The filtered half of a run as a run of its own.
RaceRun filtered_run(RaceRun& run) {
  RaceRun filtered;
  filtered.checkpoints = std::move(run.filtered);
  filtered.report = run.report;
  filtered.given_up = run.given_up || filtered.checkpoints.empty();
  if (filtered.given_up) return filtered;
  filtered.image = std::move(run.filtered_image);
  filtered.mean_rgb = mean_color(filtered.image);
  return filtered;
}

/// Variants of the plan that are still in. Once out, a variant is left out of later seeds: it has cost several budgets already.
std::vector<std::size_t> entrants(const std::vector<Runs>& runs, std::size_t each) {
  std::vector<std::size_t> in;
  for (std::size_t i = 0; i * each < runs.size(); ++i) {
    if (runs[i * each].empty() || !runs[i * each].back().given_up) in.push_back(i);
  }
  return in;
}

/// One picture a variant is shown, without what only the filter and ErrorParts take.
void add_run(RaceRun run, Runs& runs) {
  if (!runs.empty()) run.image = {};
  static const std::set<std::string> kept{"R", "G", "B", "A", "Variance.R", "Variance.G", "Variance.B", "SampleCount"};
  std::erase_if(run.image.channels, [](const Channel& c) { return !kept.contains(c.name) && !c.name.starts_with("Mse."); });
  runs.push_back(std::move(run));
}

/// Of all variants that are shown, and of those of the plan.
struct AllRuns {
  std::vector<Runs> runs;
  std::vector<ErrorParts> parts;
};

/// AOVs of a run: its filter's, and what its error is told by.
std::vector<std::string> aovs_for(const CompareFilter& filter) {
  std::set<std::string> aovs(filter.aovs.begin(), filter.aovs.end());
  aovs.insert(kLightParts.begin(), kLightParts.end());
  aovs.insert("Variance");
  return {aovs.begin(), aovs.end()};
}

/// False: stopped; `all` is as before.
bool run_seed(const World& world, const ComparePlan& plan, std::uint64_t seed, const RaceControl& control, AllRuns& all) {
  const std::size_t each = plan.filter.apply ? 2 : 1;
  auto& runs = all.runs;
  const auto in = entrants(runs, each);
  std::vector<RenderSettings> methods;
  for (const std::size_t i : in) {
    methods.push_back(plan.variants[i].settings);
    methods.back().seed = seed;
    methods.back().aovs = aovs_for(plan.filter);
  }
  auto results = race(world, methods, plan.budget, control);
  if (results.empty()) return false;
  for (std::size_t k = 0; k < in.size(); ++k) {
    all.parts[in[k]].add(results[k].image);
    if (each == 2) add_run(filtered_run(results[k]), runs[2 * in[k] + 1]);
    add_run(std::move(results[k]), runs[each * in[k]]);
  }
  return true;
}

void add_efficiency(const Runs& base, const Runs& runs, VariantResult& v) {
  const bool is_base = &base == &runs;
  const auto relative = [&](double ErrorMetrics::*metric) {
    auto interval = relative_efficiency(costs(base, metric), costs(runs, metric));
    if (interval && is_base) interval = ConfidenceInterval{1, 1, 1};
    return interval;
  };
  v.efficiency = relative(&ErrorMetrics::mse);
  v.efficiency_trimmed = relative(&ErrorMetrics::relmse_trimmed);
}

void add_warnings(const VariantResult& v, const ComparePlan& plan, std::vector<std::string>& warnings) {
  const bool filtered = !v.as_rendered.empty();
  if (v.given_up && filtered) {
    warnings.push_back(v.name + ": not made, since that takes two samples a pixel");
  } else if (v.given_up) {
    warnings.push_back(v.name + ": gave up, since one sample a pixel took more than four times the budget");
  } else if (!filtered && plan.budget.seconds && v.seconds > 1.1 * *plan.budget.seconds) {
    warnings.push_back(v.name + ": took longer than the budget, since a sample a pixel is the least there is");
  }
  if (v.near_noise) {
    warnings.push_back(
        v.name +
        ": its error is as small as the reference's own noise; --reference-error or --reference-time make a better one");
  }
  if (!v.slope_note().empty()) warnings.push_back(v.name + ": its error falls " + v.slope_note());
  if (v.non_finite > 0) warnings.push_back(v.name + ": " + std::to_string(v.non_finite) + " samples were not finite");
  if (v.majorant_violations > 0)
    warnings.push_back(v.name + ": " + std::to_string(v.majorant_violations) + " majorant violations");
}

}  // namespace

std::string VariantResult::slope_note() const {
  if (!as_rendered.empty()) return "";  // what a filter leaves is bias for the most part, and meant to be
  if (!slope || !slope_samples || slope->low <= -1) return "";
  if (slope_samples->low <= -1) return "flatter than -1 in time but not in samples: the machine slowed down, perhaps";
  return "flatter than -1: a sign of bias";
}

BuildSettings with_needs_of(const ComparePlan& plan, const RenderSettings& base, BuildSettings settings) {
  settings.lights = {base.lights};
  settings.volume_lights = base.emission != EmissionStrategy::paths;
  for (const CompareVariant& v : plan.variants) {
    settings.volume_lights = settings.volume_lights || v.settings.emission != EmissionStrategy::paths;
    auto& known = settings.lights;
    if (std::find(known.begin(), known.end(), v.settings.lights) == known.end()) known.push_back(v.settings.lights);
  }
  return settings;
}

CompareResult compare(const World& world, const ComparePlan& plan, const Reference& reference, const CompareControl& control) {
  const std::vector<CompareVariant> shown = shown_variants(plan);
  AllRuns all{std::vector<Runs>(shown.size()), std::vector<ErrorParts>(plan.variants.size(), ErrorParts(reference.image))};
  std::vector<Runs>& runs = all.runs;
  CompareResult result;
  const auto left = [&] { return !entrants(runs, plan.filter.apply ? 2 : 1).empty(); };
  for (const std::uint64_t seed : plan.seeds) {
    if (!left()) break;
    const auto done = static_cast<double>(result.seeds_done), planned = static_cast<double>(plan.seeds.size());
    const auto progress = [&](double fraction) {
      if (control.progress) control.progress((done + fraction) / planned);
    };
    const auto measure = [&](const Image& image) { return reference.error_of(image); };
    if (!run_seed(world, plan, seed,
                  {.measure = measure, .filter = plan.filter.apply, .progress = progress, .stop = control.stop}, all))
      break;
    ++result.seeds_done;
  }
  if (result.seeds_done == 0) return result;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    VariantResult v = summarize(shown[i], runs[i], reference.relmse);
    if (plan.filter.apply && i % 2 == 1) {
      v.as_rendered = shown[i - 1].name;
      v.sample_counts = {};  // as it tells
    } else if (!v.given_up) {
      v.work = mean_work(runs[i]);
      v.error_parts = all.parts[plan.filter.apply ? i / 2 : i].shares();
    }
    v.build_seconds = build_seconds_of(world, shown[i].settings.lights);
    if (!v.given_up && !runs.front().back().given_up) add_efficiency(runs.front(), runs[i], v);
    add_warnings(v, plan, result.warnings);
    result.variants.push_back(std::move(v));
  }
  if (result.variants.front().given_up) {
    result.warnings.push_back("no efficiencies, since the first variant, which they are relative to, was given up");
  }
  if (result.seeds_done < plan.seeds.size() && left()) {
    result.warnings.push_back("stopped after " + std::to_string(result.seeds_done) + " of " +
                              std::to_string(plan.seeds.size()) + " seeds: the intervals are wider for it");
  }
  return result;
}

}  // namespace tyndall
