/// What a ray has met, as a vertex.
#pragma once

#include <algorithm>
#include <optional>

#include "transport/vertex/vertex.h"
#include "transport/world/built_world.h"

namespace tyndall {

/// `wo`: unit, back along the ray; `media`: membership on that side. `channel`: the only one that is asked about, needed where
/// the material is dispersive.
Vertex surface_vertex(const BuiltWorld& world, const SurfaceHit& hit, Vec3 wo, const MediaState& media,
                      std::optional<int> channel);

/// Whether it is on a surface that light goes straight through, or is mirrored by.
inline bool is_pane(const BuiltWorld& world, const Vertex& vertex) {
  return world.has_panes && vertex.unbent() > 0 && world.materials.is_pane(world.material_of(vertex.surface()->hit));
}

/// A ray on the other side of a pane that it has passed straight on.
struct BehindPane {
  Ray ray;
  MediaState media;
  float unbent;  ///< share of light that passes
};
/// Where `ray` has met `hit` from where `media` are; nothing where that is no pane.
std::optional<BehindPane> behind_pane(const BuiltWorld& world, const Ray& ray, const SurfaceHit& hit, const MediaState& media);

/// A channel by a number in [0, 1), and the throughput that makes up for the others.
inline int channel_by(float u) { return std::min(static_cast<int>(3 * u), 2); }
inline Rgb only(int channel) {
  Rgb one;
  one[channel] = 3;
  return one;
}

}  // namespace tyndall
