/// Directly visible emission of surfaces where the filter's own samples estimate it badly: each sample of a pixel
///
/// - that sees small ones (film_emitters.h) also takes the ray to a point of one of them;
/// - that sees the outline of one (film_edges.h) averages over several film positions in place of its own.
///
/// Both are weighted by MIS, surface by surface.
#pragma once

#include "transport/film_edges.h"
#include "transport/film_emitters.h"
#include "transport/film_search.h"
#include "transport/light_context.h"

namespace tyndall {

/// Surfaces to aim at for the pixels: emissive primitives not shared by instances. None where settings or the camera rule it
/// out: only rays of a pinhole that is not distorted are aimed.
FilmEmitters film_emitters(const FilmSearch& search);

/// Pixels that average over several film positions: those that see outlines of what is as large as a pixel, and of smaller
/// `emitters` at which they do not aim. None where settings or the camera rule it out: only pinholes do.
FilmEdges film_edges(const FilmSearch& search, const FilmEmitters& emitters);

/// How a pixel's samples estimate directly visible emission.
struct EmitterView {
  PixelEmitters aims;
  bool edge = false;
  bool own_only() const { return aims.empty() && !edge; }
};

/// Unbiased estimate, for the pixel at `center`, of the share of that light which EmitterRay::path_mis_weight does not leave to
/// the filter's own samples. Not where they are the only ones.
Rgb visible_emitters(const LightContext& context, const EmitterView& view, Vec2 center, Sampler sampler);

/// The camera's ray that a pixel's filter drew. LightContext::emitters points to it, all along its path.
class EmitterRay {
 public:
  /// `pdf`: of its film position, 1/pixels^2. `view` must outlive it.
  EmitterRay(const EmitterView& view, float pdf) : view_(view), pdf_(pdf) {}
  /// MIS weight of the directly visible emission of `light` that it hits.
  float path_mis_weight(const BuiltWorld& world, LightId light, const EmitterHit& hit) const;

 private:
  const EmitterView& view_;
  float pdf_;
};

}  // namespace tyndall
