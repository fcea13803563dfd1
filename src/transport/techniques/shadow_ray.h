/// What arrives of a light at a point: shadow rays through media.
#pragma once

#include <optional>

#include "transport/media/span.h"
#include "transport/sample/light_context.h"

namespace tyndall {

/// Shadow rays end this fraction short of the light or surface they lead to, so that they do not meet it.
inline constexpr float kShadowEnd = 1 - 1e-4f;

/// Of a shadow ray's media, by `walk`, which is left where nothing more gets through.
Rgb transmittance_along(const LightContext& context, SpanWalk& walk, const Ray& ray, Rng& rng);

/// The same of a traced ray to its end, from where `media` are; they become those there. Without any it is 1.
Rgb transmittance_to_end(const LightContext& context, const Ray& ray, const Trace& trace, MediaState& media, Sampler& sampler);

/// As Lights::sample, for all kinds of light.
std::optional<LightSample> sample_light(const LightContext& context, LightId light, Vec3 p, Vec2 u);

/// Transmittance and visibility from `origin` to `light`.
Rgb arriving(const LightContext& context, const MediaState& media, Vec3 origin, const LightSample& light, Sampler& sampler);

}  // namespace tyndall
