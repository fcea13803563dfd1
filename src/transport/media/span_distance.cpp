#include "transport/media/span_distance.h"

#include <algorithm>
#include <cmath>

#include "math/simd.h"

namespace tyndall {
namespace {

/// Share of the distances that are distributed by the angle alone.
constexpr float kByAngle = 0.1f;
/// A light is taken to be this far off the ray at least, relative to its distance: angles keep their digits.
constexpr float kLeastOffset = 1e-4f;

struct Bins8 {
  Float8 begin, end;  ///< distances from the ray's closest point to the light
  Float8 scattering, sigma;
};

/// The angle that each bin is seen under from the light. From sine and cosine; the arc tangent is right to 0.5 %.
Float8 angles(const Bins8& b, Float8 distance) {
  const Float8 d2 = distance * distance;
  const Float8 ra = sqrt(b.begin * b.begin + d2), rb = sqrt(b.end * b.end + d2);
  const Float8 sine = distance * (b.end - b.begin), cosine = d2 + b.begin * b.end;  // both times ra rb
  const Float8 tangent = sine / (ra * rb + cosine + 1e-37f);                        // of half the angle
  const Mask8 steep = tangent > 1.0f;
  const Float8 x = choose(steep, 1 / tangent, tangent);
  const Float8 arc = x / (1 + 0.28f * x * x);
  return 2 * choose(steep, 0.5f * kPi - arc, arc);
}

/// An approximation of exp(-x) from above, so that nothing is thought darker than it is.
Float8 attenuation(Float8 x) {
  Float8 y = 1 / (1 + 0.125f * x);
  y *= y;
  y *= y;
  return y * y;
}

/// Henyey-Greenstein, light from the point at distance `at` along the ray seen from behind, relative to isotropic.
Float8 phase(Float8 at, Float8 distance, float g) {
  const Float8 cosine = -at / sqrt(at * at + distance * distance);
  const Float8 base = max(1 + g * g - 2 * g * cosine, Float8(1e-4f));
  return (1 - g * g) / (base * sqrt(base));
}

/// Cosines at a light toward places of a ray: of flat lights, 1 of others.
class Facing {
 public:
  Facing(const LightPlace& light, const Ray& ray, float closest)
      : foot_(dot(light.normal, ray.o - *light.center + ray.d * closest)),
        slope_(dot(light.normal, ray.d)),
        flat_(light.flat() && (foot_ != 0 || slope_ != 0)),
        two_sided_(light.two_sided) {}

  /// Mean of two places, measured from the ray's closest point to the light, as if both were at distance `from_light` of it.
  Float8 cosine(Float8 begin, Float8 end, Float8 from_light) const {
    if (!flat_) return 1;
    return 0.5f * (height(begin) + height(end)) / from_light;
  }

 private:
  Float8 height(Float8 at) const {  ///< above the light's plane, on the side that it emits to
    const Float8 h = foot_ + slope_ * at;
    return two_sided_ ? abs(h) : max(h, Float8(0.0f));
  }
  float foot_, slope_;
  bool flat_, two_sided_;
};

}  // namespace

DistanceSampler::DistanceSampler(const SpanProfile& profile, const Ray& ray, const LightPlace& light,
                                 std::optional<Weights> weights)
    : profile_(&profile), far_(!light.center), lit_{profile.begin(), profile.end()} {
  mass_[0] = 1;
  if (far_) {
    weigh_far();
    return;
  }
  const Vec3 to_light = *light.center - ray.o;
  closest_ = dot(to_light, ray.d);
  const float reach = std::max(std::abs(closest_ - profile.begin()), 0x1p-100f);
  distance_ = std::max({length(to_light - ray.d * closest_), 0.5f * light.radius, kLeastOffset * reach});
  if (weights) weigh(*weights, ray, light);
}

void DistanceSampler::weigh(Weights weights, const Ray& ray, const LightPlace& light) {
  bins_ = profile_->bins();
  const RayPart part = lit_part(light, ray);
  lit_ = {static_cast<float>(std::max(part.begin, double{lit_.begin})),
          static_cast<float>(std::min(part.end, double{lit_.end}))};
  if (!(lit_.begin < lit_.end)) {
    mass_[0] = 0;
    return;
  }
  Masses by_profile, by_angle;
  std::array<float, SpanProfile::kMostBins + 1> finite;
  std::ranges::copy(profile_->edges(), finite.begin());
  finite[bins_] = std::max(profile_->finite_end(), lit_.begin + profile_->reach());
  const auto within = [this](Float8 t) { return min(max(t, Float8(lit_.begin)), Float8(lit_.end)) - closest_; };
  const Facing facing(light, ray, closest_);
  for (std::size_t i = 0; i < bins_; i += kBlock) {
    const Bins8 bins{within(load8(&finite[i])), within(load8(&finite[i + 1])), load8(&profile_->scatterings()[i]),
                     load8(&profile_->sigmas()[i])};
    const Float8 middle = 0.5f * (bins.begin + bins.end);
    const Float8 from_light = sqrt(middle * middle + distance_ * distance_);
    const Float8 angle = angles(bins, distance_);
    store8(&by_angle[i], angle);
    store8(&by_profile[i], angle * bins.scattering *
                               attenuation(min(bins.sigma * from_light, Float8(profile_->optical_depth()))) *
                               phase(middle, distance_, weights.g) * facing.cosine(bins.begin, bins.end, from_light));
  }
  mix(by_profile, by_angle);
}

/// Light from infinity arrives the same everywhere: by what is scattered, and evenly.
void DistanceSampler::weigh_far() {
  bins_ = profile_->bins();
  Masses by_profile, by_length;
  const auto edges = profile_->edges();
  for (std::size_t i = 0; i < bins_; ++i) {
    const float end = std::min(edges[i + 1], profile_->finite_end());
    by_length[i] = end - edges[i];
    by_profile[i] = profile_->scatterings()[i] * by_length[i];
  }
  mix(by_profile, by_length);
}

void DistanceSampler::mix(const Masses& by_profile, const Masses& by_angle) {
  Float8 sums_profile = 0, sums_angle = 0;
  for (std::size_t i = 0; i < bins_; i += kBlock) {
    sums_profile += load8(&by_profile[i]);
    sums_angle += load8(&by_angle[i]);
  }
  const float sum_profile = reduce(sums_profile), sum_angle = reduce(sums_angle);
  const float share = sum_profile > 0 ? kByAngle : 1.0f;
  const float a = sum_profile > 0 ? (1 - share) / sum_profile : 0.0f, b = sum_angle > 0 ? share / sum_angle : 0.0f;
  for (std::size_t i = 0; i < bins_; i += kBlock) store8(&mass_[i], a * load8(&by_profile[i]) + b * load8(&by_angle[i]));
}

DistanceSampler::Range DistanceSampler::lit(std::size_t bin) const {
  if (bins_ == 1) return lit_;
  const auto edges = profile_->edges();
  return {std::max(edges[bin], lit_.begin), std::min(edges[bin + 1], lit_.end)};
}

/// The angle subtended at the light. As one arc tangent: a difference of two loses narrow bins far away.
float DistanceSampler::angle(float begin, float end) const {
  const float a = begin - closest_;
  if (end == kInfinity) return std::atan2(distance_, a);
  return std::atan2(distance_ * (end - begin), distance_ * distance_ + a * (end - closest_));
}

DistanceSample DistanceSampler::sample(float u) const {
  std::size_t bin = 0;
  if (bins_ > 1) {
    // Whole blocks are passed first. The last bin with mass takes what rounding leaves.
    for (; bin + kBlock < bins_; bin += kBlock) {
      const float block = reduce(load8(&mass_[bin]));
      if (u < block) break;
      u -= block;
    }
    for (; bin < bins_ && !(u < mass_[bin]); ++bin) u -= mass_[bin];
    if (bin == bins_) --bin;
    while (bin > 0 && !(mass_[bin] > 0)) --bin;
    if (!(mass_[bin] > 0)) return {lit_.begin, 0};
    u = std::min(u / mass_[bin], 0x1.fffffep-1f);
  }
  const float t = sample_in(bin, u);
  return {t, mass_[bin] * pdf_in(bin, t)};
}

float DistanceSampler::pdf(float t) const {
  if (!(t >= lit_.begin) || t > lit_.end) return 0;
  if (bins_ == 1) return pdf_in(0, t);
  const std::size_t bin = profile_->bin_at(t);
  return mass_[bin] > 0 ? mass_[bin] * pdf_in(bin, t) : 0.0f;
}

float DistanceSampler::sample_in(std::size_t bin, float u) const {
  const auto [begin, end] = lit(bin);
  float t;
  if (!far_) {
    // closest + D tan(angle of begin + part), by the addition theorem.
    const float a = begin - closest_, tangent = std::tan(u * angle(begin, end));
    t = begin + tangent * (distance_ * distance_ + a * a) / (distance_ - a * tangent);
  } else if (end < kInfinity) {
    t = begin + u * (end - begin);
  } else {
    t = begin - std::log1p(-u) / profile_->sigmas()[bin];
  }
  return std::clamp(t, begin, std::nextafter(end, begin));  // the next bin begins at `end`
}

float DistanceSampler::pdf_in(std::size_t bin, float t) const {
  const auto [begin, end] = lit(bin);
  if (!far_) {
    const float off = t - closest_;
    return distance_ / (angle(begin, end) * (distance_ * distance_ + off * off));
  }
  if (end < kInfinity) return 1 / (end - begin);
  const float sigma = profile_->sigmas()[bin];
  return sigma * std::exp(-sigma * (t - begin));
}

}  // namespace tyndall
