#include "session/slice.h"

#include "session/resolved_settings.h"
#include "session/sample_plan.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

int begin_of(int slice, int count, int total) {
  if (slice == count) return total;
  const auto exact = static_cast<std::int64_t>(total) * slice / count;
  return static_cast<int>((exact + kSliceGrain / 2) / kSliceGrain * kSliceGrain);
}

}  // namespace

SampleRange sample_range(const RenderSettings& settings) {
  if (!settings.slice) return {0, is_adaptive(settings) ? SamplePlan::last_end(settings.spp) : settings.spp};
  const auto& [index, count] = *settings.slice;
  const std::string name = std::to_string(index) + "/" + std::to_string(count);
  if (index < 1 || index > count || count > kMostSlices)
    throw Error(Failure::usage,
                "slice " + name + " cannot be; give I/N with I from 1 to N, and N up to " + std::to_string(kMostSlices));
  if (has_error_goal(settings))
    throw Error(Failure::usage, "slice " + name +
                                    " cannot stop at an error, which only all slices together have; leave "
                                    "error out, and give it to merge");
  if (settings.adaptive.value_or(false))
    throw Error(Failure::usage, "slice " + name +
                                    " cannot be adaptive: where the error is only all slices together tell; leave adaptive "
                                    "out, or render without slices");
  const int first = begin_of(index - 1, count, settings.spp), end = begin_of(index, count, settings.spp);
  if (end <= first)
    throw Error(Failure::usage, "slice " + name + " of " + std::to_string(settings.spp) +
                                    " samples is empty: slices begin at " + "multiples of " + std::to_string(kSliceGrain) +
                                    "; ask for fewer slices or more samples");
  return {first, end - first};
}

std::vector<Aov> film_aovs(const RenderSettings& settings) {
  std::vector<std::string> names = settings.aovs;
  if (settings.slice) names.push_back("Variance");
  if (is_adaptive(settings)) names.push_back("SampleCount");
  return parse_aovs(names);
}

SampleRange SliceInfo::share() const {
  const int first = begin_of(choice.index - 1, choice.count, total);
  return {first, begin_of(choice.index, choice.count, total) - first};
}

bool SliceInfo::complete() const { return !stopped && (timed || range == share()); }

}  // namespace tyndall
