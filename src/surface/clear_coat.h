/// A diffuse surface under a clear coat: what the walks of LayeredLobe come to on average there, in closed form.
#pragma once

#include <optional>
#include <span>

#include "surface/coat_shares.h"
#include "surface/layered.h"

namespace tyndall {

/// What the coat's top reflects, and an even part: f |cos| = base enters(wo) enters(wi) |cos wi| / pi. Light forgets on the
/// surface where it came from, so the two passages of the coat are apart. Alike from both sides, as LayeredLobe.
struct ClearCoatLobe {
  /// `reflectance` in [0, 1] of the surface; of `coat` its thickness and bounces matter. `shares`: coat_shares() of both, which
  /// the lobe refers to.
  ClearCoatLobe(const DielectricLobe& top, Rgb reflectance, const Coat& coat, const CoatShares& shares);

  Rgb eval(Vec3 wo, Vec3 wi) const;
  float pdf(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float uc, Vec2 u) const;
  bool has_smooth() const { return !is_black(base_) || top_.has_smooth(); }
  bool reflects() const { return true; }
  bool transmits() const { return false; }
  Rgb albedo(Vec3 wo) const;
  /// Share of light that a smooth top mirrors; 0 under rough ones.
  float mirrored(Vec3 wo) const { return top_.is_specular() ? reflected(wo) : 0.0f; }

  const DielectricLobe& top() const { return top_; }
  /// Share of light that the top's mean plane reflects, and of what the surface under it gives back.
  float reflected(Vec3 wo) const;
  Rgb even_albedo(Vec3 wo) const { return base_ * (enters(wo) * out_); }
  /// Whether all is mirrored but the even part.
  bool separable() const { return top_.is_specular() && !is_black(base_); }
  SeparablePart separable_part(Vec3 wo) const;

 private:
  float enters(Vec3 w) const;
  float top_probability(Vec3 wo) const;
  float even_pdf(Vec3 wi) const;
  Vec3 sample_even(Vec2 u) const;

  DielectricLobe top_;
  float thickness_, out_;
  std::span<const float> entering_;
  Rgb base_;
};

}  // namespace tyndall
