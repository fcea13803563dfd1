#include "session/pilot.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

/// To leave out what is there by default it has to be worse by more than looks and prices err.
constexpr double kWins = 0.85;

/// There are lights to choose among, and numbers that are not given. Single scattering has its own.
bool decides_lights(const SampleContext& context) {
  const RenderSettings& settings = context.settings;
  return context.world.built.lights.sought(context.selector_with_volumes != nullptr) > 1 && settings.max_depth > 1 &&
         !context.selector.exhaustive() && !context.selector.sizes_cut() && !(settings.candidates && settings.shadow_rays);
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
      : context_(context), pool_(pool), best_(context, first, pool) {}

  /// With less than `wins` of the product it stays changed.
  template <typename Change>
  void consider(const Change& change, double wins) {
    Decision other = best_.decision();
    change(other);
    Look look(context_, other, pool_);
    if (look.product(best_) < wins * best_.product(look)) best_ = std::move(look);
  }
  const Look& best() const { return best_; }

 private:
  const SampleContext& context_;
  ThreadPool& pool_;
  Look best_;
};

void without_sharing(Decision& d) {
  d.settings.reuse = ReuseStrategy::off;
  d.budget->collisions_shared.reset();
}
void lit_at_collisions(Decision& d) {
  d.settings.media = MediaStrategy::vertex;
  d.settings.distance = DistanceStrategy::tracking;
}

}  // namespace

Decision decide(const SampleContext& context, const OpenChoices& open, ThreadPool& pool) {
  Decision first{context.settings, std::nullopt};
  const bool lights = decides_lights(context), collisions = decides_collisions(context);
  if (context.settings.budget != BudgetStrategy::measured || !(lights || collisions || open.any())) return first;
  first.budget = LightBudget::unmeasured(context.settings.reuse);
  if (collisions) first.budget->collisions_shared = true;
  Search search(context, first, pool);
  if (collisions) search.consider([](Decision& d) { d.budget->collisions_shared = false; }, 1);
  if (search.best().can_be_compared()) {
    if (open.sharing) search.consider(without_sharing, kWins);
    if (open.pairs) search.consider(lit_at_collisions, kWins);
    if (open.guiding) search.consider([](Decision& d) { d.settings.guiding = GuidingStrategy::off; }, kWins);
  }
  Decision best = search.best().decision();
  if (lights) best.budget = best_budget(search.best().trials(), *best.budget);
  return best;
}

}  // namespace tyndall
