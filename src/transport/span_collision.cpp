#include "transport/joint_ray.h"
#include "transport/span_light.h"
#include "transport/vertex_light.h"

namespace tyndall {

Rgb collision_light(const LightContext& context, const Vertex& vertex, const SpanEvent& event, Rgb beta) {
  Sampler sampler = context.sampler.fork();
  const auto share = [&](const LightSample& light, LightId id, float density) {
    const SpanDensities others = span_densities(context, event, id);
    const float phase = light.delta ? 0.0f : vertex.pdf(light.wi, Rgb(1.0f));
    const float own = light.delta ? own_share(context, id) : 1.0f;
    return own * mis_weight(event.density * density, others.pair * light.pdf, event.density * phase);
  };
  return VertexLight(context, vertex, event.search, beta, share).estimate(sampler);
}

}  // namespace tyndall
