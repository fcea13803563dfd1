#include "session/pilot.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace tyndall {
namespace {

/// Frames that a look usually sees fewer blocks of are too small to tell techniques apart, for what that may cost.
constexpr std::size_t kLeastToCompare = 4;
/// Two techniques are compared by so many blocks at first: all pixels of one may share what a single path has found.
constexpr std::size_t kFirstBlocks = 16;
/// Of the product, what a change has to beat: looks see little of rare light, which is what most techniques are there for.
constexpr double kWins = 0.9;
/// They are looked at more closely while that pays in a picture of so many samples.
constexpr double kPictureSamples = 16;

/// There are lights to choose among, and numbers that are not given.
bool decides_lights(const SampleContext& context, const RenderSettings& settings) {
  const bool volumes = context.selector_with_volumes && settings.emission != EmissionStrategy::paths;
  return context.world.built.lights.sought(volumes) > 1 && !context.selector.exhaustive() && !context.selector.sizes_cut() &&
         !(settings.candidates && settings.shadow_rays);
}

/// Connections through homogeneous media have no noise of their own, and always pay.
bool decides_collisions(const SampleContext& context) {
  const auto& media = context.world.built.media;
  return context.settings.reuse == ReuseStrategy::pixels &&
         std::any_of(media.begin(), media.end(), [](const ParticipatingMedium& m) { return !m.homogeneous(); });
}

/// Twice the blocks, but no more than a sample of the picture, leave 1 / sqrt(2) of a standard error, and about as much of what
/// a wrong choice loses.
bool pays_to_double(const Look::Ratio& ratio, std::size_t blocks, const Film& film) {
  const double cost = Look::samples_of(blocks, film);
  return (1 - 1 / std::numbers::sqrt2) * ratio.expected_loss() * kPictureSamples > 2 * cost && 2 * cost <= 1;
}

/// Where lights may be close to collisions their variance there has no bound, of which looks see little.
bool doubts_collisions(const SampleContext& context) { return context.world.built.lights.near_power() > 0; }

/// Whether a look is so much better than another; `doubted`: by a standard error more.
bool beats(Look& look, Look& other, const Film& film, bool doubted) {
  for (std::size_t blocks = kFirstBlocks;; blocks *= 2) {
    look.extend(blocks);
    other.extend(blocks);
    Look::Ratio ratio = look.over(other);
    ratio.log -= std::log(kWins);
    if (doubted) ratio.log += ratio.deviation;
    if (!pays_to_double(ratio, blocks, film)) return ratio.log < 0;
  }
}

/// Changes one thing after the other, and keeps what pays.
class Search {
 public:
  Search(const SampleContext& context, const Decision& first, ThreadPool& pool, const LookWatch& watch)
      : context_(context),
        pool_(pool),
        watch_(watch),
        film_(context.world.built.scene.film),
        unmeasured_(*first.budget),
        usual_blocks_(Look::usual_blocks(film_)),
        best_(look(first)) {
    if (decides_lights(context, first.settings)) choices_ = best_->trials(usual_blocks_);
  }

  /// Goes on with the numbers of lights that pay: noise of too few would hide what a change is worth.
  void ask_lights() {
    const Decision asked = result();
    const LightBudget &now = *best_->decision().budget, &then = *asked.budget;
    if (now.vertex != then.vertex || now.span != then.span) best_ = look(asked);
  }
  /// Where variance x cost is less it stays changed. Nothing is looked at where what it changes is not `used`.
  template <typename Change>
  void consider(std::uint64_t used, const Change& change, bool doubted = false) {
    if (used == 0) return;
    Decision other = best_->decision();
    change(other);
    auto changed = std::make_unique<Look>(context_, other, pool_, watch_);
    if (beats(*changed, *best_, film_, doubted)) best_ = std::move(changed);
  }
  const Look& best() const { return *best_; }
  /// The best, with the numbers of lights that it makes pay.
  Decision result() const {
    Decision result = best_->decision();
    if (!decides_lights(context_, result.settings)) return result;
    LightBudget during = unmeasured_;
    during.collisions_shared = result.budget->collisions_shared;
    best_->extend(usual_blocks_);
    result.budget = best_budget(beside(choices_, best_->trials(usual_blocks_)), during);
    return result;
  }

 private:
  std::unique_ptr<Look> look(const Decision& decision) const {
    auto look = std::make_unique<Look>(context_, decision, pool_, watch_);
    look->extend(decides_lights(context_, decision.settings) ? usual_blocks_ : kFirstBlocks);
    return look;
  }

  const SampleContext& context_;
  ThreadPool& pool_;
  const LookWatch& watch_;
  const Film& film_;
  LightBudget unmeasured_;
  std::size_t usual_blocks_;
  std::unique_ptr<Look> best_;
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

Decision decision(const SampleContext& context, const OpenChoices& open, ThreadPool& pool, const LookWatch& watch) {
  Decision first{context.settings, std::nullopt};
  if (context.settings.budget != BudgetStrategy::measured) return first;
  const bool comparable = Look::usual_blocks(context.world.built.scene.film) >= kLeastToCompare;
  const bool collisions = comparable && decides_collisions(context), compares = comparable && open.any();
  if (!(decides_lights(context, context.settings) || collisions || compares)) return first;
  first.budget = LightBudget::unmeasured(context.settings);
  if (collisions) first.budget->collisions_shared = true;
  Search search(context, first, pool, watch);
  if (collisions || compares) search.ask_lights();
  const auto used = [&]() -> const Counters& { return search.best().counters(); };
  if (collisions) search.consider(used().connections, collisions_not_shared);
  if (compares) {
    if (open.sharing) search.consider(used().connections, without_sharing);
    if (open.emission) search.consider(used().rays, emission_by_rays);
    if (open.pairs) search.consider(used().segments, lit_at_collisions, doubts_collisions(context));
    if (open.guiding) search.consider(used().guided, unguided);
  }
  return search.result();
}

}  // namespace

std::optional<Decision> decide(const SampleContext& context, const OpenChoices& open, ThreadPool& pool,
                               const LookWatch& watch) {
  try {
    return decision(context, open, pool, watch);
  } catch (const LookGivenUp&) {
    return std::nullopt;
  }
}

}  // namespace tyndall
