#include "volume/aureole.h"

#include <algorithm>
#include <cmath>

#include "volume/phase/convolved.h"
#include "volume/phase/lobe_product.h"

namespace tyndall {
namespace {

/// Lobe i holds the orders of scattering from kFirst[i] to before kFirst[i + 1].
constexpr std::array<int, 9> kFirst{1, 2, 3, 5, 8, 13, 21, 34, Aureole::kMostOrders + 1};
/// Orders whose lobe would be wider count as even.
constexpr float kWidest = 0.1f;
/// Phase functions that turn light more than this leave nothing of its direction to go by.
constexpr float kLeastForward = 0.25f;
/// What has been turned often comes from everywhere: twice and more where much of a medium is lit, hardly where a sun's light
/// passes through (docs/measurements.md). Paths for which this is too little weigh more and more, and are then doubted.
constexpr float kDiffuse = 1;
/// Surfaces send light back too. What is not expected may still come: even light is what bounds the weights of paths that
/// find it.
constexpr float kReturned = 0.25f;
/// Guiding by less costs more than it saves.
constexpr float kLeastShare = 1 / 64.0f;
constexpr float kDeepest = 80;

float below_of(Vec3 a, Vec3 b) { return 0.5f * length_squared(a - b); }

}  // namespace

void Aureole::add(const Source& source) {
  const auto [g, albedo, orders] = medium_;
  const float tau = std::min(source.optical_depth, kDeepest);
  // Scattered at least once, and not absorbed.
  const float unscattered = std::exp(-tau);
  float left = std::exp(tau * (albedo - 1)) - unscattered;
  even_ += doubt_ * source.fluence * (kReturned + kDiffuse * std::pow(albedo, 1 / (1 - std::min(g, 0.99f))));
  if (g >= kLeastForward) {
    Lobes& lobes = sources_[count_++];
    lobes.axis = source.direction;
    float chance = unscattered, cosine = source.bundled;  // of an order, and its mean cosine
    int order = 0;
    for (std::size_t i = 0; i < kLobes; ++i) {
      float mass = 0, moment = 0;
      while (order + 1 < kFirst[i + 1]) {
        ++order;
        chance *= tau * albedo / static_cast<float>(order);
        cosine *= g;
        if (cosine < kWidest) break;
        left -= chance;
        if (order <= orders) mass += chance, moment += chance * cosine;
      }
      lobes.fluence[i] = source.fluence * mass;
      lobes.bundled[i] = mass > 0 ? moment / mass : 0.0f;
    }
  }
  even_ += doubt_ * source.fluence * std::max(left, 0.0f);
}

bool Aureole::shows() const {
  float shaped = 0;
  for (std::size_t i = 0; i < count_; ++i) shaped += reduce(load8(sources_[i].fluence.data()));
  return shaped > kLeastShare * (shaped + even_) && std::isfinite(shaped + even_);
}

float Aureole::radiance(Vec3 w) const {
  float sum = even_ / (4 * kPi);
  for (std::size_t i = 0; i < count_; ++i) {
    const Lobes& lobes = sources_[i];
    const Float8 h = load8(lobes.bundled.data()), away = 1.0f - h;
    const Float8 d = away * away + 2.0f * h * below_of(w, lobes.axis);
    sum += reduce(load8(lobes.fluence.data()) * (away * (1.0f + h)) / (d * sqrt(d))) / (4 * kPi);
  }
  return sum;
}

Float8 Aureole::products(const Lobes& lobes, const Phase& phase, float below) {
  return load8(lobes.fluence.data()) * convolved(phase, load8(lobes.bundled.data()), below);
}

float Aureole::scattered(const PhaseMix& phase, Vec3 wo, Rgb beta) const {
  float sum = even_ / (4 * kPi);
  for (std::size_t i = 0; i < count_; ++i) {
    const float below = below_of(sources_[i].axis, -wo);
    for (std::size_t l = 0; l < phase.lobe_count(); ++l)
      sum += phase.chance(l, beta) * reduce(products(sources_[i], phase.phase(l), below));
  }
  return sum;
}

/// Even light is drawn by the phase function alone.
Vec3 Aureole::sample(const PhaseMix& phase, Vec3 wo, Rgb beta, Rng& rng) const {
  float left = rng.uniform() * scattered(phase, wo, beta);
  std::size_t l = 0;
  for (; l < phase.lobe_count(); ++l) {
    const float chance = phase.chance(l, beta);
    for (std::size_t i = 0; i < count_; ++i) {
      const Float8 mass = chance * products(sources_[i], phase.phase(l), below_of(sources_[i].axis, -wo));
      const float all = reduce(mass);
      if (left >= all) {
        left -= all;
        continue;
      }
      std::size_t k = 0;
      for (; k + 1 < kLobes && left >= mass[k]; ++k) left -= mass[k];
      while (k > 0 && !(mass[k] > 0)) --k;  // rounded beyond the last
      return sample_product(phase.phase(l), wo, {sources_[i].axis, sources_[i].bundled[k]}, rng);
    }
    const float even = chance * even_ / (4 * kPi);
    if (left < even || l + 1 == phase.lobe_count()) break;
    left -= even;
  }
  const float u = rng.uniform();
  return tyndall::sample(phase.phase(l), wo, {u, rng.uniform()}).wi;
}

}  // namespace tyndall
