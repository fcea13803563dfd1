/// Light by one more collision, whose direction and distance are drawn together for a point or spot light.
///
/// Rays scattered by the phase function alone seldom pass a light closely, and gather 1/distance of its light when they do: in
/// smoke with many lights these are the fireflies. A collision therefore also chooses a point or spot light and a place near
/// it, where the light is scattered first (point_aim.h). Light by light, MIS weights it against what the path's own next ray
/// gathers. camera_joint.h does the same for the camera's rays.
#pragma once

#include <optional>

#include "transport/techniques/mis.h"
#include "transport/vertex/vertex.h"

namespace tyndall {

/// A path's segment from a vertex or the camera to where it scatters next.
struct PathSegment {
  const MediaState& start;  ///< media at its origin; must outlive it
  Ray ray;
  float t;  ///< > 0, length
};
/// Unbiased estimate of what media at the segment's end scatter back along it of a point or spot light: radiance per length,
/// times the square of the distance between that end and the light, since neither factor stays bounded near it.
Rgb in_scattered(const LightContext& context, const PathSegment& segment, LightId point, Sampler& sampler);

/// How a collision samples lights for the next one: joint_estimate uses it, and MIS must know it along the path's own ray.
struct JointSearch {
  PointQuery query;
  LightCut cut;
  ActiveMedia media;  ///< at the collision
  Bounds3 reach;      ///< of those media: lights beyond are left to the path
};
/// Nothing where it is not used: on surfaces, at a path's last bounce, and as settings say.
std::optional<JointSearch> joint_search(const LightContext& context, const Vertex& vertex);

/// Unbiased estimate of the light of point and spot lights that is scattered once more before `vertex` scatters it: the share
/// of it that path_mis_weight() does not leave to the path's own ray. Multiply by the throughput.
Rgb joint_estimate(const LightContext& context, const Vertex& vertex, const JointSearch& search);

/// The ray that a path went on by from a collision that was sampled jointly.
class CollisionJointWeight final : public JointWeight {
 public:
  CollisionJointWeight(const JointSearch& search, Vec3 w, float pdf) : search_(search), w_(w), pdf_(pdf) {}
  float path_mis_weight(const LightContext& context, LightId light) const override;

 private:
  JointSearch search_;
  Vec3 w_;
  float pdf_;  ///< 1/sr, of its direction
};

}  // namespace tyndall
