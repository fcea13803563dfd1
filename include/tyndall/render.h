/// Scene -> build -> World -> render -> Image.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tyndall/deep_image.h"
#include "tyndall/image.h"
#include "tyndall/scene.h"
#include "tyndall/settings.h"

namespace tyndall {

class KeptFiles;  // frames.h

struct BuildSettings {
  std::vector<LightStrategy> lights{LightStrategy::tree};  ///< those that will be rendered with
  bool volume_lights = true;  ///< media that emit can be sampled as lights: what EmissionStrategy::lights and automatic need
  bool sanitize = false;      ///< NaN and infinite voxels become 0 instead of an error
  int threads = 0;            ///< 0: all cores
  /// Bytes: a scene that is estimated to need more, film and volumes included, is refused before anything is built.
  std::size_t max_memory = std::numeric_limits<std::size_t>::max();
  /// What an earlier build made of files is taken from it, and what this one makes is put there.
  KeptFiles* kept = nullptr;
};

/// What one light strategy adds to a build.
struct LightStrategyBuild {
  LightStrategy strategy = LightStrategy::tree;
  double seconds = 0;
  std::size_t bytes = 0;
};

/// What was built, for the summary of the command line.
struct BuildSummary {
  std::size_t triangles = 0, lights = 0, media = 0;
  std::size_t geometry_bytes = 0, light_bytes = 0, volume_bytes = 0;
  double geometry_seconds = 0, light_seconds = 0, volume_seconds = 0;
  std::vector<LightStrategyBuild> light_strategies;  ///< their shares of light_seconds and light_bytes
  std::vector<std::string> notes;                    ///< grids chosen, voxels mended, and other things a user should see
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
  bool preparing = false;  ///< looking at the film: no sample has begun
  int samples_done = 0;    ///< per pixel
  double fraction = 0;     ///< of the whole, [0, 1]; with what RenderControl::begin restored
  double seconds = 0;      ///< since the start, of this process
  double remaining = 0;    ///< estimated; 0 while nothing tells
};

/// A sample that was not finite and was counted as black.
struct BadSample {
  int x, y, sample;
};

/// How many lights are looked at, and to how many of them shadow rays are traced.
struct AskedLights {
  int candidates = 0, shadow_rays = 0;
};

/// What a render's work went into, as its counts say at prices that are the same on every machine; in a report fractions of
/// all.
struct WorkParts {
  double paths = 0;           ///< rays from vertex to vertex, with what is done at these
  double media = 0;           ///< read along them and along shadow rays
  double vertex_lights = 0;   ///< choosing lights at vertices
  double segment_lights = 0;  ///< choosing lights and places for them along segments through media
  double shadow_rays = 0;
  double sharing = 0;  ///< connecting paths with what neighbouring pixels have found
  double guiding = 0;  ///< of directions
};

/// Under their names.
inline constexpr std::array<std::pair<const char*, double WorkParts::*>, 7> kWorkParts{
    {{"paths", &WorkParts::paths},
     {"media", &WorkParts::media},
     {"vertex_lights", &WorkParts::vertex_lights},
     {"segment_lights", &WorkParts::segment_lights},
     {"shadow_rays", &WorkParts::shadow_rays},
     {"sharing", &WorkParts::sharing},
     {"guiding", &WorkParts::guiding}}};

/// Counts of a render. A correct render has 0 in the second group.
struct RenderReport {
  int samples = 0;                          ///< per pixel, done; with RenderSettings::adaptive the work of so many everywhere
  int least_samples = 0, most_samples = 0;  ///< of any pixel
  /// As RenderJob tells, and the largest of a block of 8 x 8 pixels, pooled with those around it. Infinity below 2 samples.
  double estimated_relmse = 0, worst_relmse = 0;
  bool stopped = false;          ///< ended by RenderControl::stop
  std::uint64_t unrendered = 0;  ///< pixels without a sample: the first pass was given up
  double seconds = 0;            ///< spent rendering
  /// With RenderSettings::budget as measured: at paths' first vertices, and along their first segments through media.
  std::optional<AskedLights> at_vertices, along_segments;
  /// Likewise, of what the settings leave open: whether neighbouring pixels share what they find (RenderSettings::reuse), and
  /// beyond collisions in grids; whether media that emit are sought as lights (RenderSettings::emission); whether lights are
  /// chosen along segments, instead of at collisions (RenderSettings::media); and whether paths are guided.
  std::optional<bool> sharing, collisions_shared, emission_sought, pairs, guiding;
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, density_lookups = 0;
  WorkParts work;  ///< all 0 before the first sample

  std::uint64_t non_finite = 0, majorant_violations = 0, caps_hit = 0, parity_errors = 0;
  std::vector<BadSample> bad_samples;  ///< the first 16
};

/// A render that its caller advances: to interleave several, or to look at the picture in between. The image after
/// n samples is the same however they were grouped.
class RenderJob {
 public:
  /// Called by one thread at a time while a pass runs, with the samples a pixel that it has done; 0 while the first one looks
  /// at the film beforehand, which is not given up, and while it is found out what pays (RenderSettings::budget), after which
  /// the job is as it was. Return false to give the pass up. Must not throw.
  using PassWatch = std::function<bool(double samples)>;

  /// `world` must outlive the job. Of `settings`, `spp`, `time` and `error` are the caller's to keep, but `spp` where it is
  /// adaptive: then no pixel gets more.
  /// Throws Error (usage) for settings that cannot be, or a light strategy that the world was not built with.
  RenderJob(const World& world, const RenderSettings& settings);
  RenderJob(RenderJob&&) noexcept;
  RenderJob& operator=(RenderJob&&) noexcept;
  ~RenderJob();

  /// What is left of a pass that is given up. `spoilt`: the job is good for nothing but its report. `undone`: the job is as
  /// it was before the pass, but for samples() that all pixels have got by then; for that the pass takes twice the film's
  /// memory. A first sample, before which there was nothing, leaves the pixels it finished, the others black
  /// (report().unrendered, and 0 in channel SampleCount).
  enum class GivenUp { spoilt, undone };

  /// `samples` > 0 more for every pixel; with RenderSettings::adaptive their work, on to the end of a step of 8 where it has 8,
  /// and no further than `spp` allows. False: given up.
  bool advance(int samples, const PassWatch& watch = {}, GivenUp given_up = GivenUp::spoilt);

  /// The state at this pass end, at least 1 sample, as bytes for restore(). Ends in a checksum.
  std::string save() const;
  /// Take up what save() gave to a job of the same world and settings (but for spp, time, error and threads) in the same
  /// program; the samples that follow are then those of the unbroken render, bit for bit. `name` stands for the bytes in
  /// messages. Throws Error (scene), with both values for what differs, and leaves the job as it was.
  void restore(std::string_view bytes, const std::string& name);

  PixelBounds pixels() const;        ///< of the frame, that are rendered
  int samples() const;               ///< a pixel, so far
  double seconds() const;            ///< spent in advance(), looking at the film beforehand included; after restore(), as saved
  double preparing_seconds() const;  ///< of these, spent in looking at the film
  /// relMSE that the two replicates of each pixel predict: mean of variance / (mean^2 + 0.01) over pixels and
  /// channels, mean^2 without its own noise. Infinity below 2 samples.
  double estimated_relmse() const;
  /// The same for each pixel, row by row: that of its block of 8 x 8, pooled with those around it. Empty below 2 samples.
  std::vector<float> estimated_errors() const;
  RenderReport report() const;
  Image image() const;  ///< of at least 1 sample
  /// The same in depth, where RenderSettings::deep_bins asks for it; flatten() gives R G B A of image(), to rounding.
  std::optional<DeepImage> deep_image() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Control of a running render.
struct RenderControl {
  /// Called a few times a second by one thread at a time, which waits for it; may be empty. Must not throw.
  std::function<void(const Progress&)> progress{};
  /// Set it to end with what there is at the last pass end, or the next one if that is less than two seconds away. Only a
  /// first pass that takes longer leaves pixels without a sample.
  const std::atomic<bool>* stop = nullptr;
  /// Called at 1, 2, 4, 8 ... samples; may be empty. The time it takes is not the render's.
  std::function<void(const RenderJob&)> checkpoint{};
  /// Called at every pass end, which is where a picture can be had; may be empty. The time it takes is not the render's.
  std::function<void(const RenderJob&)> pass_end{};
  /// Called at the first pass end `save_seconds` after the start or the last call, and at the end of a render that is
  /// stopped; may be empty. For RenderJob::save.
  std::function<void(const RenderJob&)> save{};
  double save_seconds = 60;
  /// Called before the first pass; may be empty. For RenderJob::restore.
  std::function<void(RenderJob&)> begin{};
  /// Called after the last pass; may be empty.
  std::function<void(const RenderJob&)> end{};
};

struct Rendering {
  Image image;
  RenderReport report;
  std::optional<DeepImage> deep{};  ///< as RenderJob::deep_image
};

/// Render `world`. What a scene file asks for is in its Scene::settings: pass these, changed as you like; the light
/// strategy must be one that the World was built with. The image depends on the scene, the settings and nothing else: not on
/// threads or time (but for the number of samples when `settings.time` is set). Throws Error (usage) as RenderJob does.
Rendering render(const World& world, const RenderSettings& settings, const RenderControl& control = {});

std::string_view version();  ///< "0.2.0"

}  // namespace tyndall
