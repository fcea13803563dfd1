#include "session/pilot.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "session/technique.h"

namespace tyndall {
namespace {

/// Frames that a look usually sees fewer blocks of are too small to tell techniques apart, for what that may cost.
constexpr std::size_t kLeastToCompare = 4;
/// Of which errors can be told, before the first sample.
constexpr std::size_t kLeastFirst = 2;
/// Two techniques are compared by so many blocks at first: all pixels of one may share what a single path has found.
constexpr std::size_t kFirstBlocks = 16;
/// Of the product, what leaving a technique out has to beat: looks see little of rare light, which is what most are there for.
constexpr double kWins = 0.9;
/// Leaving out all, by a standard error: numbers of lights, which are not measured yet, seldom gain more.
constexpr double kWinsClearly = 0.75;
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

/// Whether a look is expected to have less than `wins` of the product of another: that of the mean, since what a choice may
/// lose has no bound, while it saves no more than all. `doubted`: by a standard error more.
bool beats(Look& look, Look& other, double wins, bool doubted) {
  for (std::size_t blocks = kFirstBlocks;; blocks *= 2) {
    look.extend(blocks);
    other.extend(blocks);
    Look::Ratio ratio = look.over(other);
    ratio.log = ratio.log_of_mean() - std::log(wins);
    if (doubted) ratio.log += ratio.deviation;
    if (!pays_to_double(ratio, blocks, look.film())) return ratio.log < 0;
  }
}

/// Whether it is so much better that no numbers of lights would change that.
bool clearly_beats(Look& look, Look& other) {
  look.extend(kFirstBlocks);
  other.extend(kFirstBlocks);
  const Look::Ratio ratio = look.over(other);
  return ratio.log + ratio.deviation < std::log(kWinsClearly);
}

/// Begins with all techniques or with none, changes one thing after the other, and keeps what pays.
class Search {
 public:
  explicit Search(const Looks& looks)
      : looks_(looks), usual_blocks_(Look::usual_blocks(looks.context.world.built.scene.film)) {}

  void begin(const Decision& decision) {
    best_ = look(decision);
    best_->extend(std::min(kFirstBlocks, usual_blocks_));
  }
  /// With the other where that is clearly better. Whether it is.
  bool begin_better(const Decision& other) {
    return replace_if(look(other), [&](Look& begun, Look& tried) { return clearly_beats(tried, begun); });
  }
  /// Goes on with the numbers of lights that pay: noise of too few would hide what a change is worth.
  void ask_lights() {
    unmeasured_ = *best_->decision().budget;
    if (!decides_lights(looks_.context, best_->decision().settings)) return;
    best_->extend(usual_blocks_);
    choices_ = best_->trials(usual_blocks_);
    const Decision asked = result();
    if (asked.budget->vertex != unmeasured_.vertex || asked.budget->span != unmeasured_.span) begin(asked);
  }
  /// Leaves out what is used where variance x cost is less without.
  template <typename Change>
  void leave_out(std::uint64_t used, const Change& change, bool doubted = false) {
    if (used > 0) replace_if(changed(change), [&](Look& with, Look& without) { return beats(without, with, kWins, doubted); });
  }
  /// Takes in what is not there, unless that is less without. Nothing more has to be won: rare light that all together should
  /// have spared was not worth their cost.
  template <typename Change>
  void take_in(const Change& change, bool doubted = false) {
    const auto pays = [&](Look& without, Look& with) { return !beats(without, with, 1, doubted); };
    if (replace_if(changed(change), pays) && !choices_) ask_lights();
  }
  const Look& best() const { return *best_; }
  /// The best, with the numbers of lights that it makes pay.
  Decision result() const {
    Decision result = best_->decision();
    if (!choices_ || !decides_lights(looks_.context, result.settings)) return result;
    LightBudget during = unmeasured_;
    during.collisions_shared = result.budget->collisions_shared;
    best_->extend(usual_blocks_);
    result.budget = best_budget(beside(*choices_, best_->trials(usual_blocks_)), during);
    return result;
  }

 private:
  std::unique_ptr<Look> look(const Decision& decision) const { return std::make_unique<Look>(looks_, decision); }
  template <typename Change>
  std::unique_ptr<Look> changed(const Change& change) const {
    Decision other = best_->decision();
    change(other);
    return look(other);
  }
  template <typename IsBetter>
  bool replace_if(std::unique_ptr<Look> other, const IsBetter& is_better) {
    const bool better = is_better(*best_, *other);
    if (better) best_ = std::move(other);
    return better;
  }

  const Looks& looks_;
  std::size_t usual_blocks_;
  std::unique_ptr<Look> best_;
  LightBudget unmeasured_;
  std::optional<Trials> choices_;  ///< as unmeasured numbers show them; nothing: none was made
};

void collisions_not_shared(Decision& d) { d.budget->collisions_shared = false; }

/// Techniques first, then collisions where paths share: the other way round where all begin, as sharing is worth more without
/// collisions that are better left out.
void decide_techniques(Search& search, const Decision& all, const Techniques& techniques, bool collisions) {
  const auto used = [&](auto count) { return search.best().counters().*count; };
  const auto ask_collisions = [&] {
    if (collisions && search.best().decision().settings.reuse == ReuseStrategy::pixels)
      search.leave_out(used(&Counters::connections), collisions_not_shared);
  };
  const Decision none = without_open(techniques, all);
  const auto is_open = [](const Technique& technique) { return technique.open; };
  const bool from_none = std::any_of(techniques.begin(), techniques.end(), is_open) && search.begin_better(none);
  search.ask_lights();
  if (!from_none) ask_collisions();
  for (const Technique& technique : techniques) {
    const auto change = [&](Decision& d) { technique.copy(from_none ? all : none, d); };
    if (technique.open && from_none) search.take_in(change, technique.doubted);
    if (technique.open && !from_none) search.leave_out(used(technique.use), change, technique.doubted);
  }
  if (from_none) ask_collisions();
}

bool comparable(const SampleContext& context) { return Look::usual_blocks(context.world.built.scene.film) >= kLeastToCompare; }

Decision decision(const Looks& looks, const OpenChoices& open) {
  const SampleContext& context = looks.context;
  Decision all{context.settings, std::nullopt};
  if (context.settings.budget != BudgetStrategy::measured) return all;
  const bool collisions = comparable(context) && decides_collisions(context), compares = comparable(context) && open.any();
  if (!(decides_lights(context, context.settings) || collisions || compares)) return all;
  all.budget = LightBudget::unmeasured(context.settings);
  if (collisions) all.budget->collisions_shared = true;
  Search search(looks);
  search.begin(all);
  if (collisions || compares) {
    decide_techniques(search, all, techniques(open, context), collisions);
  } else {
    search.ask_lights();
  }
  return search.result();
}

/// So few blocks tell little but what techniques cost: they are left out where that is clear. One sample among many of another
/// kind has its share in the variance and in the cost of all, which add up to what it changes of the product.
Decision first_decision(const Looks& looks, const OpenChoices& open) {
  const SampleContext& context = looks.context;
  const Decision all{context.settings, LightBudget::unmeasured(context.settings)};
  const std::size_t blocks = Look::first_blocks(context.world.built.scene.film);
  if (!open.any() || blocks < kLeastFirst) return all;
  const Decision none = without_open(techniques(open, context), all);
  Look with(looks, all), without(looks, none);
  with.extend(blocks);
  without.extend(blocks);
  const Look::Ratio ratio = without.over(with);
  const double variance = std::exp(ratio.log + ratio.deviation) / ratio.cost;
  return 0.5 * (variance + ratio.cost) < kWins ? none : all;
}

template <typename Decide>
std::optional<Decision> unless_given_up(const Decide& decide) {
  try {
    return decide();
  } catch (const LookGivenUp&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Decision> decide_first(const Looks& looks, const OpenChoices& open) {
  return unless_given_up([&] { return first_decision(looks, open); });
}

std::optional<Decision> decide(const Looks& looks, const OpenChoices& open) {
  return unless_given_up([&] { return decision(looks, open); });
}

}  // namespace tyndall
