#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "math/parallel.h"
#include "render/film_buffer.h"
#include "render/image_header.h"
#include "render/pass_schedule.h"
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
  if (settings.max_depth < 0) throw Error(Failure::usage, "max depth is negative; give 0 or more");
  if (settings.time && !(*settings.time > 0)) throw Error(Failure::usage, "time must be positive; give seconds");
}

/// One render in progress.
class Renderer {
 public:
  Renderer(const World::Parts& world, const RenderSettings& settings, const RenderControl& control)
      : world_(world),
        settings_(settings),
        control_(control),
        film_(world.scene.film, full_crop(world.scene, settings), parse_aovs(settings.aovs)),
        pool_(settings.threads),
        schedule_(settings) {}

  Rendering run() {
    while (const int count = schedule_.next_pass()) {
      render_pass(schedule_.samples_done(), count);
      schedule_.finish_pass(count);
      report_progress(0);
      if (stop_requested()) break;
    }
    Rendering result{film_.image(schedule_.samples_done()), report()};
    write_header(result.image, world_, settings_, result.report);
    return result;
  }

 private:
  bool stop_requested() const { return control_.stop != nullptr && control_.stop->load(std::memory_order_relaxed); }

  void render_pass(int first_sample, int count) {
    const PixelBounds& crop = film_.crop();
    const int across = (crop.width() + kTile - 1) / kTile;
    const int down = (crop.height() + kTile - 1) / kTile;
    std::atomic<int> tiles_done{0};
    pool_.for_each(static_cast<std::size_t>(across) * down, 1, [&](std::size_t tile) {
      const FlushDenormals guard;
      Counters counters;
      const int x0 = crop.x0 + static_cast<int>(tile % across) * kTile;
      const int y0 = crop.y0 + static_cast<int>(tile / across) * kTile;
      const PixelBounds pixels{x0, y0, std::min(x0 + kTile, crop.x1), std::min(y0 + kTile, crop.y1)};
      render_tile(pixels, first_sample, count, counters);
      const std::scoped_lock lock(mutex_);
      counters_ += counters;
      report_progress(static_cast<double>(++tiles_done) / (across * down) * count);
    });
  }

  void render_tile(const PixelBounds& pixels, int first_sample, int count, Counters& counters) {
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      for (int x = pixels.x0; x < pixels.x1; ++x) {
        for (int s = first_sample; s < first_sample + count; ++s) render_sample(x, y, s, counters);
      }
    }
  }

  void render_sample(int x, int y, int sample, Counters& counters) {
    Sampler sampler({settings_.seed, x, y, sample});
    const FilterSampler::Offset offset = world_.filter.sample(sampler.next_2d());
    const Vec2 lens = sampler.next_2d();
    const Vec2 on_film{static_cast<float>(x) + 0.5f + offset.p.x, static_cast<float>(y) + 0.5f + offset.p.y};
    const LightContext context{world_, settings_.transmittance, sampler, counters};
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

  /// Called by one thread at a time. `pass_samples`: samples a pixel that the running pass has done so far.
  void report_progress(double pass_samples) {
    if (!control_.progress) return;
    if (auto progress = schedule_.progress(pass_samples)) control_.progress(*progress);
  }

  RenderReport report() const {
    RenderReport r;
    r.samples = schedule_.samples_done();
    r.stopped = stop_requested() && r.samples < settings_.spp;
    r.seconds = schedule_.seconds();
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

  const World::Parts& world_;
  RenderSettings settings_;
  const RenderControl& control_;
  FilmBuffer film_;
  ThreadPool pool_;
  PassSchedule schedule_;
  std::mutex mutex_;
  Counters counters_;
};

}  // namespace

Rendering render(const World& world, const RenderSettings& settings, const RenderControl& control) {
  check(settings);
  return Renderer(world.parts(), settings, control).run();
}

}  // namespace tyndall
