#pragma once

#include <vector>

#include "transport/sample/counters.h"
#include "transport/sample/sampler.h"
#include "transport/world/built_world.h"
#include "volume/tracking.h"

namespace tyndall {

class JointWeight;
class DrawnEmission;
class GroupedLight;
class CameraMatte;
class DeepSample;
struct LightBudget;
struct LightTrial;

/// Of a light that was sought, by the direction it comes from: what is scattered of it.
struct ArrivedLight {
  LightId light;
  Vec3 wi;
  Rgb scattered;
};

/// What light estimation needs of the render at large.
struct LightContext {
  const BuiltWorld& world;
  const LightSelector& selector;  ///< among all lights but media that emit
  const RenderSettings& settings;
  Sampler& sampler;
  Counters& counters;
  int bounce = 0;           ///< bounces of the path before this vertex
  int smooth_bounces = 0;   ///< of these the ones at vertices that spread light; mirrors and panes show what is behind as it is
  float guided_weight = 1;  ///< of the path there, from being guided
  /// Among all lights, where media that emit are sought at all.
  const LightSelector* selector_with_volumes = nullptr;
  /// The ray to it, where lights were also sampled jointly (techniques/mis.h).
  const JointWeight* joint = nullptr;
  /// The same for what the surface scatters that the camera's ray meets, where film positions were drawn for lights close to it
  /// (pixel/camera_peaks.h).
  const JointWeight* joint_at_surface = nullptr;
  /// Directly visible emission that is found otherwise (visible_emitters.h).
  const DrawnEmission* drawn_emission = nullptr;
  /// Where the scene has light groups (grouped_light.h).
  GroupedLight* groups = nullptr;
  /// Where what is scattered of lights is wanted one by one.
  std::vector<ArrivedLight>* arrived = nullptr;
  /// Where the film has mattes (camera_matte.h), and where a deep image is made (deep_sample.h).
  CameraMatte* matte = nullptr;
  DeepSample* deep = nullptr;
  /// Where numbers of lights were measured (session/pilot.h), and where that is done.
  const LightBudget* budget = nullptr;
  LightTrial* trial = nullptr;
};

/// The ray after it gathers light only where lights are directly visible to it.
inline bool is_last_bounce(const LightContext& context) { return context.bounce + 1 >= context.settings.max_depth; }

/// It is the only bounce of its path.
inline bool is_single_scattering(const LightContext& context) { return context.bounce == 0 && is_last_bounce(context); }

/// Whether next-event estimation seeks media that emit, at a vertex and along the span before it; scattered rays that pass them
/// are then weighted by MIS. By default at the first of a path alone: the others' light is averaged over paths that share it,
/// and found by rays that pass without one more (docs/measurements.md).
inline bool seeks_volume_lights(const LightContext& context, int bounce) {
  const EmissionStrategy emission = context.settings.emission;
  if (!context.selector_with_volumes || emission == EmissionStrategy::paths) return false;
  return bounce == 0 || emission == EmissionStrategy::lights;
}
inline bool seeks_volume_lights(const LightContext& context) { return seeks_volume_lights(context, context.bounce); }

/// What chooses among the lights that are sought there.
inline const LightSelector& selector(const LightContext& context, bool with_volumes) {
  return with_volumes ? *context.selector_with_volumes : context.selector;
}

/// Transmittance along shadow rays. Half the step for single scattering, whose noise nothing else hides (docs/measurements.md).
inline TransmittanceMethod shadow_method(const LightContext& context) {
  return {context.settings.transmittance, (is_single_scattering(context) ? 0.5f : 1.0f) * kShadowSpacing};
}

/// Transmittance along the path's own segment: marched once for all that is gathered along it.
inline TransmittanceMethod span_method(const LightContext& context) {
  return {context.settings.transmittance, (is_single_scattering(context) ? 0.5f : 1.0f) * kSegmentSpacing};
}

}  // namespace tyndall
