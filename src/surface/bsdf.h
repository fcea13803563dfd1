/// What a surface does with light at one point.
#pragma once

#include <optional>
#include <variant>

#include "math/frame.h"
#include "surface/bsdf_sample.h"
#include "surface/clear_coat.h"
#include "surface/conductor.h"
#include "surface/dielectric.h"
#include "surface/diffuse.h"
#include "surface/highlight.h"
#include "surface/layered.h"

namespace tyndall {

/// A BSDF with its frame: a small value, no heap. Directions are unit, in world space, and both leave the surface.
/// Sides are judged by the shading normal alone, as in pbrt-v4.
///
/// Radiance transport: a transmission includes the factor 1/eta^2. pdf() is the exact density of sample() except of
/// LayeredLobe, whose walk has none in closed form: there it is a deterministic proxy. MIS stays unbiased as long as both
/// techniques weigh with pdf(), since weight is an unbiased estimate on its own.
class Bsdf {
 public:
  using Lobe = std::variant<DiffuseLobe, DiffuseTransmissionLobe, ConductorLobe, DielectricLobe, ThinDielectricLobe,
                            PassThroughLobe, ClearCoatLobe, CoatedDiffuseLobe, CoatedConductorLobe>;

  Bsdf() = default;  ///< black
  Bsdf(const Frame& shading, const Lobe& lobe) : frame_(shading), lobe_(lobe) {}

  Vec3 normal() const { return frame_.z; }  ///< of the shading frame

  /// f(wo, wi) |cos wi|; 0 for specular lobes.
  Rgb eval(Vec3 wo, Vec3 wi) const;
  /// 1/sr; 0 for specular lobes.
  float pdf(Vec3 wo, Vec3 wi) const;
  /// Nothing when the light is absorbed or no direction can be had. All arguments in [0, 1).
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;

  /// Where samples are mirrored by chance, others not: what the former bring.
  std::optional<MirrorPart> mirror_part(Vec3 wo) const;

  /// Share of the light that goes straight through where that is all that is not mirrored, as of panes; 0: bent or spread.
  float unbent(Vec3 wo) const;

  /// eval(wo, .) in outline: the lobes about the mirrored and the refracted direction, and the rest.
  Highlights highlights(Vec3 wo) const;

  /// Some lobe is not specular: next-event estimation makes sense.
  bool has_smooth() const;
  /// pdf() is the density of sample(), no proxy for it.
  bool has_exact_pdf() const;
  /// For wo on one side eval(wo, wi) is a factor of wo times a function of wi: what is scattered, but for what is mirrored by
  /// chance, has forgotten where it came from.
  bool separable() const;
  SeparablePart separable_part(Vec3 wo) const;  ///< of a separable one
  bool reflects() const;
  bool transmits() const;
  /// Share of the power arriving along wo that is reflected or transmitted; an estimate where no closed form exists.
  Rgb albedo(Vec3 wo) const;

 private:
  Frame frame_;
  Lobe lobe_;
};

}  // namespace tyndall
