/// Weights of techniques that find the same light: multiple importance sampling.
#pragma once

#include <cmath>

#include "transport/sample/light_context.h"

namespace tyndall {

/// MIS weight of the technique with density `a` against a competing one with density `b`: the power heuristic with exponent 2
/// [Veach 1997], safe for zero, huge and infinite densities.
inline float mis_weight(float a, float b) {
  if (!(b > 0)) return 1;
  if (!(a > 0)) return 0;
  if (a == b) return 0.5f;    // infinite both, perhaps
  const float ratio = b / a;  // may round to 0 or infinity; both give the right limit
  return 1 / (1 + ratio * ratio);
}
/// The same for three techniques.
inline float mis_weight(float a, float b, float c) {
  if (!(a > 0)) return b > 0 || c > 0 ? 0.0f : 1.0f;
  const float first = b / a, second = c / a;
  return std::isnan(first) || std::isnan(second) ? 0.0f : 1 / (1 + first * first + second * second);
}

/// Of a path's ray that has a technique beside it which draws direction and distance together for a point or spot light.
/// LightContext::joint points to it while light is gathered along the ray.
class JointWeight {
 public:
  virtual ~JointWeight() = default;
  /// MIS weight of what the ray gathers from `light` in media.
  virtual float path_mis_weight(const LightContext& context, LightId light) const = 0;
};

/// The same of context.joint; 1 where there is no such technique.
inline float path_mis_weight(const LightContext& context, LightId light) {
  return context.joint ? context.joint->path_mis_weight(context, light) : 1.0f;
}

}  // namespace tyndall
