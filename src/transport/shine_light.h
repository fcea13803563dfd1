/// What shining surfaces send straight to the camera, where the filter's own samples tell it badly: each sample of a pixel
///
/// - that sees small ones (film_shine.h) also takes the ray to a point of one of them;
/// - that sees where one begins or ends (film_edges.h) looks through several film positions in place of its own.
///
/// Both are weighed by MIS, surface by surface.
#pragma once

#include "transport/film_edges.h"
#include "transport/film_search.h"
#include "transport/film_shine.h"
#include "transport/light_context.h"

namespace tyndall {

/// Surfaces to aim at for the pixels: shining primitives that stand for themselves, not shared by instances. None where
/// settings or the camera do not have it: only rays of a pinhole that is not distorted are aimed.
FilmShine film_shine(const FilmSearch& search);

/// Pixels that look through several film positions. None where settings or the camera do not have it: only pinholes
/// do.
FilmEdges film_edges(const FilmSearch& search);

/// How a pixel's samples look at shining surfaces.
struct ShineView {
  PixelShine aims;
  bool edge = false;
  bool own_only() const { return aims.empty() && !edge; }
};

/// Unbiased estimate, for the pixel at `center`, of the share of that light which ShineRay::own_share does not leave to the
/// filter's own samples. Not where they are the only ones.
Rgb shine_light(const LightContext& context, const ShineView& view, Vec2 center, Sampler sampler);

/// The camera's ray that a pixel's filter drew. LightContext::shine points to it, all along its path.
class ShineRay {
 public:
  /// `pdf`: of its film position, 1/pixels^2. `view` must outlive it.
  ShineRay(const ShineView& view, float pdf) : view_(view), pdf_(pdf) {}
  /// MIS weight of what it meets of `light`, unscattered.
  float own_share(const BuiltWorld& world, LightId light, const EmitterHit& hit) const;

 private:
  const ShineView& view_;
  float pdf_;
};

}  // namespace tyndall
