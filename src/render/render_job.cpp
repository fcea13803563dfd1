#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "math/parallel.h"
#include "render/film_buffer.h"
#include "render/image_header.h"
#include "render/path.h"

namespace tyndall {
namespace {

constexpr int kTile = 16;  ///< pixels a side: small enough to balance, large enough for coherent memory

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
    throw Error(Failure::usage, "the crop holds no pixel of the " + std::to_string(frame.x1) + "x" +
                                    std::to_string(frame.y1) + " frame; give x0,x1,y0,y1 inside it");
  }
  return crop;
}

void check(const RenderSettings& settings) {
  if (settings.spp < 1) throw Error(Failure::usage, "spp is " + std::to_string(settings.spp) + "; give 1 or more");
  if (settings.candidates && *settings.candidates < 0) throw Error(Failure::usage, "candidates is negative; give 0 or more");
  if (!(settings.splitting >= 0 && settings.splitting <= 1)) throw Error(Failure::usage, "splitting must be from 0 to 1");
  const bool along_spans = settings.distance != DistanceStrategy::automatic && settings.distance != DistanceStrategy::tracking;
  if (settings.media == MediaStrategy::vertex && along_spans) {
    throw Error(Failure::usage, "media vertex chooses a light at a collision that has been tracked, so its distance is tracking; "
                                "leave distance out, or choose media closest, integral or product");
  }
  if (settings.shadow_rays < 0) throw Error(Failure::usage, "shadow rays is negative; give 0 or more");
  if (settings.max_depth < 0) throw Error(Failure::usage, "max depth is negative; give 0 or more");
  if (settings.error && !(*settings.error > 0)) throw Error(Failure::usage, "error must be positive; give a relMSE");
  if (settings.time && !(*settings.time > 0)) throw Error(Failure::usage, "time must be positive; give seconds");
}

/// With the methods that "auto" stands for.
RenderSettings resolved(RenderSettings settings, const World::Parts& world) {
  check(settings);
  world.lights.selector(settings.lights);  // throws when it was not built
  const bool vertex = settings.media == MediaStrategy::vertex;
  if (settings.distance == DistanceStrategy::automatic)
    settings.distance = vertex ? DistanceStrategy::tracking : DistanceStrategy::profile;
  return settings;
}

}  // namespace

class RenderJob::Impl {
 public:
  Impl(const World::Parts& world, const RenderSettings& settings)
      : world_(world),
        settings_(resolved(settings, world)),
        selector_(world.lights.selector(settings.lights)),
        film_(world.scene.film, full_crop(world.scene, settings), parse_aovs(settings.aovs)),
        pool_(settings.threads) {}

  bool advance(int count, const PassWatch& watch) {
    const auto start = Clock::now();
    const PixelBounds& crop = film_.crop();
    const int across = (crop.width() + kTile - 1) / kTile;
    const int down = (crop.height() + kTile - 1) / kTile;
    int tiles_done = 0;
    std::atomic<bool> given_up{false};
    pool_.for_each(static_cast<std::size_t>(across) * down, 1, [&](std::size_t tile) {
      if (given_up) return;
      const FlushDenormals guard;
      Counters counters;
      const int x0 = crop.x0 + static_cast<int>(tile % across) * kTile;
      const int y0 = crop.y0 + static_cast<int>(tile / across) * kTile;
      render_tile({x0, y0, std::min(x0 + kTile, crop.x1), std::min(y0 + kTile, crop.y1)}, count, counters);
      const std::scoped_lock lock(mutex_);
      counters_ += counters;
      if (watch && !watch(static_cast<double>(++tiles_done) / (across * down) * count)) given_up = true;
    });
    seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
    if (!given_up) samples_ += count;
    return !given_up;
  }

  Image image() const {
    Image image = film_.image(samples_);
    write_header(image, world_, settings_, report());
    return image;
  }

  double estimated_relmse() const { return film_.estimated_relmse(samples_); }
  const PixelBounds& pixels() const { return film_.crop(); }
  int samples() const { return samples_; }
  double seconds() const { return seconds_; }

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
    return r;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void render_tile(const PixelBounds& pixels, int count, Counters& counters) {
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = samples_; s < samples_ + count; ++s) render_sample(x, y, s, counters);
      }
    }
  }

  void render_sample(int x, int y, int sample, Counters& counters) {
    Sampler sampler({settings_.seed, x, y, sample});
    const FilterSampler::Offset offset = world_.filter.sample(sampler.next_2d());
    const Vec2 lens = sampler.next_2d();
    const Vec2 on_film{static_cast<float>(x) + 0.5f + offset.p.x, static_cast<float>(y) + 0.5f + offset.p.y};
    const LightContext context{world_, selector_, settings_, sampler, counters};
    const Path::Limits limits{.max_depth = settings_.max_depth,
                              .want_transmittance = film_.wants(Aov::transmittance),
                              .want_albedo = film_.wants(Aov::albedo)};
    PathRecord record = Path(context, limits, world_.camera.ray(on_film, lens)).run();
    expose(record);
    if (!record.is_finite()) {
      ++counters.non_finite;
      counters.bad_samples.push_back({x, y, sample});
      if (counters.bad_samples.size() > 4 * kBadSamplesKept) counters.trim_bad_samples();
      record = PathRecord();
      record.alpha = 0;
    }
    film_.add(x, y, sample, record, offset.weight);
  }

  void expose(PathRecord& record) const {
    const Film& film = world_.scene.film;
    record.scale_radiance(film.imaging_ratio);
    const float brightest = max_component(record.radiance());
    if (brightest > film.max_component) record.scale_radiance(film.max_component / brightest);
  }

  const World::Parts& world_;
  RenderSettings settings_;
  const LightSelector& selector_;
  FilmBuffer film_;
  ThreadPool pool_;
  int samples_ = 0;
  double seconds_ = 0;
  std::mutex mutex_;
  Counters counters_;
};

RenderJob::RenderJob(const World& world, const RenderSettings& settings)
    : impl_(std::make_unique<Impl>(world.parts(), settings)) {}
RenderJob::RenderJob(RenderJob&&) noexcept = default;
RenderJob& RenderJob::operator=(RenderJob&&) noexcept = default;
RenderJob::~RenderJob() = default;

bool RenderJob::advance(int samples, const PassWatch& watch) { return impl_->advance(samples, watch); }
PixelBounds RenderJob::pixels() const { return impl_->pixels(); }
int RenderJob::samples() const { return impl_->samples(); }
double RenderJob::seconds() const { return impl_->seconds(); }
double RenderJob::estimated_relmse() const { return impl_->estimated_relmse(); }
RenderReport RenderJob::report() const { return impl_->report(); }
Image RenderJob::image() const { return impl_->image(); }

}  // namespace tyndall
