#include "surface/layered_walk.h"

#include "math/frame.h"

namespace tyndall {

namespace {

float hg(float cosine, float g) {
  const float d = 1 + g * g - 2 * g * cosine;
  return 0.25f * kInvPi * (1 - g * g) / (d * std::sqrt(d));
}

/// Cosine between the directions of travel before and after [Henyey and Greenstein 1941].
float sample_hg_cosine(float u, float g) {
  if (std::abs(g) < 1e-3f) return 1 - 2 * u;
  const float s = (1 - g * g) / (1 + g - 2 * g * u);
  return std::clamp((1 + g * g - s * s) / (2 * g), -1.0f, 1.0f);
}

}  // namespace

LayerWalk::Event LayerWalk::advance() {
  const float height = coat.thickness;
  const Event ahead = w.z > 0 ? Event::top : Event::bottom;
  if (is_black(coat.albedo)) {
    beta *= transmittance(height, w);
  } else {
    const float dz = -std::log1p(-rng.uniform()) * std::abs(w.z);
    const float next = w.z > 0 ? z + dz : z - dz;
    if (ahead == Event::top ? next < height : next > 0) {
      z = next;
      return Event::scattering;
    }
  }
  z = ahead == Event::top ? height : 0;
  return ahead;
}

float LayerWalk::survive(int bounce) {
  const float power = max_component(beta) * eta * eta;
  if (bounce <= 3 || power >= 0.25f) return 1;
  if (!(rng.uniform() < power)) return 0;
  beta = beta / power;
  return power;
}

float LayerWalk::scatter() {
  const float cosine = sample_hg_cosine(rng.uniform(), coat.g);
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine)), phi = 2 * kPi * rng.uniform();
  w = normalize(Frame::around(w).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine}));
  beta *= coat.albedo;
  return hg(cosine, coat.g);
}

float LayerWalk::phase(Vec3 direction) const { return hg(dot(w, direction), coat.g); }

}  // namespace tyndall
