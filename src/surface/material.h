/// From a scene's materials to the BSDF at a point.
#pragma once

#include <vector>

#include "surface/bsdf.h"
#include "texture/textures.h"
#include "tyndall/scene.h"

namespace tyndall {

/// One point of a surface, seen from one direction.
struct SurfaceQuery {
  Vec3 p;  ///< world space
  Vec2 uv;
  Frame shading;  ///< z = shading normal (pbrt's orientation), x along dp/du
  Vec3 wo;        ///< unit, leaves the surface
  /// [0, 1), a hash of p and wo: makes the choice of mix materials and seeds the walks of coated ones.
  float random = 0.5f;
};

/// The scene's materials, ready to evaluate. Immutable and safe to use from any number of threads. `textures` must
/// outlive it.
class Materials {
 public:
  /// Throws Error (scene) at the material's place: an index out of range, or a mix that contains itself.
  Materials(const Scene& scene, const Textures& textures);

  Bsdf bsdf(MaterialId id, const SurfaceQuery& query) const;
  /// No optical effect: the path goes on as if nothing were there.
  bool is_interface(MaterialId id) const;
  std::size_t size() const { return materials_.size(); }

 private:
  std::vector<Material> materials_;
  const Textures* textures_;
};

}  // namespace tyndall
