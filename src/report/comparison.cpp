/// The doors of tyndall/compare.h.
#include "tyndall/compare.h"

#include <utility>

#include "report/compare_results.h"
#include "report/diff_json.h"
#include "tyndall/render.h"

namespace tyndall {
namespace {

std::string text(const nlohmann::ordered_json& j) { return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace); }

/// Pixels are held against pixels: those of the variance, and no times.
RenderSettings measured(RenderSettings settings) {
  settings.reproducible = true;
  settings.aovs = {"Variance"};
  return settings;
}

void require_sound(const MethodRace& race) {
  const auto refuse = [](const std::string& what) { throw Error(Failure::usage, what); };
  if (race.methods.empty()) refuse("there is nothing to compare; name a method");
  if (race.seconds.has_value() == race.samples.has_value()) refuse("a comparison has either a time or a number of samples");
  if (race.seconds && !(*race.seconds > 0)) refuse("the time of a comparison must be above 0");
  if (race.samples && *race.samples < 1) refuse("a comparison takes at least 1 sample a pixel");
  if (race.seeds < 2) refuse("a comparison takes at least 2 seeds: its intervals come from their spread");
}

ComparePlan plan_of(const MethodRace& race) {
  ComparePlan plan{.variants = {}, .budget = {.seconds = race.seconds, .samples = race.samples}, .seeds = {}};
  for (const NamedMethod& m : race.methods) plan.variants.push_back({m.name, m.name, measured(m.settings)});
  for (int i = 0; i < race.seeds; ++i) plan.seeds.push_back(race.seed + static_cast<std::uint64_t>(i));
  return plan;
}

Reference reference_of(const World& world, const ComparePlan& plan, const MethodRace& race, const MethodRaceControl& control) {
  RenderSettings settings = plan.variants.front().settings;
  if (race.reference) {
    Reference given = as_reference(*race.reference, "the reference");
    given.require_fit(world, settings, plan.seeds);
    return given;
  }
  settings.seed = kReferenceSeed;
  ReferenceGoal goal{.relmse = race.reference_relmse};
  if (race.reference_seconds) goal.seconds = *race.reference_seconds;
  return render_reference(world, settings, goal, {.stop = control.stop});
}

}  // namespace

std::string diff_images(const Image& image, const Image& reference, const DiffQuestion& q) {
  const DiffSettings settings{.channels = q.channels, .reference_noise = q.reference_noise, .flip = q.flip};
  const ImageDiff diff = compare_images(image, reference, settings);
  const Criteria criteria{
      .test = q.test, .exact = q.exact, .max_error = q.max_error, .max_relmse = q.max_relmse, .max_flip = q.max_flip};
  return text(diff_json(diff, judge(diff, criteria), settings));
}

MethodRaceResult race_methods(Scene scene, const MethodRace& race, const MethodRaceControl& control) {
  require_sound(race);
  const ComparePlan plan = plan_of(race);
  CompareContext context;
  context.scene = scene.source;
  context.threads = race.threads;
  const BuildSettings how{.threads = race.threads, .max_memory = race.max_memory};
  const World world = build(std::move(scene), with_needs_of(plan, plan.variants.front().settings, how));
  const Reference reference = reference_of(world, plan, race, control);
  CompareResult result;
  if (!reference.stopped) result = compare(world, plan, reference, {.progress = control.progress, .stop = control.stop});
  if (result.variants.empty()) throw Error(Failure::incomplete, "the comparison was stopped before a seed was complete");
  context.width = reference.image.width();
  context.height = reference.image.height();
  MethodRaceResult found{
      .json = text(compare_json(context, plan, reference, result)), .reference = reference.image, .images = {}};
  for (VariantResult& v : result.variants)
    if (!v.given_up) found.images.push_back({v.name, std::move(v.image)});
  return found;
}

}  // namespace tyndall
