/// Light by way of one more collision, whose direction and distance are drawn together for a lamp.
///
/// Rays that were scattered without regard to lamps seldom pass one closely, and gather 1/distance of its light when they do:
/// among lamps in smoke these are the fireflies. A collision therefore also chooses a point or spot light and a place near it,
/// where the light is scattered first (lamp_aim.h). Lamp by lamp, MIS weighs it against what the path's own next ray gathers.
#pragma once

#include <optional>

#include "render/light_context.h"
#include "render/vertex.h"

namespace tyndall {

/// How a collision seeks lamps for the next one: joint_light goes by it, and MIS must know it along the path's own ray.
struct JointSearch {
  PointQuery query;
  LightCut cut;
  ActiveMedia media;  ///< at the collision
  Bounds3 reach;      ///< of those media: lamps beyond are left to the path
};
/// Nothing where no lamp is sought that way: on surfaces, at a path's last event, and as settings say.
std::optional<JointSearch> joint_search(const LightContext& context, const Vertex& vertex);

/// Unbiased estimate of lamps' light that is scattered once more before `vertex` scatters it: the share of it that
/// own_share() does not leave to the path's own ray. Multiply by the throughput.
Rgb joint_light(const LightContext& context, const Vertex& vertex, const JointSearch& search);

/// The ray that a path went on by from a collision that sought lamps jointly.
struct JointRay {
  JointSearch search;
  Vec3 w;
  float pdf;  ///< 1/sr, of going there
};

/// MIS weight of what context.joint gathers from `light` in media, by whatever technique: 1 where there is no such ray, and for
/// other lights than points and spots.
float own_share(const LightContext& context, LightId light);

}  // namespace tyndall
