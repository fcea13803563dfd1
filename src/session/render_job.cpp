#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <mutex>

#include "math/parallel.h"
#include "session/build_id.h"
#include "session/checkpoint.h"
#include "session/film_buffer.h"
#include "session/image_header.h"
#include "session/pixel_block.h"
#include "session/pixel_sample.h"
#include "session/render_pass.h"
#include "session/resolved_settings.h"
#include "session/scene_hash.h"
#include "session/slice.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

/// Flush denormals to zero while it lives, alike on every thread, whatever settings the thread came with.
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned int saved_;
};

PixelBounds full_crop(const Scene& scene, const RenderSettings& settings) {
  const PixelBounds frame{0, 0, scene.film.width, scene.film.height};
  const PixelBounds wanted = settings.crop.value_or(scene.film.crop);
  const PixelBounds crop{std::max(wanted.x0, frame.x0), std::max(wanted.y0, frame.y0), std::min(wanted.x1, frame.x1),
                         std::min(wanted.y1, frame.y1)};
  if (crop.width() <= 0 || crop.height() <= 0) {
    throw Error(Failure::usage, "the crop holds no pixel of the " + std::to_string(frame.x1) + "x" + std::to_string(frame.y1) +
                                    " frame; give x0,x1,y0,y1 inside it");
  }
  return crop;
}

}  // namespace

class RenderJob::Impl {
 public:
  Impl(const World::Parts& world, const RenderSettings& settings)
      : world_(world),
        settings_(resolved(settings, world)),
        selector_(world.built.lights.selector(settings.lights, settings.emission == EmissionStrategy::lights)),
        first_sample_(sample_range(settings).first),
        film_(world.built.scene.film, full_crop(world.built.scene, settings),
              {film_aovs(settings), world.built.light_groups.names()}),
        sample_context_{world,
                        selector_,
                        settings_,
                        {.max_depth = settings_.max_depth,
                         .want_transmittance = film_.wants(Aov::transmittance),
                         .want_albedo = film_.wants(Aov::albedo)}},
        pool_(settings.threads) {}

  bool advance(int count, const PassWatch& watch, GivenUp if_given_up) {
    const Timer pass_timer;
    if (!searched_) search_film(watch);
    RenderPass pass(film_.crop(), count, watch);
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
        if (pass.before[i].size() > 0) film_.restore(pass.tile(i), pass.before[i]);
      }
      counters_ = counters_before;
    }
    return !pass.given_up;
  }

  std::string save() const { return encode_checkpoint(identity(), {samples_, seconds_, counters_}, film_.sums()); }

  void restore(std::string_view bytes, const std::string& name) {
    CheckpointState state = decode_checkpoint(bytes, name, identity(), film_.sums());
    samples_ = state.samples;
    seconds_ = state.seconds;
    counters_ = std::move(state.counters);
  }

  Image image() const {
    Image image = film_.image(samples_);
    if (!unrendered_.empty()) mark_unrendered(image);
    write_header(image, world_, settings_, report());
    if (settings_.slice) add_slice(image, film_, settings_, samples_);
    return image;
  }

  double estimated_relmse() const { return film_.estimated_relmse(samples_); }
  const PixelBounds& pixels() const { return film_.crop(); }
  int samples() const { return samples_; }
  double seconds() const { return seconds_; }
  double preparing_seconds() const { return preparing_seconds_; }

  RenderReport report() const {
    RenderReport r;
    r.samples = samples_;
    r.seconds = seconds_;
    r.paths = counters_.paths;
    r.rays = counters_.rays;
    r.shadow_rays = counters_.shadow_rays;
    r.density_lookups = counters_.tracking.lookups;
    r.non_finite = counters_.non_finite;
    r.majorant_violations = counters_.tracking.majorant_violations;
    r.caps_hit = counters_.tracking.caps_hit;
    r.parity_errors = counters_.parity_errors;
    r.bad_samples = counters_.bad_samples;
    for (const PixelBounds& tile : unrendered_) r.unrendered += static_cast<std::uint64_t>(tile.width()) * tile.height();
    return r;
  }

 private:
  /// What depends on no sample.
  void search_film(const PassWatch& watch) {
    const Timer search_timer;
    const auto alive = [&] {
      const std::scoped_lock lock(mutex_);
      if (watch) watch(0);
    };
    const FilmSearch search{world_.built, settings_, film_.crop(), pool_, alive};
    alive();
    film_points_ = film_points(search);
    film_emitters_ = FilmEmitters(search);
    searched_ = true;
    preparing_seconds_ = search_timer.seconds();
  }

  PixelFilm film_of(PixelPlace p) const {
    if (!film_.crop().contains(p.x, p.y)) return PixelFilm();
    return {film_points_.of(p.x, p.y), film_emitters_.of(p.x, p.y)};
  }

  /// False: the pass was given up.
  bool render_tile(RenderPass& pass, const PixelBounds& pixels, Counters& counters) {
    const bool shares = settings_.reuse == ReuseStrategy::pixels;
    const auto group = std::make_unique<PixelGroup>();
    for (int y = pixels.y0; y < pixels.y1; y += PixelBlock::kSide - y % PixelBlock::kSide) {
      for (int x = pixels.x0; x < pixels.x1; x += PixelBlock::kSide - x % PixelBlock::kSide) {
        if (pass.given_up) return false;
        if (shares) {
          render_shared(PixelBlock(x, y, frame()), pass.count, *group, counters);
        } else {
          render_apart(PixelBlock(x, y, pixels), pass.count, *group, counters);
        }
        pass.tell(static_cast<int>(PixelBlock(x, y, pixels).pixels().size()));
      }
    }
    return true;
  }

  PixelBounds frame() const { return {0, 0, world_.built.scene.film.width, world_.built.scene.film.height}; }
  SampleKey key_of(PixelPlace p, int sample) const { return {settings_.seed, p.x, p.y, first_sample_ + sample}; }

  void render_apart(const PixelBlock& block, int count, PixelGroup& group, Counters& counters) {
    for (const PixelPlace p : block.pixels()) {
      const PixelFilm film = film_of(p);
      for (int s = samples_; s < samples_ + count; ++s) {
        group.clear();
        group.add(sample_context_, key_of(p, s), film, counters);
        add_to_film(group, counters);
      }
    }
  }

  /// Whoever shares with a pixel that is rendered has its path as well, so that a crop has the same bits.
  void render_shared(const PixelBlock& block, int count, PixelGroup& group, Counters& counters) {
    for (int s = samples_; s < samples_ + count; ++s) {
      group.clear();
      for (const PixelPlace p : block.pixels()) group.add(sample_context_, key_of(p, s), film_of(p), counters);
      add_to_film(group, counters);
    }
  }

  void add_to_film(PixelGroup& group, Counters& counters) {
    group.run(sample_context_, counters);
    for (std::size_t i = 0; i < group.size(); ++i) {
      PixelSample& sample = group[i];
      const SampleKey& key = sample.key();
      if (!film_.crop().contains(key.x, key.y)) continue;
      PathRecord record = sample.record();
      std::span<const Rgb> groups = sample.by_group();
      if (!record.is_finite()) {
        ++counters.non_finite;
        counters.bad_samples.push_back({key.x, key.y, key.sample});
        if (counters.bad_samples.size() > 4 * kBadSamplesKept) counters.trim_bad_samples();
        record = PathRecord();
        record.alpha = 0;
        groups = {};
      }
      film_.add(key.x, key.y, key.sample, record, sample.weight());
      if (!groups.empty()) film_.add_groups({key.x, key.y, key.sample}, record.radiance(), groups, sample.weight());
    }
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

  void mark_unrendered(Image& image) const {
    if (!image.find("SampleCount")) {
      for (float& v : image.add_channel("SampleCount").values) v = static_cast<float>(samples_);
    }
    for (Channel& channel : image.channels) {
      if (channel.name != "SampleCount" && channel.name != "Replicate.SampleCount") continue;
      for (const PixelBounds& tile : unrendered_) {
        for (int y = tile.y0; y < tile.y1; ++y) {
          const auto row = static_cast<std::size_t>(y - image.data.y0) * static_cast<std::size_t>(image.width());
          std::fill_n(channel.values.begin() + static_cast<std::ptrdiff_t>(row) + (tile.x0 - image.data.x0), tile.width(),
                      0.0f);
        }
      }
    }
  }

  /// What must agree for a checkpoint to be taken up: everything that the bits of the picture depend on.
  CheckpointIdentity identity() const {
    const PixelBounds& c = film_.crop();
    std::string pixels;
    for (const int v : {c.x0, c.x1, c.y0, c.y1}) pixels += (pixels.empty() ? "" : ",") + std::to_string(v);
    return {{"scene", scene_hash_text(world_.scene_hash, settings_)},
            {"options", options_text(settings_) + " --seed " + std::to_string(settings_.seed)},
            {"slice", slice_text(settings_)},
            {"crop", pixels},
            {"aov", aov_list(settings_.aovs)},
            {"build", build_id()}};
  }

  const World::Parts& world_;
  RenderSettings settings_;
  const LightSelector& selector_;
  int first_sample_;
  FilmBuffer film_;
  SampleContext sample_context_;
  ThreadPool pool_;
  bool searched_ = false;
  double preparing_seconds_ = 0;
  FilmPoints film_points_;
  FilmEmitters film_emitters_;
  int samples_ = 0;
  double seconds_ = 0;
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
RenderReport RenderJob::report() const { return impl_->report(); }
Image RenderJob::image() const { return impl_->image(); }

}  // namespace tyndall
