/// What sampling a BSDF gives, and how a lobe is asked for it.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

struct BsdfSample {
  Vec3 wi;            ///< unit, leaves the surface
  Rgb weight;         ///< f |cos wi| / (density it was drawn with)
  float pdf;          ///< 1/sr, as pdf(wo, wi); the discrete probability when specular
  bool specular;      ///< from a delta lobe: no other technique can find wi
  bool transmission;  ///< wi is on the other side of the shading plane
  /// Relative index crossed (n beyond / n here) by a transmission, else 1. Radiance was scaled by 1/eta^2.
  float eta = 1;
};

/// The mirror of a surface that is not one alone.
struct MirrorPart {
  Vec3 wi;  ///< unit, leaves the surface
  float f;  ///< share of the light from there that is mirrored, in (0, 1)
};

/// Of a surface that scatters, but for its mirror, by a factor of either direction.
struct SeparablePart {
  float factor = 1;  ///< of wo, up to a constant
  float chance = 1;  ///< that what is sampled from there is not mirrored
};

/// A restriction of a dielectric lobe, used by the walk inside a coating.
struct LobeMode {
  enum class Transport { radiance, importance } transport = Transport::radiance;  ///< importance: no 1/eta^2
  enum class Sides { both, reflection, transmission } sides = Sides::both;        ///< what may be sampled
};

inline constexpr LobeMode kReflected{LobeMode::Transport::radiance, LobeMode::Sides::reflection};
inline constexpr LobeMode kTransmitted{LobeMode::Transport::radiance, LobeMode::Sides::transmission};
inline constexpr LobeMode kTransmittedImportance{LobeMode::Transport::importance, LobeMode::Sides::transmission};

/// Both directions are strictly on the same side of the local xy plane.
constexpr bool same_side(Vec3 a, Vec3 b) { return (a.z > 0 && b.z > 0) || (a.z < 0 && b.z < 0); }
constexpr bool opposite_sides(Vec3 a, Vec3 b) { return (a.z > 0 && b.z < 0) || (a.z < 0 && b.z > 0); }

}  // namespace tyndall
