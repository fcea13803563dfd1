/// A path's ray that has a rival for the light of lamps: a technique that draws its direction and a distance for one of them.
#pragma once

#include "transport/light_context.h"

namespace tyndall {

/// The lamps are point and spot lights. LightContext::joint points to it while what the ray meets is lit.
class JointRay {
 public:
  virtual ~JointRay() = default;
  /// MIS weight of what the ray gathers from `light` in media.
  virtual float own_share(const LightContext& context, LightId light) const = 0;
};

/// The same of context.joint; 1 where there is no such ray.
inline float own_share(const LightContext& context, LightId light) {
  return context.joint ? context.joint->own_share(context, light) : 1.0f;
}

}  // namespace tyndall
