/// Light by way of one more collision, whose direction and distance are drawn together for a lamp.
///
/// Rays that were scattered without regard to lamps seldom pass one closely, and gather 1/distance of its light when they do:
/// among lamps in smoke these are the fireflies. A collision therefore also chooses a point or spot light and a place near it,
/// where the light is scattered first (lamp_aim.h). Lamp by lamp, MIS weighs it against what the path's own next ray gathers.
/// film_light.h does the same for the camera's rays.
#pragma once

#include <optional>

#include "transport/joint_ray.h"
#include "transport/vertex.h"

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
class CollisionRay final : public JointRay {
 public:
  CollisionRay(const JointSearch& search, Vec3 w, float pdf) : search_(search), w_(w), pdf_(pdf) {}
  float own_share(const LightContext& context, LightId light) const override;

 private:
  JointSearch search_;
  Vec3 w_;
  float pdf_;  ///< 1/sr, of going there
};

}  // namespace tyndall
