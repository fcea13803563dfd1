#include "session/technique.h"

namespace tyndall {
namespace {

void copy_sharing(const Decision& from, Decision& to) {
  to.settings.reuse = from.settings.reuse;
  if (!to.budget->counts_measured) to.budget = LightBudget::unmeasured(to.settings);
  to.budget->collisions_shared = from.budget->collisions_shared;
}
void copy_emission(const Decision& from, Decision& to) { to.settings.emission = from.settings.emission; }
void copy_pairs(const Decision& from, Decision& to) {
  to.settings.media = from.settings.media;
  to.settings.distance = from.settings.distance;
}
void copy_guiding(const Decision& from, Decision& to) { to.settings.guiding = from.settings.guiding; }

/// Where lights may be close to collisions their variance there has no bound, of which looks see little.
bool doubts_collisions(const SampleContext& context) { return context.world.built.lights.near_power() > 0; }

}  // namespace

Techniques techniques(const OpenChoices& open, const SampleContext& context) {
  return {{{open.sharing, copy_sharing, &Counters::connections},
           {open.emission, copy_emission, &Counters::rays},
           {open.pairs, copy_pairs, &Counters::segments, doubts_collisions(context)},
           {open.guiding, copy_guiding, &Counters::guided}}};
}

Decision without_open(const Techniques& techniques, const Decision& all) {
  Decision none = all, decision = all;
  none.settings.reuse = ReuseStrategy::off;
  none.settings.emission = EmissionStrategy::paths;
  none.settings.media = MediaStrategy::vertex;
  none.settings.distance = DistanceStrategy::tracking;
  none.settings.guiding = GuidingStrategy::off;
  none.budget->collisions_shared.reset();
  for (const Technique& technique : techniques) {
    if (technique.open) technique.copy(none, decision);
  }
  return decision;
}

}  // namespace tyndall
