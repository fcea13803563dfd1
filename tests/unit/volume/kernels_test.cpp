/// Numeric kernels of src/volume against their promises, at their worst.
#include "support/adversarial.h"
#include "volume/grid_ray.h"
#include "volume/phase/phase.h"
#include "volume/phase/phase_mix.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("kernels: phase functions") {
  check_kernel("Henyey-Greenstein", [](Adversary& any) {
    const HenyeyGreenstein phase{any.between(-1, 1)};
    const Vec3 wo = any.direction();
    const PhaseSample s = phase.sample(wo, any.square());
    const bool sound = std::abs(length(s.wi) - 1) < 1e-5f && std::isfinite(s.pdf) && s.pdf > 0;
    return holds(sound && s.pdf == phase.pdf(wo, s.wi), phase.g, wo, s.wi, s.pdf);
  });
  const auto check = [](const char* name, const auto& draw) {
    check_kernel(name, [&](Adversary& any) {
      const Phase phase = draw(any);
      const Vec3 wo = any.direction();
      const PhaseSample s = sample(phase, wo, any.square());
      const bool sound = std::abs(length(s.wi) - 1) < 1e-5f && std::isfinite(s.pdf) && s.pdf > 0;
      return holds(sound && s.pdf == pdf(phase, wo, s.wi), mean_cosine(phase), wo, s.wi, s.pdf);
    });
  };
  check("Rayleigh", [](Adversary&) { return Rayleigh(); });
  check("Draine", [](Adversary& any) {
    const float g = any.between(-1, 1);
    return Draine(std::clamp(g, -0.9999f, 0.9999f), any.chance() ? 0 : any.between(0, 1000));
  });
  check("Mie", [](Adversary& any) { return Mie(any.between(0.01f, Mie::kLargest)); });
  check_kernel("mixture", [](Adversary& any) {
    PhaseMix mix;
    const int media = 1 + static_cast<int>(any.below(3));
    std::array<Phase, 3> phases;
    for (int i = 0; i < media; ++i) {
      phases[i] = HenyeyGreenstein{any.between(-0.99f, 0.99f)};
      mix.add(Rgb(any.positive(20), any.chance() ? any.positive(20) : 0, 1), phases[i]);
    }
    const Vec3 wo = any.direction();
    const Rgb beta(any.positive(20), any.positive(20), any.positive(20));
    const float uc = any.unit();
    const auto s = mix.sample(wo, beta, uc, any.square());
    if (!s) return holds(false, wo, uc);
    const bool sound = std::abs(length(s->wi) - 1) < 1e-5f && std::isfinite(s->pdf) && s->pdf > 0 && is_finite(s->weight);
    return holds(sound && std::abs(s->pdf - mix.pdf(wo, s->wi, beta)) <= 1e-4f * s->pdf, wo, uc, s->wi, s->pdf);
  });
}

TEST_CASE("kernels: rays and boxes") {
  check_kernel("clip", [](Adversary& any) {
    Box3d box;
    Vec3 o, d = any.direction();
    for (int i = 0; i < 3; ++i) {
      box.lo[i] = any.real(20);
      box.hi[i] = box.lo[i] + (any.chance() ? any.positive(20) : 0.0f);
      o[i] = any.chance() ? static_cast<float>(box.lo[i]) : any.real(20);
    }
    const double t0 = any.positive(20), t1 = any.chance() ? t0 + any.positive(20) : double(kInfinity);
    const GridRay ray(Affine{}, {o, d});
    const auto [begin, end] = ray.clip(box, t0, t1);
    if (!(begin < end)) return Fault();
    if (!(begin >= t0 && end <= t1 && end < kInfinity)) return holds(false, o, d, t0, t1, begin, end);
    const GridVec middle = ray.at(0.5 * (begin + end));
    double off = 0, size = 0;
    for (int i = 0; i < 3; ++i) {
      off = std::max({off, box.lo[i] - middle[i], middle[i] - box.hi[i]});
      size = std::max({size, std::abs(box.lo[i]), std::abs(box.hi[i]), std::abs(double(o[i]))});
    }
    return holds(off <= 1e-12 * (size + end), o, d, t0, t1, begin, end, off);
  });
}
