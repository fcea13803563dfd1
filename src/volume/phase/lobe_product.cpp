#include "volume/phase/lobe_product.h"

#include "volume/phase/convolved.h"

namespace tyndall {
namespace {

/// Far beyond what any pair of lobes takes (docs/measurements.md); then the phase function alone.
constexpr int kMostTries = 1 << 16;

float below_of(Vec3 a, Vec3 b) { return 0.5f * length_squared(a - b); }

/// Where either factor may be bounded, and by how much. A direction is farther than half the angle between the two peaks from
/// one of them.
class Bounds {
 public:
  Bounds(const Phase& phase, Vec3 forward, const DirectionLobe& lobe) : forward_(forward) {
    const HenyeyGreenstein hg{lobe.bundled};
    const float middle = length(forward + lobe.axis);  // 2 cos of half the angle
    half_ = 1 - std::min(0.5f * middle, 1.0f);
    lobe_ = most_beyond(hg, 0), phase_ = most_beyond(phase, 0);
    lobe_beyond_ = most_beyond(hg, half_), phase_beyond_ = most_beyond(phase, half_);
    const float both = lobe_beyond_ + phase_beyond_;
    split_ = both < lobe_ && both < phase_;
  }

  /// Whether to propose by the phase function, and the bound of the lobe's value then; else by the lobe.
  bool by_phase(Rng& rng) const {
    if (!split_) return lobe_ <= phase_;
    return rng.uniform() * (lobe_beyond_ + phase_beyond_) < lobe_beyond_;
  }
  float of_lobe() const { return split_ ? lobe_beyond_ : lobe_; }
  float of_phase() const { return split_ ? phase_beyond_ : phase_; }
  /// Each side of the split belongs to one of the proposals.
  bool is_near(Vec3 w) const { return below_of(w, forward_) < half_; }
  bool split() const { return split_; }

 private:
  Vec3 forward_;
  float half_, lobe_, phase_, lobe_beyond_, phase_beyond_;
  bool split_;
};

}  // namespace

Vec3 sample_product(const Phase& phase, Vec3 wo, const DirectionLobe& lobe, Rng& rng) {
  const HenyeyGreenstein hg{lobe.bundled};
  const Bounds bounds(phase, -wo, lobe);
  const auto draw = [&](const auto& from, Vec3 toward) {
    const float u = rng.uniform();
    return sample(from, toward, {u, rng.uniform()}).wi;
  };
  for (int i = 0; i < kMostTries; ++i) {
    const bool by_phase = bounds.by_phase(rng);
    const Vec3 w = by_phase ? draw(phase, wo) : draw(Phase(hg), -lobe.axis);
    if (bounds.split() && bounds.is_near(w) != by_phase) continue;
    const float value = by_phase ? hg.pdf(-lobe.axis, w) : pdf(phase, wo, w);
    if (rng.uniform() * (by_phase ? bounds.of_lobe() : bounds.of_phase()) < value) return w;
  }
  return draw(phase, wo);
}

}  // namespace tyndall
