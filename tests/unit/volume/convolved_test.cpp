#include "volume/phase/convolved.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "math/rng.h"

namespace tyndall {
namespace {

const std::vector<Phase>& phases() {
  static const std::vector<Phase> all{HenyeyGreenstein{0},
                                      HenyeyGreenstein{0.5f},
                                      HenyeyGreenstein{-0.7f},
                                      HenyeyGreenstein{.95f},
                                      Rayleigh{},
                                      Draine(0.05f, 3),
                                      Draine(-0.08f, 1),
                                      Draine(0.1f, 1),
                                      Draine(0.6f, 4),
                                      Draine(-0.6f, 1),
                                      Draine(0.9f, 20),
                                      Mie(1),
                                      Mie(5),
                                      Mie(20)};
  return all;
}

Vec3 tilted(float below) { return {std::sqrt(std::max(below * (2 - below), 0.0f)), 0, 1 - below}; }

/// By Legendre polynomials: what convolves multiplies their moments, and lobes of mean cosine h have the powers of h.
class Series {
 public:
  explicit Series(const Phase& phase) {
    constexpr int kSteps = 40'000;
    double low = 0;
    for (int i = 1; i <= kSteps; ++i) {  // Gauss's rule of two points in steps that are finer forward
      const double high = 2 * std::pow(static_cast<double>(i) / kSteps, 4);
      for (const double at : {0.2113248654051871, 0.7886751345948129}) {
        const double x = low + at * (high - low);
        const double value = pdf(phase, {0, 0, -1}, tilted(static_cast<float>(x)));
        for_each_polynomial(1 - x, [&](std::size_t l, double p) { moments_[l] += kPi * (high - low) * value * p; });
      }
      low = high;
    }
  }
  double blurred(double h, double below) const {
    double sum = 0;
    for_each_polynomial(1 - below, [&](std::size_t l, double p) {
      sum += (2 * static_cast<double>(l) + 1) / (4 * double{kPi}) * moments_[l] * std::pow(h, static_cast<double>(l)) * p;
    });
    return sum;
  }

 private:
  template <typename Body>
  void for_each_polynomial(double cosine, const Body& body) const {
    double p = 1, before = 0;
    for (std::size_t l = 0; l < moments_.size(); ++l) {
      body(l, p);
      const auto n = static_cast<double>(l);
      before = std::exchange(p, ((2 * n + 1) * cosine * p - n * before) / (n + 1));
    }
  }
  std::vector<double> moments_ = std::vector<double>(300);
};

TEST_CASE("kernels: phase functions blurred by lobes are as the series of polynomials says") {
  for (const Phase& phase : phases()) {
    const Series series(phase);
    double worst = 0;
    for (const float below : {0.0f, 1e-3f, 0.05f, 0.4f, 1.0f, 1.7f, 2.0f}) {
      const float h[8] = {0, 0.05f, 0.2f, 0.4f, 0.6f, 0.8f, 0.9f, 0.96f};
      const Float8 all = convolved(phase, load8(h), below);
      for (int i = 0; i < 8; ++i)
        worst = std::max(worst, std::abs(all[static_cast<std::size_t>(i)] / series.blurred(h[i], below) - 1));
    }
    CHECK_MESSAGE(worst < 2e-3, "kind " << phase.index() << ", mean cosine " << mean_cosine(phase) << ": " << worst);
  }
}

TEST_CASE("kernels: a lobe without width leaves a phase function as it is") {
  for (const Phase& phase : phases())
    for (const float below : {1e-4f, 0.05f, 0.4f, 1.0f, 1.7f, 2.0f}) {
      const float value = pdf(phase, {0, 0, -1}, tilted(below));
      const float blurred = convolved(phase, 1 - 0x1p-24f, below)[3];
      CHECK(blurred == doctest::Approx(value).epsilon(1e-3).scale(1e-30));
    }
}

TEST_CASE("no phase function is larger outside a cone than is said") {
  Rng rng(3);
  for (const Phase& phase : phases())
    for (int i = 0; i < 2000; ++i) {
      const float edge = 2 * rng.uniform() * rng.uniform(), below = edge + (2 - edge) * rng.uniform() * rng.uniform();
      CHECK(pdf(phase, {0, 0, -1}, tilted(below)) <= 1.00001f * most_beyond(phase, edge));
    }
}

}  // namespace
}  // namespace tyndall
