/// From a scene's materials to the BSDF at a point.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "surface/bsdf.h"
#include "surface/bump.h"
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
  Vec3 ng{};                              ///< unit geometric normal
  const SurfaceDetail* detail = nullptr;  ///< for materials of which wants_detail() says so
  std::optional<int> channel{};           ///< of a path that a dispersive surface has narrowed to one
};

/// The scene's materials, ready to evaluate. Immutable and safe to use from any number of threads. `textures` must
/// outlive it.
class Materials {
 public:
  /// Throws Error (scene) at the material's place: an index out of range, or a mix that contains itself.
  Materials(const Scene& scene, const Textures& textures);

  /// The Bsdf may refer to what is kept here.
  Bsdf bsdf(MaterialId id, const SurfaceQuery& query) const;
  /// No optical effect: the path goes on as if nothing were there.
  bool is_interface(MaterialId id) const;
  /// Whether its look depends on SurfaceQuery::detail: bent normals, textures that know their footprint.
  bool wants_detail(MaterialId id) const { return traits_[id].wants_detail; }
  /// Whether the normal of its bsdf() may be another than the surface's.
  bool bends_normals(MaterialId id) const { return traits_[id].bends_normals; }
  /// Whether it refracts each channel in a direction of its own: bsdf() needs SurfaceQuery::channel.
  bool is_dispersive(MaterialId id) const { return traits_[id].is_dispersive; }
  /// Whether light of all channels may go straight through it (Bsdf::unbent).
  bool is_pane(MaterialId id) const { return traits_[id].is_pane && !traits_[id].is_dispersive; }
  std::size_t size() const { return materials_.size(); }

 private:
  struct Traits {
    bool wants_detail = false, bends_normals = false, is_dispersive = false, is_pane = false;
    void add(const Traits& other) {
      wants_detail |= other.wants_detail;
      bends_normals |= other.bends_normals;
      is_dispersive |= other.is_dispersive;
      is_pane |= other.is_pane;
    }
    bool operator==(const Traits&) const = default;
  };
  Traits own_traits(const Material& m) const;
  void find_shares();

  std::vector<Material> materials_;
  std::vector<Traits> traits_;
  std::vector<std::shared_ptr<const CoatShares>> shares_;  ///< of materials with such coats
  const Textures* textures_;
};

}  // namespace tyndall
