/// A path's ray that has a competing technique: one that draws direction and distance together for a point or spot light.
#pragma once

#include "transport/sample/light_context.h"

namespace tyndall {

/// LightContext::joint points to it while light of point and spot lights is gathered along it.
class JointRay {
 public:
  virtual ~JointRay() = default;
  /// MIS weight of what the ray gathers from `light` in media.
  virtual float path_mis_weight(const LightContext& context, LightId light) const = 0;
};

/// The same of context.joint; 1 where there is no such ray.
inline float path_mis_weight(const LightContext& context, LightId light) {
  return context.joint ? context.joint->path_mis_weight(context, light) : 1.0f;
}

}  // namespace tyndall
