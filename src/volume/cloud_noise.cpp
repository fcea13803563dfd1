#include "volume/cloud_noise.h"

#include <algorithm>

#include "math/perlin_noise.h"

namespace tyndall {
namespace {

/// Gradient of the noise by forward differences of 0.01, as pbrt takes it.
Vec3 noise_slope(Vec3 p) {
  constexpr float kDelta = 0.01f;
  const NoiseCell cell(p);
  const float n = cell.at(p);
  const auto rise = [&](Vec3 step) {
    const Vec3 q = p + step;
    return ((cell.holds(q) ? cell.at(q) : perlin_noise(q)) - n) / kDelta;
  };
  return {rise({kDelta, 0, 0}), rise({0, kDelta, 0}), rise({0, 0, kDelta})};
}

}  // namespace

float cloud_density(const CloudMedium& cloud, Vec3 p) {
  if (p.y <= 0) return 1;  // noise only adds there
  Vec3 q = cloud.frequency * p;
  if (cloud.wispiness > 0) {
    float omega = 0.05f * cloud.wispiness, lambda = 10;
    for (int i = 0; i < 2; ++i) {
      q += omega * noise_slope(lambda * q);
      omega *= 0.5f;
      lambda *= 1.99f;
    }
  }

  float noise = 0, omega = 0.5f, lambda = 1;
  for (int i = 0; i < 5; ++i) {
    noise += omega * perlin_noise(lambda * q);
    omega *= 0.5f;
    lambda *= 1.99f;
  }

  const float thinning = std::clamp((1 - p.y) * 4.5f * cloud.density * noise, 0.0f, 1.0f);
  return std::clamp(thinning + 2 * std::max(0.0f, 0.5f - p.y), 0.0f, 1.0f);
}

}  // namespace tyndall
