/// What a path offers to those of neighbouring pixels, and takes from them.
#include <algorithm>
#include <utility>

#include "transport/path/path.h"
#include "transport/sample/deep_sample.h"

namespace tyndall {
namespace {

Rgb divided(Rgb a, Rgb b) {
  for (int channel = 0; channel < 3; ++channel) a[channel] = b[channel] != 0 ? a[channel] / b[channel] : 0.0f;
  return a;
}

/// The step beyond all others whose numbers the offer takes.
constexpr int kSharingStep = 1 << 30;

}  // namespace

void Path::run_until_offer() {
  ++context_.counters.paths;
  sharing_ = Sharing::offering;
  auto vertex = follow(next_vertex());
  if (!offer_) return;
  if (vertex) offer_->at.emplace(std::move(*vertex));
  if (!offer_->found()) return;
  offer_->panes = panes_;
  offer_->arrived = beta_;
  offer_->flown = flown_;
  context_.sampler.begin_step(kSharingStep);
  offer_->rng = context_.sampler.stream();
}

void Path::complete_offer() {
  const PathRecord before = std::exchange(record_, {});
  GroupedLight* const groups = context_.groups;
  const GroupedLight::Sums found_before = groups ? groups->begin_find() : GroupedLight::Sums();
  before_ = max_component(beta_);
  beta_ = Rgb(1.0f);
  sharing_ = Sharing::completing;
  follow(offer_->at);
  sharing_ = Sharing::none;
  const Rgb scattered = offer_->scatters_evenly() ? Rgb(1.0f) : offer_->scattered;
  offer_->radiance = divided(record_.radiance(), scattered);
  record_ = before;
  add(offer_->arrived * offer_->own, offer_->bounces_of_find());
  if (!groups) return;
  groups->end_find(found_before);
  for (Rgb& light : groups->find) light = divided(light, scattered);
  GroupedLight::add(offer_->arrived, groups->own, groups->found);
}

/// What is asked of the path's context is for the first bounce there, wherever the path itself went.
void Path::be_on_camera_ray() {
  context_.bounce = context_.smooth_bounces = 0;
  context_.guided_weight = 1;
}

/// Not where a path draws numbers for its vertex: others must not.
PathOffer* Path::behind() {
  if (behind_ || !segment_ || !segment_->end()) return behind_ ? &*behind_ : nullptr;
  const SurfaceHit& hit = *segment_->end();
  if (context_.world.materials.is_dispersive(context_.world.material_of(hit))) return nullptr;
  const Span& span = segment_->span();
  const Vertex vertex = vertex_at(hit, -span.ray.d, span.end);
  be_on_camera_ray();
  return may_share(vertex) ? &behind_.emplace(context_, vertex, Rgb(1.0f)) : nullptr;
}

void Path::take(Rgb factor, const Path& finder, Received where) {
  const bool on_surface = where == Received::on_surface, arrived = offer_ && offer_->first.on_surface() == on_surface;
  if (const auto wi = finder.offer_->escaped) {
    take_environment(factor, *wi, arrived ? *offer_ : *behind_);
    return;
  }
  record_.scattered(!on_surface, finder.offer_->bounces_of_find()) += factor * finder.offer_->radiance;
  if (context_.groups) GroupedLight::add(factor, finder.context_.groups->find, context_.groups->found);
}

void Path::take_at(const Vertex& vertex, float t, Rgb factor, const Path& finder) {
  Rgb light;
  if (const auto wi = finder.offer_->escaped) {
    be_on_camera_ray();
    PathOffer at(context_, vertex, Rgb(1.0f));
    if (is_environment_sought(at, *wi)) at.sought = std::make_unique<const SoughtLights>(sought_along(vertex, t));
    light = take_environment(factor, *wi, at);
  } else {
    take(factor, finder, Received::in_medium);
    light = factor * finder.offer_->radiance;
  }
  if (context_.deep) context_.deep->scattered(t, light);
}

/// As the path would have sought lights, had it collided there.
SoughtLights Path::sought_along(const Vertex& vertex, float t) const {
  if (!camera_search_) return {light_search(context_, vertex), {}};
  return {{}, SpanCollision{*camera_search_, t, collision_density(segment_->span(), *camera_search_, t)}};
}

bool Path::has_environment() const { return !context_.world.lights.infinite().empty(); }
bool Path::is_environment_offered() const { return leaves_first() && has_environment(); }

void Path::offer_environment() {
  if (!offer_->sees_environment(ray_.d)) return;
  offer_->escaped = ray_.d;
  for (const LightId light : context_.world.lights.infinite()) offer_->radiance += environment_from(*offer_, light, ray_.d);
}

/// What a direction brings from there, weighted by MIS against next-event estimation as if the path had gone there itself:
/// which of those that share has chosen it does not matter.
Rgb Path::environment_from(const PathOffer& offer, LightId light, Vec3 wi) const {
  const Rgb L = offer.environment(light, wi);
  const float pdf = is_black(L) ? 0.0f : offer.lights.environment_pdf(light, {offer.first.p(), wi});
  if (pdf == 0) return L;
  const float own = offer.sought->pdf(offer.first, wi, offer.directions.pdf(wi, offer.beta));
  return L * offer.sought->scattering_mis_weight(context_, own, light, pdf);
}

/// Whether next-event estimation looks there: what it has sought weighs against nothing else.
bool Path::is_environment_sought(const PathOffer& at, Vec3 wi) const {
  const auto& infinite = at.lights.infinite();
  return std::ranges::any_of(infinite, [&](LightId id) { return at.lights.environment_pdf(id, {at.first.p(), wi}) > 0; });
}

Rgb Path::take_environment(Rgb factor, Vec3 wi, PathOffer& at) {
  if (!at.sought && is_environment_sought(at, wi))
    at.sought = std::make_unique<const SoughtLights>(SoughtLights{light_search(context_, at.first), {}});
  Rgb sum;
  for (const LightId light : context_.world.lights.infinite()) {
    const Rgb contribution = factor * environment_from(at, light, wi);
    sum += contribution;
    if (context_.groups) context_.groups->found[context_.groups->groups().of(light)] += contribution;
  }
  record_.scattered(!at.first.on_surface(), at.bounces) += sum;
  return sum;
}

bool Path::completes_one_direction() const { return sharing_ == Sharing::completing && !offer_->scatters_evenly(); }

/// At the first vertex that spreads light, which may be behind mirrors and panes; of collisions only on the camera's ray, along
/// which others receive. Not where dispersion has left a single channel: others want them all.
bool Path::may_offer(const Vertex& first) const {
  if (sharing_ != Sharing::offering || context_.smooth_bounces > 0 || channel_) return false;
  return (depth_ == 1 || (first.on_surface() && depth_ < limits_.max_depth)) && may_share(first);
}

/// It has left the vertex of its offer, and passed nothing since but panes: what comes next may be a find.
bool Path::leaves_first() const { return sharing_ == Sharing::offering && offer_ && depth_ - panes_ == offer_->bounces; }
/// Light of so many bounces is scattered toward the first vertex by the find itself, not a diffuse surface: none but its own
/// path counts that.
bool Path::is_scattered_by_find(int bounces) const { return completes_one_direction() && bounces == offer_->bounces_of_find(); }

/// Not where others could not tell how likely the path went where it did.
bool Path::may_share(const Vertex& first) const { return first.has_smooth() && first.has_exact_pdf(); }

/// What a diffuse surface sends back does not depend on which of the paths looks at it. Elsewhere only the light of the next
/// bounce and later is shared, by the direction it comes from: whose density others must be able to tell, without what guides
/// one path there, and for all channels.
bool Path::is_offered(const Vertex& second) const {
  if (!leaves_first() || !light_sampled_) return false;
  if (second.on_surface()) {
    if (second.surface()->bsdf.diffuse()) return true;
    if (channel_ || !may_share(second) || guides_everywhere(context_, depth_)) return false;
  }
  return limits_.max_depth > depth_ + 1;
}

}  // namespace tyndall
