/// Scene -> build -> World -> render -> Image.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/scene.h"
#include "tyndall/settings.h"

namespace tyndall {

struct BuildSettings {
  std::vector<LightStrategy> lights{LightStrategy::tree};  ///< those that will be rendered with
  bool sanitize = false;  ///< NaN and infinite voxels become 0 instead of an error
  int threads = 0;        ///< 0: all cores
};

/// What one light strategy adds to a build.
struct LightStrategyBuild {
  LightStrategy strategy = LightStrategy::tree;
  double seconds = 0;
  std::size_t bytes = 0;
};

/// What was built, for the summary of the command line.
struct BuildSummary {
  std::size_t triangles = 0, other_primitives = 0, lights = 0, media = 0;
  std::size_t geometry_bytes = 0, light_bytes = 0, volume_bytes = 0;
  double geometry_seconds = 0, light_seconds = 0, volume_seconds = 0;
  std::vector<LightStrategyBuild> light_strategies;  ///< their shares of light_seconds and light_bytes
  std::vector<std::string> notes;  ///< grids chosen, voxels mended, and other things a user should see
};

/// A scene ready to render: immutable, opaque, shareable between threads.
class World {
 public:
  struct Parts;
  explicit World(std::unique_ptr<const Parts> parts);
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  const BuildSummary& summary() const;
  /// 16 hexadecimal digits that stand for the right picture: equal when scene, content of the files it names and
  /// settings.max_depth are equal, wherever the files lie, and different when any of these differ. Crop, seed, samples,
  /// threads and strategies do not enter. Images carry it as "tyndall/sceneHash".
  std::string scene_hash(const RenderSettings& settings) const;
  const Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<const Parts> parts_;
};

/// Load what the scene names and make it ready. The World keeps the scene: move it in when it is large.
/// Throws Error for everything that can be wrong with a scene.
World build(Scene scene, const BuildSettings& settings = {});

/// Where a render stands.
struct Progress {
  int samples_done = 0;      ///< per pixel
  double fraction = 0;       ///< of the whole, [0, 1]
  double seconds = 0;        ///< since the start
  double remaining = 0;      ///< estimated
};

/// A sample that was not finite and was counted as black.
struct BadSample {
  int x, y, sample;
};

/// Counts of a render. A correct render has 0 in the second group.
struct RenderReport {
  int samples = 0;  ///< per pixel, done
  bool stopped = false;  ///< ended by RenderControl::stop
  double seconds = 0;  ///< spent rendering
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, density_lookups = 0;

  std::uint64_t non_finite = 0, majorant_violations = 0, caps_hit = 0, parity_errors = 0;
  std::vector<BadSample> bad_samples;  ///< the first 16
};

/// A render that its caller advances: to interleave several, or to look at the picture on the way. The image after
/// n samples is the same however they were grouped.
class RenderJob {
 public:
  /// Called by one thread at a time while a pass runs, with the samples a pixel that it has done. Return false to give
  /// the pass up. Must not throw.
  using PassWatch = std::function<bool(double samples)>;

  /// `world` must outlive the job. Of `settings`, `spp`, `time` and `error` are the caller's to keep.
  /// Throws Error (usage) for settings that cannot be, or a light strategy that the world was not built with.
  RenderJob(const World& world, const RenderSettings& settings);
  RenderJob(RenderJob&&) noexcept;
  RenderJob& operator=(RenderJob&&) noexcept;
  ~RenderJob();

  /// `samples` > 0 more for every pixel. False: given up; the job is then good for nothing but its report.
  bool advance(int samples, const PassWatch& watch = {});
  PixelBounds pixels() const;  ///< of the frame, that are rendered
  int samples() const;     ///< a pixel, so far
  double seconds() const;  ///< spent in advance()
  /// relMSE that the two replicates of each pixel predict: mean of variance / (mean^2 + 0.01) over pixels and
  /// channels. Infinity below 2 samples.
  double estimated_relmse() const;
  RenderReport report() const;
  Image image() const;  ///< of at least 1 sample

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A hand on a running render.
struct RenderControl {
  /// Called a few times a second by one thread at a time, which waits for it; may be empty. Must not throw.
  std::function<void(const Progress&)> progress{};
  const std::atomic<bool>* stop = nullptr;  ///< set it to end at the next pass end with what there is
  /// Called at 1, 2, 4, 8 ... samples; may be empty. The time it takes is not the render's.
  std::function<void(const RenderJob&)> checkpoint{};
};

struct Rendering {
  Image image;
  RenderReport report;
};

/// Render `world`. What a scene file asks for is in its Scene::settings: pass these, changed as you like; the light
/// strategy must be one that the World was built with. The image depends on the scene, the settings and nothing else: not on threads or time
/// (but for the number of samples when `settings.time` is set). Throws Error (usage) as RenderJob does.
Rendering render(const World& world, const RenderSettings& settings, const RenderControl& control = {});

std::string_view version();  ///< "0.1.0"

}  // namespace tyndall
