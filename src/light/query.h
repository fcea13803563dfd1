/// The question put to light selection, and its answer.
#pragma once

#include <array>
#include <cstdint>

#include "math/small_vector.h"
#include "tyndall/math.h"

namespace tyndall {

/// Scene::lights in order, then the primitives of emissive shapes, of media that emit, of emissive instances.
using LightId = std::uint32_t;

/// A lobe of microfacets about the surface's normal n: light from wi is scattered by facets whose normals are along
/// h = wo + eta wi, and there are D(h) of them [Trowbridge and Reitz 1975; Walter et al. 2007]. Lengths of wo and wi in
/// the frame of tangent, bitangent and n.
struct QueryLobe {
  Vec3 tangent, bitangent;  ///< unit, with n a frame in which wo = (sin_o, 0, cos_o)
  float sin_o = 0, cos_o = 1;
  float eta = 1;                     ///< 1: light from n's side; else the relative index of the other
  float slope2_t = 0, slope2_b = 0;  ///< squared widths of the facets' slopes
  float spread_t = 0, spread_b = 0;  ///< what they widen by where the light's direction varies, times its variance
  float scale = 0;                   ///< of D(h) G into the unit of a cosine lobe of share 1
};

/// Where light is gathered: what the choice of a light may depend on. Scattered rays find environments too: those that are best
/// left to them (constant ones) have pmf 0.
struct PointQuery {
  Vec3 p;
  Vec3 n;                     ///< unit shading normal on the side of wo; zero in a medium
  bool transmissive = false;  ///< light from below the surface counts too
  float diffuse = 1;          ///< what a cosine lobe has of the scattering, > 0; lobes have the rest. Only surfaces have lobes
  int lobe_count = 0;
  std::array<QueryLobe, 2> lobes{};
  /// In a medium: mean cosine of the Henyey-Greenstein phase function, 0 for none, and the direction that it is about.
  float g = 0;
  Vec3 forward{};

  /// A surface that scatters some directions much more than others.
  bool glossy() const { return lobe_count > 0; }
};

struct SelectedLight {
  LightId light;
  float pmf;
};

/// A light that a vertex draws as a candidate; `n_pmf` is n * pmf, the mean number of candidates that are it.
struct LightCandidate {
  LightId light;
  float n_pmf;
};
using LightCandidates = SmallVector<LightCandidate, 8>;

}  // namespace tyndall
