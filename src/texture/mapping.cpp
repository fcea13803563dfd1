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

std::array<Vec2, 2> steps_of_texture(const TextureMapping& mapping, const TextureQuery& query) {
  if (query.footprint == nullptr) return {};
  const Footprint& f = *query.footprint;
  const Vec2 here = map_to_texture(mapping, query);
  const auto step = [&](Vec3 dp, Vec2 duv) {
    TextureQuery beside = query;
    beside.p += dp;
    beside.uv = query.uv + duv;
    Vec2 d = map_to_texture(mapping, beside) - here;
    if (mapping.kind == TextureMapping::Kind::spherical) d.y -= std::round(d.y);  // not all around where an angle begins
    if (mapping.kind == TextureMapping::Kind::cylindrical) d.x -= std::round(d.x);
    return d;
  };
  return {step(f.dpdx, f.duvdx), step(f.dpdy, f.duvdy)};
}

}  // namespace tyndall
