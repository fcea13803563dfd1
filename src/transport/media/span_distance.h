/// The distance along a span at which the light of one emitter is gathered.
#pragma once

#include <array>
#include <optional>

#include "light/lights.h"
#include "transport/media/span_profile.h"

namespace tyndall {

struct DistanceSample {
  float t;
  float pdf;  ///< 1/length
};

/// Equi-angular toward the light's centre [Kulla and Fajardo 2012], bin by bin of the span's profile: the bins are weighted by
/// what the profile scatters there, by the transmittance from the light, by the phase function and, of flat lights, by the
/// cosine at the light. A share is distributed by the angle alone, so that every distance can be drawn but those that the light
/// does not reach. Without `weights`: one bin, pure equi-angular.
/// A deterministic function of profile, ray and light: MIS weights evaluate pdf() for distances found otherwise.
class DistanceSampler {
 public:
  struct Weights {
    float g;  ///< mean cosine of the phase function
  };
  DistanceSampler(const SpanProfile& profile, const Ray& ray, const LightPlace& light, std::optional<Weights> weights);

  DistanceSample sample(float u) const;  ///< pdf 0: the light reaches none of it
  float pdf(float t) const;              ///< 0 outside the profile, and where the light does not emit to

 private:
  void weigh(Weights weights, const Ray& ray, const LightPlace& light);
  void weigh_far();
  static constexpr std::size_t kBlock = 8;
  static_assert(SpanProfile::kMostBins % kBlock == 0 && std::size_t(SpanProfile::Bins::few) % kBlock == 0);
  struct alignas(32) Masses : std::array<float, SpanProfile::kMostBins> {};
  void mix(const Masses& by_profile, const Masses& by_angle);
  struct Range {
    float begin, end;
  };
  Range lit(std::size_t bin) const;  ///< the part of it
  float pdf_in(std::size_t bin, float t) const;
  float sample_in(std::size_t bin, float u) const;
  float angle(float begin, float end) const;

  const SpanProfile* profile_;
  bool far_ = false;
  float closest_ = 0, distance_ = 0;  ///< where the ray comes closest to the light, and how close
  Range lit_;                         ///< where the profile is and the light emits to
  std::size_t bins_ = 1;
  Masses mass_{};  ///< of each bin; they sum to 1
};

}  // namespace tyndall
