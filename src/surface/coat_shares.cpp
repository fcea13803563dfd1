#include "surface/coat_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "math/hash.h"
#include "math/sobol.h"
#include "surface/fresnel.h"

namespace tyndall {
namespace {

/// Nodes and weights of Gauss-Legendre quadrature, on [0, 1] [Abramowitz and Stegun 1964, table 25.4].
constexpr std::array kNodes = {0.0198550717512319, 0.1016667612931866, 0.2372337950418355, 0.4082826787521751,
                               0.5917173212478248, 0.7627662049581645, 0.8983332387068134, 0.9801449282487681};
constexpr std::array kWeights = {0.0506142681451883, 0.1111905172266872, 0.1568533229389435, 0.1813418916891809,
                                 0.1813418916891809, 0.1568533229389435, 0.1111905172266872, 0.0506142681451883};
/// Entries of `entering`.
constexpr int kEntries = 65;
/// Facets of a rough top that light from one direction is averaged over, and those for light from all: to 4e-4 and 2e-4.
constexpr int kFacets = 512, kFacetsOfAll = 16'384;

/// 2 int f(c) c dc over cosines c from `least` to `most`. c = least + (most - least) x^2 takes away the root with which
/// reflection is no longer total, and crowds where e^(-t / c) rises.
template <typename F>
double power_between(double least, double most, F f) {
  if (!(most > least)) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    const double x = kNodes[i], c = least + (most - least) * x * x;
    sum += kWeights[i] * 4 * (most - least) * x * c * f(c);
  }
  return sum;
}

/// Over all cosines, split where a smooth top of index `eta` no longer reflects all light from inside.
template <typename F>
double power_inside(float eta, F f) {
  const double total = std::sqrt(std::max(0.0, 1 - 1 / (double{eta} * double{eta})));
  return power_between(0, total, f) + power_between(total, 1, f);
}

double absorbed_to(double thickness, double cosine) { return std::exp(-thickness / cosine); }

/// Share of light from `wo` that a facet sends on as `mode` says and that reaches the coat's other side.
double by_facet(const DielectricLobe& top, double thickness, Vec3 wo, Vec2 u, LobeMode mode) {
  const auto s = top.sample(wo, 0, u, mode);
  return s && s->wi.z != 0 ? double{s->weight.r} * absorbed_to(thickness, std::abs(double{s->wi.z})) : 0.0;
}

/// Point number `i` of an even sequence on the square: the grid of a lattice would follow the seams of the map to facets.
Vec2 even_point(int i) {
  const auto unit = [](std::uint32_t bits) { return unit_float(std::uint64_t{bits} << 32); };
  const auto index = static_cast<std::uint32_t>(i);
  return {unit(owen_scramble(sobol_0(index), 0x9e3779b9u)), unit(owen_scramble(sobol_1(index), 0x85ebca6bu))};
}

Vec3 at_cosine(double cosine, bool above) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return {static_cast<float>(sine), 0, static_cast<float>(above ? cosine : -cosine)};
}

float entering_at(const DielectricLobe& top, double thickness, double cosine) {
  double sum = 0;
  for (int i = 0; i < kFacets; ++i) {
    sum += by_facet(top, thickness, at_cosine(cosine, true), even_point(i), kTransmittedImportance);
  }
  return static_cast<float>(sum / kFacets);
}

double back_by_facets(const DielectricLobe& top, double thickness) {
  double sum = 0;
  for (int i = 0; i < kFacetsOfAll; ++i) {
    const double cosine = std::sqrt((i + 0.5) / kFacetsOfAll);
    sum += absorbed_to(thickness, cosine) * by_facet(top, thickness, at_cosine(cosine, false), even_point(i), kReflected);
  }
  return sum / kFacetsOfAll;
}

CoatShares rough_shares(const DielectricLobe& top, double thickness) {
  CoatShares shares{back_by_facets(top, thickness), 0, {}};
  for (int i = 0; i < kEntries; ++i) {
    const double x = std::max(i / (kEntries - 1.0), 1e-3);
    shares.entering.push_back(entering_at(top, thickness, x * x));
    shares.out += 4 * x * x * x * double{shares.entering.back()} / (kEntries - 1) * (i + 1 < kEntries ? 1 : 0.5);
  }
  return shares;
}

}  // namespace

float enters_smooth(float eta, float thickness, float cosine) {
  const float inside2 = 1 - (1 - cosine * cosine) / (eta * eta);
  return inside2 > 0 ? (1 - fresnel_dielectric(cosine, eta)) * std::exp(-thickness / std::sqrt(inside2)) : 0.0f;
}

/// Light that leaves the surface and that which comes from outside pass a smooth top alike, but for the solid angle.
CoatShares coat_shares(const DielectricLobe& top, float thickness) {
  const double t = double{thickness}, eta = double{top.eta};
  if (!top.is_specular()) return rough_shares(top, t);
  const auto reflected = [&top](double c) { return double{fresnel_dielectric(static_cast<float>(c), 1 / top.eta)}; };
  const double back = power_inside(top.eta, [&](double c) { return reflected(c) * absorbed_to(2 * t, c); });
  const double out = power_inside(top.eta, [&](double c) { return (1 - reflected(c)) * absorbed_to(t, c); });
  return {back, out * eta * eta, {}};
}

}  // namespace tyndall
