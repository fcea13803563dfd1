/// One sample of one pixel, from its random numbers to what the film takes of it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "session/world_parts.h"
#include "transport/budget/light_budget.h"
#include "transport/pixel/camera_joint.h"
#include "transport/pixel/camera_peaks.h"
#include "transport/pixel/visible_emitters.h"
#include "transport/sample/camera_matte.h"
#include "transport/sample/deep_sample.h"
#include "transport/sharing/suffix_reuse.h"

namespace tyndall {

/// What all samples of a render share.
struct SampleContext {
  const World::Parts& world;
  const LightSelector& selector;
  const LightSelector* selector_with_volumes;  ///< null: media that emit are not sought
  const RenderSettings& settings;
  Path::Limits limits;
  const LightBudget* budget = nullptr;  ///< null: it was not measured
  bool mattes = false;                  ///< samples tell what they see first
  const DepthBins* bins = nullptr;      ///< and where in depth their light is from; null: they do not
};

/// What is searched for on the film for a pixel's samples; nothing outside of the pixels that are rendered.
struct PixelFilm {
  PixelPoints points;
  PixelPeaks peaks;
  PixelEmitters emitters;
};

/// A value for one sample: make it, let its path end, take its record.
class PixelSample {
 public:
  PixelSample(const SampleContext& context, const SampleKey& key, PixelFilm film, Counters& counters);
  PixelSample(const PixelSample&) = delete;  // its path refers to it

  const SampleKey& key() const { return key_; }
  /// Null where the lenses of the camera let nothing pass.
  Path* path() { return path_ ? &*path_ : nullptr; }
  /// Of the ended path, in the user's units; `weight` is that of the sample in its pixel.
  PathRecord record();
  /// The radiance of that record by light groups, up to rounding; empty where the scene has none.
  std::span<const Rgb> by_group() const { return groups_ ? std::span<const Rgb>(groups_->found) : std::span<const Rgb>(); }
  /// What its camera ray sees first; null where nobody asks, or no ray leaves the camera.
  const CameraMatte* matte() const { return path_ && matte_ ? &*matte_ : nullptr; }
  /// Where in depth the light of that record is from; empty where nobody asks.
  std::span<const DeepSample::Part> by_depth() const { return by_depth_; }
  float weight() const { return offset_.weight; }

 private:
  void receive_light(PathRecord& record);
  void expose(PathRecord& record);
  void scale(PathRecord& record, float s);
  void place(PathRecord& record) const;

  const World::Parts& world_;
  SampleKey key_;
  PixelFilm film_;
  Sampler sampler_;
  FilterSampler::Offset offset_;
  Vec2 on_film_;
  CameraJointWeight joint_weight_;
  PeakWeight peak_weight_;
  std::optional<DrawnEmission> drawn_emission_;
  Rgb of_points_, of_peaks_, of_emitters_;
  float weight_of_ray_ = 1;
  std::optional<GroupedLight> groups_;
  std::optional<CameraMatte> matte_;
  std::optional<DeepSample> deep_;
  std::vector<DeepSample::Part> by_depth_;
  std::optional<Path> path_;
};

/// Samples whose paths share what they find; or one.
class PixelGroup {
 public:
  void clear() {
    for (std::size_t i = 0; i < size_; ++i) slots_[i].reset();
    size_ = 0;
  }
  void add(const SampleContext& context, const SampleKey& key, PixelFilm film, Counters& counters) {
    slots_[size_++].emplace(context, key, std::move(film), counters);
  }
  /// All paths to their ends.
  void run(const SampleContext& context, Counters& counters);
  std::size_t size() const { return size_; }
  PixelSample& operator[](std::size_t i) { return *slots_[i]; }

 private:
  std::array<std::optional<PixelSample>, kMostSharing> slots_;
  std::size_t size_ = 0;
};

}  // namespace tyndall
