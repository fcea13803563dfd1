/// Light by way of one more collision, whose direction and distance are drawn together for a lamp.
///
/// Rays that were scattered without regard to lamps seldom pass one closely, and gather 1/distance of its light when they do:
/// among lamps in smoke these are the fireflies. A collision therefore also chooses a lamp without extent and a point near it
/// to scatter at once more (lamp_aim.h). Lamp by lamp, MIS weighs it against what the path's own next ray gathers.
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

/// Unbiased estimate of what the collision `vertex` and then one more scatter of lamps without extent, less what own_share()
/// leaves to the path's own ray. Multiply by the throughput.
Rgb joint_light(const LightContext& context, const Vertex& vertex, const JointSearch& search);

/// The ray that a path went on by from a collision that sought lamps jointly.
struct JointRay {
  JointSearch search;
  Vec3 w;
  float pdf;  ///< 1/sr, of going there
};

/// MIS weight of what context.joint gathers from `light` in media, by whatever technique: 1 for what has extent, and where there is
/// no such ray.
float own_share(const LightContext& context, LightId light);

}  // namespace tyndall
