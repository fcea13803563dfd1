#include "session/resolved_settings.h"

#include <algorithm>

#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Numbers that would keep a render busy for years with its first vertex, or exhaust the machine.
void check_counts(const RenderSettings& settings) {
  const auto require = [](const char* name, int value, int most) {
    if (value < 0 || value > most)
      throw Error(Failure::usage, std::string(name) + " is " + std::to_string(value) + "; give 0 to " + std::to_string(most));
  };
  require("candidates", settings.candidates.value_or(0), kMostLights);
  require("shadow rays", settings.shadow_rays.value_or(0), kMostLights);
  require("threads", settings.threads, kMostThreads);
}

void check(const RenderSettings& settings) {
  sample_range(settings);  // throws when there are none
  if (settings.spp < 1) throw Error(Failure::usage, "spp is " + std::to_string(settings.spp) + "; give 1 or more");
  check_counts(settings);
  if (settings.splitting && !(*settings.splitting >= 0 && *settings.splitting <= 1))
    throw Error(Failure::usage, "splitting must be from 0 to 1");
  const bool along_spans = settings.distance != DistanceStrategy::automatic && settings.distance != DistanceStrategy::tracking;
  if (settings.media == MediaStrategy::vertex && along_spans) {
    throw Error(Failure::usage,
                "media vertex chooses a light at a collision that has been tracked, so its distance is tracking; "
                "leave distance out, or choose media closest, integral or product");
  }
  if (settings.max_depth < 0 || settings.max_depth > kMostBounces)
    throw Error(Failure::usage, "max depth must be from 0 to " + std::to_string(kMostBounces));
  if (settings.error && !(*settings.error > 0)) throw Error(Failure::usage, "error must be positive; give a relMSE");
  if (settings.error_max && !(*settings.error_max > 0))
    throw Error(Failure::usage, "error max must be positive; give a relMSE");
  if (settings.time && !(*settings.time > 0)) throw Error(Failure::usage, "time must be positive; give seconds");
}

}  // namespace

bool has_error_goal(const RenderSettings& settings) { return settings.error || settings.error_max; }

bool is_adaptive(const RenderSettings& settings) { return settings.adaptive.value_or(has_error_goal(settings)); }

RenderSettings resolved(RenderSettings settings, const World::Parts& world) {
  check(settings);
  settings.adaptive = settings.adaptive.value_or(false);
  world.built.lights.selector(settings.lights);  // throws when it was not built
  if (settings.emission == EmissionStrategy::lights && !world.built.has_volume_lights)
    throw Error(Failure::usage, "the world was not built for emission as lights; set BuildSettings::volume_lights");
  if (settings.media == MediaStrategy::automatic) settings.media = MediaStrategy::product;
  // Settings that stand for other programs' methods have neither guiding nor joint sampling, seek no volume emission, measure
  // no budget and share nothing.
  const bool ours = settings.media == MediaStrategy::product;
  if (settings.guiding == GuidingStrategy::automatic) settings.guiding = ours ? GuidingStrategy::media : GuidingStrategy::off;
  if (settings.emission == EmissionStrategy::automatic && !(ours && world.built.has_volume_lights))
    settings.emission = EmissionStrategy::paths;
  if (settings.joint == JointStrategy::automatic) settings.joint = ours ? JointStrategy::points : JointStrategy::off;
  // Filters take pixels to be independent, and the replicates are there for them.
  const bool filtered = std::find(settings.aovs.begin(), settings.aovs.end(), "Replicate") != settings.aovs.end();
  if (settings.reuse == ReuseStrategy::automatic)
    settings.reuse = ours && !filtered ? ReuseStrategy::pixels : ReuseStrategy::off;
  const bool finds = settings.max_depth > 1 || (settings.max_depth == 1 && !world.built.lights.infinite().empty());
  if (!finds) settings.reuse = ReuseStrategy::off;
  if (settings.budget == BudgetStrategy::automatic) settings.budget = ours ? BudgetStrategy::measured : BudgetStrategy::fixed;
  if (settings.media == MediaStrategy::vertex) settings.distance = DistanceStrategy::tracking;
  return settings;
}

OpenChoices open_choices(const RenderSettings& given, const RenderSettings& resolved, const World::Parts& world) {
  if (resolved.budget != BudgetStrategy::measured) return {};
  const BuiltWorld& built = world.built;
  const bool lit = built.has_media() && built.lights.size() > 0;
  return {.sharing = resolved.reuse == ReuseStrategy::pixels && given.reuse == ReuseStrategy::automatic,
          .emission = resolved.emission == EmissionStrategy::automatic && !built.volume_lights.empty(),
          .pairs = lit && given.media == MediaStrategy::automatic && given.distance == DistanceStrategy::automatic,
          .guiding = lit && resolved.max_depth > 1 && resolved.guiding == GuidingStrategy::media &&
                     given.guiding == GuidingStrategy::automatic && !(built.bright_media.empty() && built.suns.empty())};
}

}  // namespace tyndall
