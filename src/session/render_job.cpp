#include <algorithm>
#include <limits>
#include <mutex>
#include <tuple>

#include "math/parallel.h"
#include "session/block_render.h"
#include "session/build_id.h"
#include "session/checkpoint.h"
#include "session/film_buffer.h"
#include "session/flush_denormals.h"
#include "session/image_header.h"
#include "session/matte_layers.h"
#include "session/pilot.h"
#include "session/render_pass.h"
#include "session/render_report.h"
#include "session/rendered_pixels.h"
#include "session/resolved_settings.h"
#include "session/sample_plan.h"
#include "session/scene_hash.h"
#include "session/slice.h"
#include "session/unrendered.h"
#include "transport/sample/counters.h"
#include "transport/sample/prices.h"
#include "tyndall/image_attributes.h"
#include "tyndall/timer.h"

namespace tyndall {
class RenderJob::Impl {
 public:
  Impl(const World::Parts& world, const RenderSettings& settings)
      : world_(world),
        settings_(resolved(settings, world)),
        decision_{settings_, std::nullopt},
        open_(open_choices(settings, settings_, world)),
        selector_(world.built.lights.selector(settings.lights, false)),
        selector_with_volumes_(settings_.emission == EmissionStrategy::paths || world.built.volume_lights.empty()
                                   ? nullptr
                                   : &world.built.lights.selector(settings.lights)),
        first_sample_(sample_range(settings).first),
        mattes_(world.built, film_aovs(settings)),
        deep_(deep_layout(world, settings)),
        film_(world.built.scene.film, rendered_pixels(world.built.scene, settings),
              {film_aovs(settings), world.built.light_groups.names(), deep_}),
        sample_context_{world,
                        selector_,
                        selector_with_volumes_,
                        decision_.settings,
                        {.max_depth = settings_.max_depth,
                         .want_transmittance = film_.wants(Aov::transmittance),
                         .want_albedo = film_.wants(Aov::albedo)},
                        nullptr,
                        !mattes_.empty(),
                        deep_ ? &deep_->bins : nullptr},
        pool_(settings.threads),
        blocks_({sample_context_, mattes_, searched_, first_sample_, film_}) {
    if (*settings_.adaptive) plan_.emplace(film_.crop(), settings_.spp, goal());
  }

  bool advance(int count, const PassWatch& watch, GivenUp if_given_up) {
    count = std::min(count, std::numeric_limits<int>::max() - samples_);
    for (int done = 0; done < count && !(plan_ && plan_->is_over(samples_));) {
      if (plan_ && plan_->is_open(samples_)) plan_->decide(samples_, block_noise());
      const int part = pass_end(count - done) - samples_;
      PassWatch on_the_whole;
      if (watch) on_the_whole = [&](double samples) { return watch(done + samples); };
      if (!run_pass(part, on_the_whole, if_given_up)) return false;
      done += part;
    }
    return true;
  }

  /// Of a pass of `most` samples, in all of which the same is decided.
  int pass_end(int most) const {
    const int end = plan_ ? plan_->pass_end(samples_, most) : samples_ + most;
    return pilot_is_ahead() ? std::min(end, samples_before_pilot()) : end;
  }

  bool run_pass(int count, const PassWatch& watch, GivenUp if_given_up) {
    const Timer pass_timer;
    if (!is_searched_) {
      searched_ = search_film(film_.crop(), watch);
      is_searched_ = true;
    }
    RenderPass pass(film_.crop(), count, watch);
    pass.given_up = !decide_next(watch);
    preparing_seconds_ += pass_timer.seconds();
    if (plan_) pass.samples = plan_->total(samples_ + count) - plan_->total(samples_);
    const std::optional<SamplePlan> plan_before = plan_;
    const bool first = samples_ == 0, undo = if_given_up == GivenUp::undone;
    const Counters counters_before = counters_;
    if (undo && !first) pass.before.resize(pass.tiles());
    pool_.for_each(pass.tiles(), 1, [&](std::size_t tile) {
      if (pass.given_up) return;
      const FlushDenormals guard;
      Counters counters;
      if (!pass.before.empty()) pass.before[tile] = film_.copy(pass.tile(tile));
      pass.finished[tile] = render_tile(pass, pass.tile(tile), counters);
      const std::scoped_lock lock(mutex_);
      counters_ += counters;
    });
    seconds_ += pass_timer.seconds();
    if (!pass.given_up) {
      samples_ += count;
    } else if (undo && first) {
      keep_finished(pass);
    } else if (undo) {
      for (std::size_t i = 0; i < pass.tiles(); ++i) {
        if (!pass.before[i].empty()) film_.restore(pass.tile(i), pass.before[i]);
      }
      counters_ = counters_before;
      plan_ = plan_before;
    }
    return !pass.given_up;
  }

  std::string save() const {
    CheckpointState state{samples_, seconds_, counters_, plan_ ? plan_->state() : std::vector<std::uint64_t>(), {}};
    for (const KeyedSums& sums : film_.keyed()) state.keyed.push_back(sums.bytes());
    return encode_checkpoint(identity(), state, film_.sums());
  }

  void restore(std::string_view bytes, const std::string& name) {
    CheckpointState state = decode_checkpoint(bytes, name, identity(), film_.sums(), plan_ ? plan_->state_size() : 0);
    if (state.keyed.size() != film_.keyed().size()) refuse_checkpoint(name);
    for (std::size_t i = 0; i < state.keyed.size(); ++i) {
      if (!film_.keyed()[i].read(state.keyed[i])) refuse_checkpoint(name);
    }
    if (plan_) plan_->restore(state.plan);
    samples_ = state.samples;
    seconds_ = state.seconds;
    counters_ = std::move(state.counters);
  }

  Image image() const {
    Image image = film_.image(samples_, counts());
    if (!unrendered_.empty()) mark_unrendered(image, unrendered_, samples_);
    write_header(image, world_, settings_, counted());
    mattes_.describe(image);
    if (settings_.slice) add_slice(image, film_, settings_, samples_);
    return image;
  }

  /// What the flat image says of itself goes for it as well, but what is said of channels that it has not.
  std::optional<DeepImage> deep_image() const {
    std::optional<DeepImage> deep = film_.deep_image(samples_);
    if (!deep) return deep;
    Image header;
    write_header(header, world_, settings_, counted());
    header.attributes.erase(attributes::kLightGroups);
    deep->attributes = std::move(header.attributes);
    return deep;
  }

  double estimated_relmse() const { return samples_ < 2 ? kInfinity : mean_error(block_noise()); }
  std::vector<float> estimated_errors() const {
    if (samples_ < 2 || !unrendered_.empty()) return {};
    const BlockGrid grid(film_.crop());
    const std::vector<double> of_block = errors_around(block_noise(), grid.across());
    std::vector<float> errors;
    for (int y = grid.crop().y0; y < grid.crop().y1; ++y) {
      for (int x = grid.crop().x0; x < grid.crop().x1; ++x) errors.push_back(static_cast<float>(of_block[grid.index(x, y)]));
    }
    return errors;
  }
  const PixelBounds& pixels() const { return film_.crop(); }
  int samples() const { return samples_; }
  double seconds() const { return seconds_; }
  double preparing_seconds() const { return preparing_seconds_; }

  RenderReport report() const {
    RenderReport r = counted();
    r.estimated_relmse = r.worst_relmse = kInfinity;
    if (samples_ < 2) return r;
    const std::vector<BlockNoise> blocks = block_noise();
    r.estimated_relmse = mean_error(blocks);
    r.worst_relmse = worst_error(blocks, BlockGrid(film_.crop()).across());
    return r;
  }

 private:
  /// Without the error, which takes a look at all pixels.
  RenderReport counted() const {
    RenderReport r = report_of(counters_, Prices(world_.built.lights.size()));
    r.samples = samples_;
    r.least_samples = r.most_samples = samples_;
    if (plan_) std::tie(r.least_samples, r.most_samples) = plan_->range(samples_);
    r.seconds = seconds_;
    if (decision_.budget) report_budget(*decision_.budget, r);
    if (decided_for_ == Decided::rest) report_choices(open_, decision_.settings, r);
    for (const PixelBounds& tile : unrendered_) r.unrendered += static_cast<std::uint64_t>(tile.width()) * tile.height();
    return r;
  }

  /// What depends on no sample.
  SearchedFilm search_film(const PixelBounds& pixels, const PassWatch& watch) {
    const auto alive = [&] {
      const std::scoped_lock lock(mutex_);
      if (watch) watch(0);
    };
    alive();
    return SearchedFilm({world_.built, settings_, pixels, pool_, alive});
  }

  /// Of those of the picture, of which a slice has some.
  int samples_before_pilot() const {
    return settings_.budget == BudgetStrategy::measured ? std::max(kSamplesBeforePilot - first_sample_, 0) : 0;
  }
  bool pilot_is_ahead() const { return samples_ < samples_before_pilot(); }

  /// How the samples that come are rendered. False: it was given up, and has decided nothing.
  bool decide_next(const PassWatch& watch) {
    const Decided next = pilot_is_ahead() ? Decided::first_sample : Decided::rest;
    if (decided_for_ == next) return true;
    const SampleContext undecided{world_, selector_, selector_with_volumes_, settings_, {.max_depth = settings_.max_depth}};
    const PixelBounds frame = frame_of(world_.built.scene.film);
    const bool elsewhere = settings_.budget == BudgetStrategy::measured && frame != film_.crop();
    if (elsewhere && !searched_frame_) searched_frame_ = search_film(frame, watch);
    const Looks looks{undecided, elsewhere ? *searched_frame_ : searched_, pool_, [&] { return !watch || watch(0); }};
    const auto decision = next == Decided::rest ? decide(looks, open_) : decide_first(looks, open_);
    if (!decision) return false;
    decision_ = *decision;
    sample_context_.budget = decision_.budget ? &*decision_.budget : nullptr;
    decided_for_ = next;
    if (next == Decided::rest) searched_frame_.reset();
    return true;
  }

  SampleSpan samples_of(PixelPlace p, int count) const {
    if (!plan_) return {samples_, samples_ + count};
    const std::size_t block = plan_->grid().index(p.x, p.y);
    return {plan_->samples(block, samples_), plan_->samples(block, samples_ + count), plan_->share(block)};
  }
  ErrorGoal goal() const { return {settings_.error.value_or(kInfinity), settings_.error_max.value_or(kInfinity)}; }
  std::vector<int> counts() const { return plan_ ? plan_->counts(samples_) : std::vector<int>(); }

  std::vector<BlockNoise> block_noise() const {
    const BlockGrid grid(film_.crop());
    std::vector<BlockNoise> blocks(grid.size());
    pool_.for_each(blocks.size(), 16, [&](std::size_t b) { blocks[b] = film_.noise(grid.pixels(b), samples_); });
    return blocks;
  }

  /// False: the pass was given up.
  bool render_tile(RenderPass& pass, const PixelBounds& pixels, Counters& counters) {
    const auto group = std::make_unique<PixelGroup>();
    const Prices prices(world_.built.lights.size());
    for (int y = pixels.y0; y < pixels.y1; y += PixelBlock::kSide - y % PixelBlock::kSide) {
      for (int x = pixels.x0; x < pixels.x1; x += PixelBlock::kSide - x % PixelBlock::kSide) {
        if (pass.given_up) return false;
        const SampleSpan samples = samples_of({x, y}, pass.count);
        Counters here;
        blocks_.render({x, y}, pixels, samples, {*group, here});
        if (plan_) plan_->add_work(plan_->grid().index(x, y), static_cast<std::uint64_t>(prices.of(here)));
        counters += here;
        pass.tell(PixelBlock(x, y, pixels).pixels().size() * static_cast<std::size_t>(samples.end - samples.begin));
      }
    }
    return true;
  }

  /// Of a first pass that was given up.
  void keep_finished(const RenderPass& pass) {
    samples_ = pass.count;
    for (std::size_t i = 0; i < pass.tiles(); ++i) {
      if (pass.finished[i]) continue;
      unrendered_.push_back(pass.tile(i));
      film_.clear(pass.tile(i));
    }
  }

  /// What must agree for a checkpoint to be taken up: everything that the bits of the picture depend on.
  CheckpointIdentity identity() const {
    return {{"scene", scene_hash_text(world_.scene_hash, settings_)},
            {"options",
             options_text(settings_) + " --seed " + std::to_string(settings_.seed) + (plan_ ? plan_text(settings_) : "")},
            {"slice", slice_text(settings_)},
            {"crop", crop_text(film_.crop())},
            {"aov", aov_list(settings_.aovs)},
            {"set of matte names", mattes_.identity()},
            {"deep image", deep_ ? deep_->str() : "none"},
            {"build", build_id()}};
  }

  enum class Decided { nothing, first_sample, rest };

  const World::Parts& world_;
  RenderSettings settings_;
  Decision decision_;  ///< before decide_next() settings_
  OpenChoices open_;
  const LightSelector& selector_;
  const LightSelector* selector_with_volumes_;
  int first_sample_;
  MatteLayers mattes_;
  std::optional<DeepLayout> deep_;
  FilmBuffer film_;
  SampleContext sample_context_;
  std::optional<SamplePlan> plan_;
  mutable ThreadPool pool_;
  bool is_searched_ = false;
  Decided decided_for_ = Decided::nothing;
  double preparing_seconds_ = 0;
  SearchedFilm searched_;
  std::optional<SearchedFilm> searched_frame_;  ///< for looks beside what is rendered, until all is decided
  int samples_ = 0;
  double seconds_ = 0;
  BlockRender blocks_;  ///< refers to the above
  std::mutex mutex_;
  Counters counters_;
  std::vector<PixelBounds> unrendered_;  ///< tiles that the given-up first pass did not finish
};

RenderJob::RenderJob(const World& world, const RenderSettings& settings)
    : impl_(std::make_unique<Impl>(world.parts(), settings)) {}
RenderJob::RenderJob(RenderJob&&) noexcept = default;
RenderJob& RenderJob::operator=(RenderJob&&) noexcept = default;
RenderJob::~RenderJob() = default;

bool RenderJob::advance(int samples, const PassWatch& watch, GivenUp given_up) {
  return impl_->advance(samples, watch, given_up);
}
std::string RenderJob::save() const { return impl_->save(); }
void RenderJob::restore(std::string_view bytes, const std::string& name) { impl_->restore(bytes, name); }
PixelBounds RenderJob::pixels() const { return impl_->pixels(); }
int RenderJob::samples() const { return impl_->samples(); }
double RenderJob::seconds() const { return impl_->seconds(); }
double RenderJob::preparing_seconds() const { return impl_->preparing_seconds(); }
double RenderJob::estimated_relmse() const { return impl_->estimated_relmse(); }
std::vector<float> RenderJob::estimated_errors() const { return impl_->estimated_errors(); }
RenderReport RenderJob::report() const { return impl_->report(); }
Image RenderJob::image() const { return impl_->image(); }
std::optional<DeepImage> RenderJob::deep_image() const { return impl_->deep_image(); }

}  // namespace tyndall
