#include "session/pilot.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

/// Of the product, what a change has to beat: by chance alone looks of a few blocks often differ by less.
constexpr double kWins = 0.9;

/// There are lights to choose among, and numbers that are not given. Single scattering has its own.
bool decides_lights(const SampleContext& context, const RenderSettings& settings) {
  const bool volumes = context.selector_with_volumes && settings.emission != EmissionStrategy::paths;
  return context.world.built.lights.sought(volumes) > 1 && settings.max_depth > 1 && !context.selector.exhaustive() &&
         !context.selector.sizes_cut() && !(settings.candidates && settings.shadow_rays);
}

/// Connections through homogeneous media have no noise of their own, and always pay.
bool decides_collisions(const SampleContext& context) {
  const auto& media = context.world.built.media;
  return context.settings.reuse == ReuseStrategy::pixels &&
         std::any_of(media.begin(), media.end(), [](const ParticipatingMedium& m) { return !m.homogeneous(); });
}

/// Changes one thing after the other, and keeps what pays.
class Search {
 public:
  Search(const SampleContext& context, const Decision& first, ThreadPool& pool)
      : context_(context), pool_(pool), unmeasured_(*first.budget), best_(context, first, pool), choices_(best_.trials()) {}

  /// Goes on with the numbers of lights that pay: noise of too few would hide what a change is worth.
  void ask_lights() {
    if (decides_lights(context_, best_.decision().settings)) best_ = Look(context_, result(), pool_);
  }
  /// Where variance x cost is less it stays changed. Nothing is looked at where what it changes is not `used`.
  template <typename Change>
  void consider(std::uint64_t used, const Change& change) {
    if (used == 0) return;
    Decision other = best_.decision();
    change(other);
    Look look(context_, other, pool_);
    if (look.beats(best_, kWins)) best_ = std::move(look);
  }
  const Look& best() const { return best_; }
  /// The best, with the numbers of lights that it makes pay.
  Decision result() const {
    Decision result = best_.decision();
    if (!decides_lights(context_, result.settings)) return result;
    LightBudget during = unmeasured_;
    during.collisions_shared = result.budget->collisions_shared;
    result.budget = best_budget(beside(choices_, best_.trials()), during);
    return result;
  }

 private:
  const SampleContext& context_;
  ThreadPool& pool_;
  LightBudget unmeasured_;
  Look best_;
  Trials choices_;  ///< as unmeasured numbers show them
};

void collisions_not_shared(Decision& d) { d.budget->collisions_shared = false; }
void without_sharing(Decision& d) {
  d.settings.reuse = ReuseStrategy::off;
  d.budget->collisions_shared.reset();
}
void emission_by_rays(Decision& d) { d.settings.emission = EmissionStrategy::paths; }
void unguided(Decision& d) { d.settings.guiding = GuidingStrategy::off; }
void lit_at_collisions(Decision& d) {
  d.settings.media = MediaStrategy::vertex;
  d.settings.distance = DistanceStrategy::tracking;
}

}  // namespace

Decision decide(const SampleContext& context, const OpenChoices& open, ThreadPool& pool) {
  Decision first{context.settings, std::nullopt};
  const bool collisions = decides_collisions(context);
  if (context.settings.budget != BudgetStrategy::measured ||
      !(decides_lights(context, context.settings) || collisions || open.any()))
    return first;
  first.budget = LightBudget::unmeasured(context.settings.reuse);
  if (collisions) first.budget->collisions_shared = true;
  Search search(context, first, pool);
  const bool compares = open.any() && search.best().can_be_compared();
  if (collisions || compares) search.ask_lights();
  const auto used = [&]() -> const Counters& { return search.best().counters(); };
  if (collisions) search.consider(used().connections, collisions_not_shared);
  if (compares) {
    if (open.sharing) search.consider(used().connections, without_sharing);
    if (open.emission) search.consider(used().rays, emission_by_rays);
    if (open.pairs) search.consider(used().segments, lit_at_collisions);
    if (open.guiding) search.consider(used().guided, unguided);
  }
  return search.result();
}

}  // namespace tyndall
