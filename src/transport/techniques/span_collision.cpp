#include "transport/techniques/joint_ray.h"
#include "transport/techniques/next_event.h"
#include "transport/techniques/span_light.h"

namespace tyndall {

Rgb collision_light(const LightContext& context, const Vertex& vertex, const SpanCollision& collision, Rgb beta) {
  Sampler sampler = context.sampler.fork();
  const auto share = [&](const LightSample& light, LightId id, float density) {
    const SpanDensities others = span_densities(context, collision, id);
    const float phase = light.delta ? 0.0f : vertex.pdf(light.wi, Rgb(1.0f));
    const float own = light.delta ? path_mis_weight(context, id) : 1.0f;
    return own * mis_weight(collision.density * density, others.pair * light.pdf, collision.density * phase);
  };
  return VertexLight(context, vertex, collision.search, beta, share).estimate(sampler);
}

}  // namespace tyndall
