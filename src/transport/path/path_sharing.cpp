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

/// Find::scattered; nothing where nothing is.
Rgb separably_scattered(const Vertex& vertex) {
  const auto [factor, chance] = vertex.surface()->bsdf.separable_part(vertex.wo());
  return Rgb(chance > 0 ? factor / chance : 0.0f);
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
  GroupedLight::Sums found_before = groups ? groups->begin_find() : GroupedLight::Sums();
  before_ = max_component(beta_);
  beta_ = Rgb(1.0f);
  sharing_ = Sharing::completing;
  Find& own = offer_->finds.emplace_back(Find{.of = &*offer_});
  if (offer_->is_separable()) own.scattered = separably_scattered(*offer_->at);
  follow(offer_->at);
  sharing_ = Sharing::none;
  in_mirror_ = false;
  Find& find = offer_->finds.front();
  find.radiance = divided(record_.radiance(), find.scattered);
  record_ = before;
  add(offer_->arrived * offer_->own, offer_->bounces_of_find());
  if (!groups) return;
  find.by_group = groups->end_find(std::move(found_before));
  for (Rgb& light : find.by_group) light = divided(light, find.scattered);
  GroupedLight::add(offer_->arrived, groups->own, groups->found);
}

/// Whether lights that are sought at a second vertex are for all: nothing has found them on the way there, which is this
/// path's.
bool Path::may_offer_lights(const Vertex& second) const { return second.on_surface() || (!span_search_ && !context_.joint); }

/// Next-event estimation at the place of a find. Lights come from directions, as what the path's next ray meets does. For one
/// direction the weights of both, by MIS, are those of the path that found it: times its part of all that might have gone there
/// they sum to 1 over all paths.
void Path::offer_lights(const Directions& directions) {
  std::vector<ArrivedLight> arrived;
  context_.arrived = &arrived;
  GroupedLight* const groups = std::exchange(context_.groups, nullptr);
  light_at(directions, beta_);
  context_.groups = groups;
  context_.arrived = nullptr;
  for (const ArrivedLight& light : arrived) {
    const Rgb f = directions.vertex().eval(light.wi);
    const float pdf = directions.pdf(light.wi, beta_);
    if (!(pdf > 0)) {
      add_light(light.light, light.scattered, depth_);
      continue;
    }
    Find& find = offer_->finds.emplace_back(
        Find{.of = &*offer_, .wi = light.wi, .radiance = divided(light.scattered, f) * pdf, .scattered = f / pdf});
    if (!groups) continue;
    find.by_group.resize(groups->groups().size());
    find.by_group[groups->groups().of(light.light)] = find.radiance;
  }
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

void Path::take(Rgb factor, const Find& find, Received where) {
  const bool on_surface = where == Received::on_surface, arrived = offer_ && offer_->first.on_surface() == on_surface;
  if (find.of->escaped) {
    take_environment(factor, find.wi, arrived ? *offer_ : *behind_);
    return;
  }
  record_.scattered(!on_surface, find.of->bounces_of_find()) += factor * find.radiance;
  if (context_.groups) GroupedLight::add(factor, find.by_group, context_.groups->found);
}

void Path::take_at(const Vertex& vertex, float t, Rgb factor, const Find& find) {
  Rgb light;
  if (find.of->escaped) {
    be_on_camera_ray();
    PathOffer at(context_, vertex, Rgb(1.0f));
    if (is_environment_sought(at, find.wi)) at.sought = std::make_unique<const SoughtLights>(sought_along(vertex, t));
    light = take_environment(factor, find.wi, at);
  } else {
    take(factor, find, Received::in_medium);
    light = factor * find.radiance;
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
  Find& find = offer_->finds.emplace_back(Find{.of = &*offer_, .wi = ray_.d});
  for (const LightId light : context_.world.lights.infinite()) find.radiance += environment_from(*offer_, light, ray_.d);
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

bool Path::completes_one_direction() const { return sharing_ == Sharing::completing && !offer_->is_separable(); }

/// At the first vertex that spreads light, which may be behind mirrors and panes; of collisions only on the camera's ray, along
/// which others receive. Not where dispersion has left a single channel: others want them all.
bool Path::may_offer(const Vertex& first) const {
  if (sharing_ != Sharing::offering || context_.smooth_bounces > 0 || channel_) return false;
  return (depth_ == 1 || (first.on_surface() && depth_ < limits_.max_depth)) && may_share(first);
}

/// It has left the vertex of its offer, and passed nothing since but panes: what comes next may be a find.
bool Path::leaves_first() const { return sharing_ == Sharing::offering && offer_ && depth_ - panes_ == offer_->bounces; }
/// Where light is scattered toward the first vertex by the place of a find itself.
bool Path::is_at_find() const { return sharing_ == Sharing::completing && depth_ == offer_->bounces_of_find(); }
/// The same where that is no separable surface: what comes from each direction is a find of its own.
bool Path::shares_directions() const { return completes_one_direction() && is_at_find(); }
/// Light of so many bounces is counted by none but its own path.
bool Path::is_own(int bounces) const {
  if (in_mirror_) return true;
  return completes_one_direction() && !offer_->has_lights && bounces == offer_->bounces_of_find();
}

/// Not where others could not tell how likely the path went where it did.
bool Path::may_share(const Vertex& first) const { return first.has_smooth() && first.has_exact_pdf(); }

/// Of what a separable surface sends back all know how it depends on which of the paths looks at it. Elsewhere light is shared
/// by the direction it comes from: whose density others must be able to tell, without what guides one path there, and for all
/// channels.
bool Path::is_offered(const Vertex& second) const {
  if (!leaves_first() || !light_sampled_) return false;
  if (second.on_surface()) {
    if (second.surface()->bsdf.separable()) return true;
    if (channel_ || !may_share(second) || guides_everywhere(context_, depth_)) return false;
  }
  return limits_.max_depth > depth_ + 1 || may_offer_lights(second);
}

}  // namespace tyndall
