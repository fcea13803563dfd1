/// A point where a path scatters: on a surface or in a medium, behind one interface.
#pragma once

#include <optional>
#include <variant>

#include "light/lights.h"
#include "surface/bsdf.h"
#include "surface/geometry.h"
#include "transport/media/media_state.h"
#include "volume/phase/phase_mix.h"

namespace tyndall {

/// A direction drawn at a vertex.
struct ScatterSample {
  Vec3 wi;
  Rgb weight;                  ///< scattering function (with cosine at surfaces) / density
  float pdf;                   ///< 1/sr
  bool specular;               ///< next-event estimation cannot reach it
  float eta = 1;               ///< relative index crossed
  bool mirrored = false;       ///< as Vertex::mirror_part() says
  float guided_pdf_ratio = 1;  ///< pdf, by that of the scattering function alone
};

class Vertex {
 public:
  /// A surface point seen along `wo`; `media` is the membership on that side.
  struct Surface {
    SurfaceHit hit;
    Bsdf bsdf;
  };
  struct InMedium {
    Vec3 p;
    PhaseMix phase;
  };

  Vertex(Surface surface, Vec3 wo, const MediaState& media);
  Vertex(InMedium medium, Vec3 wo, const MediaState& media);

  Vec3 p() const;
  Vec3 wo() const { return wo_; }
  const MediaState& media() const { return media_; }                       ///< on the side of wo
  const Surface* surface() const { return std::get_if<Surface>(&kind_); }  ///< nullptr in a medium
  bool on_surface() const { return std::holds_alternative<Surface>(kind_); }
  const InMedium* medium() const { return std::get_if<InMedium>(&kind_); }  ///< nullptr on a surface

  /// How light selection sees this vertex: with the directions that it favours.
  PointQuery light_query() const;
  /// Some light arriving from a sampled direction could be scattered: next-event estimation makes sense.
  bool has_smooth() const;
  /// pdf() is the density of sample(), no proxy for it.
  bool has_exact_pdf() const { return !on_surface() || surface()->bsdf.has_exact_pdf(); }

  /// f |cos| at surfaces; the phase function in media (the albedo is in the collision's weight).
  Rgb eval(Vec3 wi) const;
  /// 1/sr, of sample(); `beta` is the path's throughput, which steers the choice between overlapping phase functions.
  float pdf(Vec3 wi, Rgb beta) const;
  std::optional<ScatterSample> sample(Rgb beta, float uc, Vec2 u) const;

  /// Of a surface that mirrors by chance.
  std::optional<MirrorPart> mirror_part() const { return on_surface() ? surface()->bsdf.mirror_part(wo_) : std::nullopt; }

  /// Of a surface: share of light that goes straight through (Bsdf::unbent).
  float unbent() const { return on_surface() ? surface()->bsdf.unbent(wo_) : 0.0f; }

  /// Reflectance plus transmittance of a surface; 1 in media, where it is in the collision's weight.
  Rgb albedo() const;

  /// Origin of a ray that leaves along `wi`.
  Vec3 origin(const Geometry& geometry, Vec3 wi) const;
  /// Membership of origin(geometry, wi): a direction through a surface passes the boundaries that lie in it.
  MediaState media_toward(const Geometry& geometry, Vec3 wi) const;

 private:
  std::variant<Surface, InMedium> kind_;
  Vec3 wo_;
  MediaState media_;
};

}  // namespace tyndall
