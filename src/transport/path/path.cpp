#include "transport/path/path.h"

#include <cmath>

#include "transport/sample/camera_matte.h"
#include "transport/sample/deep_sample.h"
#include "transport/vertex/surface_vertex.h"

namespace tyndall {
namespace {

/// Russian roulette is for paths of less throughput than this: a dark wall's path into bright smoke is too rare to be made
/// rarer (docs/measurements.md).
constexpr float kRouletteBelow = 1 / 3.0f;
/// What paths that were guided to be `ratio` times as likely count for in roulette, ratio^(3/4): they have small weights and
/// large contributions; roulette by weight alone would undo the guiding (docs/measurements.md).
float guided_life(float ratio) {
  const float root = std::sqrt(ratio);
  return root * std::sqrt(root);
}

}  // namespace

Path::Path(const LightContext& context, const Limits& limits, const Ray& camera_ray)
    : context_(context), limits_(limits), ray_(camera_ray), media_(context.world.media_at_start(camera_ray.o)) {}

void Path::run() {
  ++context_.counters.paths;
  follow(next_vertex());
}

PathRecord Path::result() { return beyond_ ? Path(*this, *beyond_).run_beyond(beyond_->trace) : record_; }

Path::Path(const Path& camera, const Beyond& beyond)
    : context_(camera.context_),
      limits_(camera.limits_),
      ray_(beyond.ray),
      media_(beyond.media),
      beta_{},
      seen_(beyond.seen),
      record_(camera.record_) {
  context_.joint = nullptr;
  context_.smooth_bounces = 0;  // wherever the other went after its collision
}

PathRecord Path::run_beyond(const Trace& trace) {
  follow(arrive(trace));
  return record_;
}

/// From bounce to bounce until the path ends, or, then with its vertex, stands where it is to be shared.
std::optional<Vertex> Path::follow(std::optional<Vertex> vertex) {
  for (; vertex; vertex = next_vertex()) {
    if (is_offered(*vertex)) return vertex;
    if (depth_++ >= limits_.max_depth) break;
    if (depth_ == 1) first_bounce_in_medium_ = !vertex->on_surface();
    if (!scatter(*vertex)) break;
  }
  return std::nullopt;
}

/// Light sampling may draw as many numbers as it likes: the path stays the same.
void Path::begin(Step step) { context_.sampler.begin_step(1 + kSteps * depth_ + static_cast<int>(step)); }

/// For the emission along the path's ray, which has a step of its own beyond all others.
Rng Path::stream_for_emission() {
  constexpr int kBeyond = 1 << 29;
  context_.sampler.begin_step(kBeyond + depth_);
  return context_.sampler.stream();
}

/// Next-event estimation, then the direction of the next ray. False ends the path.
bool Path::scatter(const Vertex& vertex) {
  context_.bounce = depth_ - 1;
  if (is_pane(context_.world, vertex)) return pass_pane(vertex);
  panes_ = 0;
  // How likely others had scattered toward what is shared must not depend on how the path came there.
  context_.guided_weight = shares_directions() ? 1 : 1 / guided_pdf_ratio_;
  // On the ray it was about what media scatter.
  if (vertex.on_surface()) context_.joint = depth_ == 1 ? context_.joint_at_surface : nullptr;
  begin(Step::light);
  const Rgb seen = seen_.value_or(beta_);
  seen_.reset();
  std::optional<Directions> own;
  const Directions& directions =
      may_offer(vertex) ? offer_.emplace(context_, vertex, beta_).directions : own.emplace(context_, vertex);
  const bool looked = gather_light(directions, seen);
  if (is_environment_offered()) offer_->sought = std::make_unique<const SoughtLights>(sought_);
  if (!may_go_on()) return false;

  // What is aimed at lights weighs against the directions of this path alone.
  const bool offered = shares_directions();
  const auto joint = offered ? std::nullopt : joint_search(context_, vertex);
  if (joint) add_estimate(beta_, joint_estimate(context_, vertex, *joint), depth_ + 1);

  begin(Step::scatter);
  const auto s = directions.sample(beta_, context_.sampler);
  if (!s) return false;
  if (offered) {
    offer_->aureole = directions.aureole();
    Find& find = offer_->finds.front();
    find.wi = s->wi;
    find.scattered = s->weight;
  }
  if (is_at_find()) in_mirror_ = s->specular;
  light_sampled_ = !s->specular && vertex.has_smooth();
  end_counted_ = looked && s->mirrored;
  from_ = vertex.p();
  flown_ = Rgb(1.0f);
  pdf_ = sought_.pdf(vertex, s->wi, s->pdf);
  if (vertex.has_smooth()) ++context_.smooth_bounces;
  context_.joint = joint ? &joint_.emplace(*joint, s->wi, vertex.pdf(s->wi, Rgb(1.0f))) : nullptr;
  const bool goes_on = go_on(vertex, *s);
  if (leaves_first()) offer_->ray = ray_;
  return goes_on;
}

/// After the last bounce rays can still meet emitters.
bool Path::may_go_on() const { return !is_black(beta_) && (!is_last_bounce(context_) || context_.world.rays_find_lights()); }

bool Path::go_on(const Vertex& vertex, const ScatterSample& s) {
  media_ = vertex.media_toward(context_.world.geometry, s.wi);
  ray_ = {vertex.origin(context_.world.geometry, s.wi), s.wi};
  beta_ *= s.weight;
  eta_scale_ *= s.eta * s.eta;
  guided_pdf_ratio_ *= s.guided_pdf_ratio;
  return !is_black(beta_) && survive_roulette();
}

/// What is not mirrored goes straight on: the lights behind it are those that next-event estimation has seen through it from
/// the last bounce, and weigh as there. False ends the path.
bool Path::pass_pane(const Vertex& vertex) {
  begin(Step::light);
  const Rgb seen = seen_.value_or(beta_);
  seen_.reset();
  const bool looked = look_into_mirror(vertex, seen);
  if (!may_go_on()) return false;
  begin(Step::scatter);
  const float uc = context_.sampler.next_1d();
  auto s = vertex.sample(beta_, uc, context_.sampler.next_2d());
  if (!s) return false;
  if (!s->mirrored) s->wi = ray_.d;  // to the last bit: who receives what this path finds must find it by the same ray
  end_counted_ = looked && s->mirrored;
  if (light_sampled_ && !s->mirrored) {
    ++panes_;
  } else {
    light_sampled_ = false;
    panes_ = 0;
    from_ = vertex.p();
  }
  context_.joint = nullptr;
  return go_on(vertex, *s);
}

bool Path::survive_roulette() {
  if (depth_ <= 1 || leaves_first()) return true;  // to what others receive all go by densities that these know
  const float survival = before_ * max_component(beta_) * eta_scale_ * guided_life(guided_pdf_ratio_) / kRouletteBelow;
  if (!(survival < 1)) return true;
  if (context_.sampler.next_wide() >= survival) return false;  // many bits, as survival may be next to nothing
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
  return is_black(beta_) && !seen_ ? std::nullopt : arrive(trace);
}

/// At the ray's end, adding the light that is there.
std::optional<Vertex> Path::arrive(const Trace& trace) {
  if (!trace.hit) {
    // What is left of the throughput of an unscattered ray is the media's transmittance, on average.
    if (depth_ == 0) record_.alpha = 1 - mean(seen_.value_or(beta_));
    add_environment();
    return std::nullopt;
  }
  add_surface_emission(*trace.hit);
  if (depth_ > 0 && depth_ >= limits_.max_depth) return std::nullopt;  // follow() would end the path there
  Vertex vertex = vertex_at(*trace.hit, -ray_.d, media_);
  if (depth_ == 0 && limits_.want_albedo) record_.albedo += seen_.value_or(beta_) * vertex.albedo();
  return vertex;
}

Vertex Path::vertex_at(const SurfaceHit& hit, Vec3 wo, const MediaState& media) {
  const bool dispersive = context_.world.materials.is_dispersive(context_.world.material_of(hit));
  return surface_vertex(context_.world, hit, wo, media, dispersive ? std::optional(narrow_to_channel()) : std::nullopt);
}

/// At its first dispersive surface a path chooses the channel it goes on with, whose weight makes up for the others.
int Path::narrow_to_channel() {
  if (!channel_) {
    channel_ = channel_by(context_.sampler.next_1d());
    beta_ *= only(*channel_);
    if (seen_) *seen_ *= only(*channel_);
  }
  return *channel_;
}

/// Light that reached the camera after `bounces` bounces.
void Path::add(Rgb contribution, int bounces) {
  if (is_own(bounces)) {
    offer_->own += contribution;
  } else if (bounces == 0) {
    record_.emission += contribution;
  } else {
    record_.scattered(first_bounce_in_medium_, bounces) += contribution;
  }
}

/// The same by light groups: where that light goes.
GroupedLight::Sums& Path::sums_by_group(int bounces) { return is_own(bounces) ? context_.groups->own : context_.groups->found; }

/// Of several lights, times `factor`.
void Path::add_estimate(Rgb factor, Rgb estimate, int bounces) {
  add(factor * estimate, bounces);
  if (context_.groups) context_.groups->settle(factor, sums_by_group(bounces));
}

void Path::record_camera_ray(const Trace& trace) {
  if (context_.matte) context_.matte->meet(trace);
  if (context_.deep) context_.deep->meet(ray_, trace);
  if (trace.hit) {
    record_.hit_surface = true;
    record_.p = trace.hit->p;
    record_.n = trace.hit->ns;
    record_.z = context_.world.camera.depth(trace.hit->p);
  }
}

/// The albedo AOV is what the camera sees of it: attenuated by the media before the bounce, as beta_ is.
void Path::record_collision(float t) {
  record_.albedo += beta_;
  record_.hit_volume = true;
  record_.z_volume = context_.world.camera.depth(ray_.at(t));
}

}  // namespace tyndall
