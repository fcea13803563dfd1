#include "render/path.h"

#include <bit>
#include <cmath>

#include "math/hash.h"
#include "render/collision_place.h"
#include "render/fire_light.h"
#include "render/span_far.h"
#include "volume/homogeneous.h"

namespace tyndall {
namespace {

/// A uniform number that depends on where a surface is seen and from where, and on nothing else: makes the choices of
/// mix materials and of coated materials' walks repeatable, as in pbrt.
float hash_to_unit(Vec3 p, Vec3 w) {
  const auto bits = [](float f) { return static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(f)); };
  const std::uint64_t h = hash(bits(p.x), bits(p.y), bits(p.z), bits(w.x), bits(w.y), bits(w.z));
  return static_cast<float>(h >> 40) * 0x1p-24f;
}

}  // namespace

Path::Path(const LightContext& context, const Limits& limits, const Ray& camera_ray)
    : context_(context), limits_(limits), ray_(camera_ray), media_(context.world.camera_media) {
  const World::Parts& world = context.world;
  if (world.camera.is_pinhole() || world.geometry.groups().empty()) return;
  // Membership is known at the center of the lens; what lies between it and this ray's origin is passed on the way.
  const Vec3 step = ray_.o - world.camera.center();
  if (length_squared(step) == 0) return;
  for (const Crossing& c : world.geometry.trace_all({world.camera.center(), step}, 0, 1)) media_.cross(c.group, c.sign);
}

PathRecord Path::run() {
  ++context_.counters.paths;
  while (const auto vertex = next_vertex()) {
    if (depth_++ >= limits_.max_depth) break;
    if (depth_ == 1) first_event_in_medium_ = !vertex->on_surface();
    if (!scatter(*vertex)) break;
  }
  return record_;
}

/// Strategies of lighting may draw as many numbers as they like: the path stays the same.
void Path::begin(Step step) { context_.sampler.begin_step(1 + kSteps * depth_ + static_cast<int>(step)); }

/// Next-event estimation, then the direction of the next ray. False ends the path.
bool Path::scatter(const Vertex& vertex) {
  context_.event = depth_ - 1;
  begin(Step::light);
  add(beta_ * light_at(vertex), depth_);

  begin(Step::scatter);
  const float uc = context_.sampler.next_1d();
  const auto s = vertex.sample(beta_, uc, context_.sampler.next_2d());
  if (!s) return false;
  light_sampled_ = !s->specular && vertex.has_smooth();
  from_ = vertex.p();
  pdf_ = span_event_ ? vertex.pdf(s->wi, Rgb(1.0f)) : s->pdf;
  media_ = vertex.media_toward(context_.world.geometry, s->wi);
  ray_ = {vertex.origin(context_.world.geometry, s->wi), s->wi};
  beta_ *= s->weight;
  eta_scale_ *= s->eta * s->eta;
  return !is_black(beta_) && survive_roulette();
}

/// Light from emitters that is scattered at the vertex. What the span's pairs stand for is not in it.
Rgb Path::light_at(const Vertex& vertex) {
  span_event_.reset();
  if (vertex.on_surface() || !span_search_) {
    search_ = light_search(context_, vertex);
    return direct_light(context_, vertex, search_, beta_);
  }
  span_event_ = SpanEvent{*span_search_, collision_t_, collision_density_};
  return tracks(context_.settings) ? collision_light(context_, vertex, *span_event_, beta_) : Rgb();
}

bool Path::survive_roulette() {
  const float survival = max_component(beta_) * eta_scale_;
  if (depth_ <= 1 || survival >= 1) return true;
  if (context_.sampler.next_1d() >= survival) return false;
  beta_ *= 1 / survival;
  return true;
}

/// Trace the ray to where it scatters next, adding the light it meets. Nothing: it left the scene or was absorbed.
std::optional<Vertex> Path::next_vertex() {
  ++context_.counters.rays;
  if (context_.world.has_media()) {
    if (auto collision = collide_untraced()) return collision;
  }
  const Trace trace = context_.world.geometry.trace(ray_, 0, kInfinity);
  if (depth_ == 0) record_camera_ray(trace);
  if (context_.world.has_media()) {
    if (auto collision = pass_media(trace)) return collision;
  }
  if (is_black(beta_)) return std::nullopt;
  if (!trace.hit) {
    // What is left of the throughput of an unscattered ray is the media's transmittance, on average.
    if (depth_ == 0) record_.alpha = 1 - mean(beta_);
    add_environment();
    return std::nullopt;
  }
  add_surface_emission(*trace.hit);
  if (depth_ > 0 && depth_ >= limits_.max_depth) return std::nullopt;  // run() would end the path there
  Vertex vertex = surface_vertex(*trace.hit);
  if (depth_ == 0) record_.albedo = limits_.want_albedo ? beta_ * vertex.albedo() : Rgb();
  return vertex;
}

/// In dense media that are the same everywhere, and whose lights are chosen at collisions, the collision is drawn first: the
/// ray need not be traced beyond it. Nothing: something is in between, or this is not such a place. Where the choice of
/// lights was decided here it stays so for the traced span: decided again, it would depend on the collision that was drawn.
std::optional<Vertex> Path::collide_untraced() {
  span_search_.reset();
  lit_at_collisions_.reset();
  if (depth_ == 0 || depth_ >= limits_.max_depth) return std::nullopt;
  const World::Parts& world = context_.world;
  const auto& groups = world.geometry.groups();
  const Interval inside{0, media_.first_exit(groups, ray_), media_.active(groups, world.media)};
  const MediaView media = inside.view();
  if (media.empty() || inside.t1 == kInfinity || any_emissive(media) || !all_homogeneous(media)) return std::nullopt;
  context_.event = depth_;
  if (seeks_along_spans(context_)) lit_at_collisions_ = collisions_suffice(context_, ray_, inside);
  if (!lit_at_collisions_.value_or(is_deep(ray_, inside))) return std::nullopt;

  begin(Step::fly);
  Rng rng = context_.sampler.stream();
  const float u = context_.sampler.next_1d();
  const Flight flight = free_flight(media, ray_, 0, kInfinity, beta_, u, rng, context_.counters.tracking);
  const float margin = collision_margin(ray_, flight.t);
  if (!flight.collided || flight.t < margin || flight.t > inside.t1) return std::nullopt;
  const auto crossings = world.geometry.trace_shadow(ray_, 0, flight.t + margin);
  if (!crossings || !crossings->empty()) return std::nullopt;
  beta_ *= flight.weight;
  return Vertex(Vertex::InMedium{ray_.at(flight.t), flight.phase}, -ray_.d, media_);
}

/// Go through the media before the ray's end. A vertex: the path collides there; else it arrives with its weight in
/// beta_.
std::optional<Vertex> Path::pass_media(const Trace& trace) {
  const Span span = make_span(context_.world.media_context(), media_, ray_, trace, context_.counters.parity_errors);
  if (depth_ == 0 && limits_.want_transmittance) record_transmittance(span);
  media_ = span.end;
  if (span.empty()) return std::nullopt;
  // After the last event only what the ray meets at its end counts: no collision need be drawn.
  if (depth_ >= limits_.max_depth) {
    dim(span);
    return std::nullopt;
  }
  gather(span);
  return fly(span, trace);
}

bool Path::lit_at_collisions(const Span& span) const {
  return lit_at_collisions_ ? *lit_at_collisions_ : !seeks_along_spans(context_) || collisions_suffice(context_, span);
}

/// Next-event estimation for the whole span.
void Path::gather(const Span& span) {
  context_.event = depth_;
  if (lit_at_collisions(span)) return;
  begin(Step::gather);
  span_search_ = span_search(context_, span);
  if (!span_search_ || !pairs_along_spans(context_.settings)) return;
  if (depth_ == 0) first_event_in_medium_ = true;  // of this light's path
  add(beta_ * span_light(context_, span, *span_search_, beta_), depth_ + 1);
}

std::optional<Vertex> Path::fly(const Span& span, const Trace& trace) {
  begin(Step::fly);
  Rng rng = context_.sampler.stream();
  float u = context_.sampler.next_1d();
  for (const SpanPart& part : span.parts) {
    const Flight flight = free_flight(part.view(), ray_, part.t0, part.t1, beta_, u, rng, context_.counters.tracking);
    if (!is_black(flight.emission)) add(beta_ * flight.emission * emission_share(), depth_);
    beta_ *= flight.weight;
    if (is_black(beta_)) return std::nullopt;
    if (flight.collided) {
      collision_t_ = collision_place(context_.world.geometry, ray_, part, trace.hit, flight.t);
      if (span_search_) collision_density_ = collision_density(span, *span_search_, collision_t_);
      if (depth_ == 0) record_collision(collision_t_);
      return Vertex(Vertex::InMedium{ray_.at(collision_t_), flight.phase}, -ray_.d, part.state);
    }
    u = rng.uniform();
  }
  return std::nullopt;
}

void Path::dim(const Span& span) {
  begin(Step::fly);
  Rng rng = context_.sampler.stream();
  for (const SpanPart& part : span.parts) {
    beta_ *= transmittance(context_.settings.transmittance, part.view(), ray_, part.t0, part.t1, rng, context_.counters.tracking);
    if (is_black(beta_)) return;
  }
}

Vertex Path::surface_vertex(const SurfaceHit& hit) {
  const Vec3 wo = -ray_.d;
  const SurfaceQuery query{
      .p = hit.p, .uv = hit.uv, .shading = Frame::around(hit.ns, hit.dpdu), .wo = wo, .random = hash_to_unit(hit.p, wo)};
  const Bsdf bsdf = context_.world.materials.bsdf(context_.world.material_of(hit), query);
  return Vertex(Vertex::Surface{hit, bsdf}, wo, media_);
}

/// MIS weight of a scattered ray that found light `id`, which next-event estimation samples with `light_pdf`.
float Path::scattering_share(LightId id, float light_pdf) const {
  if (!light_sampled_ || light_pdf == 0) return 1;
  if (span_event_) {
    const SpanDensities others = span_densities(context_, *span_event_, id);
    return mis_weight(span_event_->density * pdf_, others.pair * light_pdf, others.tracked * light_pdf);
  }
  return mis_weight(pdf_, context_.selector.expected(search_.cut, search_.query, id) * light_pdf);
}

/// MIS weight of what a scattered ray gathers from glowing media.
float Path::emission_share() const {
  if (!light_sampled_ || !seeks_fire(context_)) return 1;
  const FiresOnRay fires = context_.world.fire.along({from_, ray_.d});
  if (!span_event_) return mis_weight(pdf_, fire_density(context_, search_, fires));
  const SpanDensities others = span_fire_densities(context_, *span_event_, fires);
  return mis_weight(span_event_->density * pdf_, others.pair, others.tracked);
}

void Path::add_environment() {
  const Lights& lights = context_.world.lights;
  for (const LightId id : lights.infinite()) {
    const Rgb L = lights.environment(id, ray_.d);
    if (is_black(L)) continue;
    const float pdf = light_sampled_ ? lights.environment_pdf(id, ray_.d, true) : 0.0f;
    add(beta_ * L * scattering_share(id, pdf), depth_);
  }
}

void Path::add_surface_emission(const SurfaceHit& hit) {
  const auto id = context_.world.light_of(hit);
  if (!id) return;
  const Lights& lights = context_.world.lights;
  const EmitterHit emitter{.p = hit.p, .ng = hit.ng, .uv = hit.uv, .distance = hit.t};
  const Rgb L = lights.emitted(*id, emitter, -ray_.d);
  if (is_black(L)) return;
  const float pdf = light_sampled_ ? lights.pdf(*id, from_, emitter) : 0.0f;
  add(beta_ * L * scattering_share(*id, pdf), depth_);
}

/// Light that reached the camera after `events` scattering events.
void Path::add(Rgb contribution, int events) {
  if (events == 0) {
    record_.emission += contribution;
  } else if (first_event_in_medium_) {
    (events == 1 ? record_.volume_direct : record_.volume_indirect) += contribution;
  } else {
    (events == 1 ? record_.surface_direct : record_.surface_indirect) += contribution;
  }
}

void Path::record_camera_ray(const Trace& trace) {
  if (trace.hit) {
    record_.hit_surface = true;
    record_.p = trace.hit->p;
    record_.n = trace.hit->ns;
    record_.z = context_.world.camera.depth(trace.hit->p);
  }
}

/// The albedo AOV is what the camera sees of it: dimmed by the media before the event, as beta_ is.
void Path::record_collision(float t) {
  record_.albedo = beta_;
  record_.hit_volume = true;
  record_.z_volume = context_.world.camera.depth(ray_.at(t));
}

void Path::record_transmittance(const Span& span) {
  Rng rng = context_.sampler.side_stream();
  for (const SpanPart& part : span.parts) {
    record_.transmittance *=
        transmittance(context_.settings.transmittance, part.view(), ray_, part.t0, part.t1, rng, context_.counters.tracking);
  }
}

}  // namespace tyndall
