/// The distance along a span at which one light is gathered.
#pragma once

#include <array>
#include <optional>

#include "light/lights.h"
#include "render/span_profile.h"

namespace tyndall {

struct DistanceSample {
  float t;
  float pdf;  ///< 1/length
};

/// Equi-angular toward the light's centre [Kulla and Fajardo 2012], bin by bin of the span's profile: the bins are
/// weighted by what the profile says is scattered there, dimmed on the way from the light, and by the phase function.
/// A share goes by the angle alone, so that no distance is out of reach. Without `weights`: one bin, pure equi-angular.
/// A deterministic function of profile, ray and light: MIS weights evaluate pdf() for distances found otherwise.
class DistanceSampler {
 public:
  struct Weights {
    float g;  ///< mean cosine of the phase function
  };
  DistanceSampler(const SpanProfile& profile, const Ray& ray, const LightPlace& light, std::optional<Weights> weights);

  DistanceSample sample(float u) const;
  float pdf(float t) const;  ///< 0 outside the profile

 private:
  void weigh(Weights weights);
  void weigh_far();
  static constexpr std::size_t kBlock = 8;
  static_assert(SegmentProfile::kBins % kBlock == 0);  // and so are a profile's
  struct alignas(32) Masses : std::array<float, SpanProfile::kMostBins> {};
  void mix(const Masses& by_profile, const Masses& by_angle);
  float pdf_in(std::size_t bin, float t) const;
  float sample_in(std::size_t bin, float u) const;
  float angle(float begin, float end) const;

  const SpanProfile* profile_;
  bool far_ = false;
  float closest_ = 0, distance_ = 0;  ///< where the ray comes closest to the light, and how close
  std::size_t bins_ = 1;
  Masses mass_{};  ///< of each bin; they sum to 1
};

}  // namespace tyndall
