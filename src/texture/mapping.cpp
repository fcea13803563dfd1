#include "texture/mapping.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

Vec2 spherical(Vec3 q) {
  const Vec3 d = normalize(q);
  const float phi = std::atan2(d.y, d.x);
  return {std::acos(std::clamp(d.z, -1.0f, 1.0f)) * kInvPi, (phi < 0 ? phi + 2 * kPi : phi) * (0.5f * kInvPi)};
}

Vec2 cylindrical(Vec3 q) { return {(kPi + std::atan2(q.y, q.x)) * (0.5f * kInvPi), q.z}; }

}  // namespace

Vec2 map_to_texture(const TextureMapping& mapping, const TextureQuery& query) {
  switch (mapping.kind) {
    case TextureMapping::Kind::spherical:
      return spherical(mapping.to_texture.point(query.p));
    case TextureMapping::Kind::cylindrical:
      return cylindrical(mapping.to_texture.point(query.p));
    case TextureMapping::Kind::planar: {
      const Vec3 q = mapping.to_texture.point(query.p);
      return mapping.offset + Vec2{dot(q, mapping.v1), dot(q, mapping.v2)};
    }
    case TextureMapping::Kind::uv:
      break;
  }
  return {mapping.scale.x * query.uv.x + mapping.offset.x, mapping.scale.y * query.uv.y + mapping.offset.y};
}

}  // namespace tyndall
