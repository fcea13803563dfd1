/// Rendering a scene until it is known well enough: independent renders with different seeds, whose spread is the error.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "report/mean_image.h"
#include "tyndall/render.h"

namespace tyndall::test {

/// What a test changes of the scene's own settings.
struct Variant {
  LightStrategy lights = RenderSettings{}.lights;
  TransmittanceStrategy transmittance = RenderSettings{}.transmittance;
  int threads = RenderSettings{}.threads;
  std::optional<int> candidates = RenderSettings{}.candidates;
  std::optional<int> shadow_rays = RenderSettings{}.shadow_rays;
  std::optional<float> splitting = RenderSettings{}.splitting;
  /// Not left open: what is tested must not be decided away.
  MediaStrategy media = MediaStrategy::product;
  DistanceStrategy distance = RenderSettings{}.distance;
  EmissionStrategy emission = RenderSettings{}.emission;
  GuidingStrategy guiding = RenderSettings{}.guiding;
  JointStrategy joint = RenderSettings{}.joint;
  /// Off: the statistics of most tests take pixels to be independent. reuse_test.cpp holds those that share to these.
  ReuseStrategy reuse = ReuseStrategy::off;
  BudgetStrategy budget = RenderSettings{}.budget;
};

/// Builds a world and renders it as often as asked.
class Subject {
 public:
  /// `text` is a scene; paths in it start at `folder`.
  explicit Subject(const std::string& text, const Variant& variant = {}, const std::string& folder = TYNDALL_SOURCE_DIR);
  Subject(Scene scene, const Variant& variant);

  /// One render of `spp` samples a pixel; equal seeds give equal images.
  Image render(int spp, std::uint64_t seed, const std::vector<std::string>& aovs = {});
  /// Non-finite samples, majorant violations, caps hit (none is allowed) and parity errors (one in a million rays is)
  /// so far, as text; empty, as it must be: within that.
  std::string faults() const;
  const Scene& scene() const { return scene_; }
  const RenderSettings& settings() const { return settings_; }

 private:
  Scene scene_;
  RenderSettings settings_;
  World world_;
  RenderReport total_;
};

/// When to stop.
struct Goal {
  /// Called with all renders so far: the factor by which their variance is still too large; at most 1, or 25 with
  /// sanitizers (kCoarser): done.
  std::function<double(const MeanImage&)> excess;
  double seconds = 60;    ///< of all cores' processor time: give up after this long
  int first_spp = 16;     ///< samples a pixel of the first renders
  int max_spp = 1 << 20;  ///< samples a pixel in all
  /// Measurements of different streams use different seeds: to be compared, they must be independent.
  int stream = 0;
};

struct Measured {
  MeanImage image;
  int renders = 0;
  double spp = 0;        ///< a pixel, in all
  double seconds = 0;    ///< as Goal::seconds
  bool reached = false;  ///< the goal, before time and samples ran out
};

/// At least four renders. When these show the goal to be many renders away, four or more larger ones are added to them
/// (Sobol points like company, and an error that rare events have not shown yet does not stop a measurement early).
Measured measure(Subject& subject, const Goal& goal);

/// Processor time of this program in units of what all cores give in a second: how long it would take on an idle machine.
/// A busy one must not fail a test.
double processor_seconds();

/// A stream for each name.
int stream_of(const std::string& name);

bool nightly();             ///< TYNDALL_NIGHTLY=1: full precision, and what is too long for every commit
std::uint64_t base_seed();  ///< TYNDALL_SEED, else 1

}  // namespace tyndall::test
