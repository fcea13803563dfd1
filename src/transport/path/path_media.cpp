/// A path through media: free flight, collisions, and what lies behind.
#include <algorithm>
#include <utility>

#include "transport/budget/collisions_suffice.h"
#include "transport/media/collision_place.h"
#include "transport/media/transmittance_walk.h"
#include "transport/path/path.h"
#include "transport/sample/camera_matte.h"
#include "transport/sample/deep_sample.h"
#include "volume/homogeneous.h"
#include "volume/regular_tracking.h"

namespace tyndall {
namespace {

/// The step beyond all others whose numbers receiving takes.
constexpr int kReceivingStep = (1 << 30) + 1;

}  // namespace

/// In a medium whose lights are chosen at collisions, the collision is drawn first: the ray need not be traced beyond it.
/// Nothing: something is in between, or this is not such a place: nor where media overlap, of which one does not decide for all
/// of the ray, or emit, as light is gathered beyond the collision too. The ray is then traced, and flies by the same numbers.
/// Where the choice of lights was decided here it stays so for the traced span: decided again, it would depend on the collision
/// that was drawn.
std::optional<Vertex> Path::collide_untraced() {
  span_search_.reset();
  lit_at_collisions_.reset();
  const BuiltWorld& world = context_.world;
  if (depth_ == 0 || depth_ >= limits_.max_depth || world.media_emit) return std::nullopt;
  const auto& groups = world.geometry.groups();
  const Interval inside{0, media_.first_exit(groups, ray_), media_.active(groups, world.media)};
  const MediaView media = inside.view();
  if (media.size() != 1 || inside.t1 == kInfinity || flies_regularly(media)) return std::nullopt;
  context_.bounce = depth_;
  if (seeks_along_spans(context_)) lit_at_collisions_ = collisions_suffice(context_, ray_, inside);
  if (!(lit_at_collisions_ ? *lit_at_collisions_ : is_deep(ray_, inside))) return std::nullopt;

  begin(Step::fly);
  Rng rng = context_.sampler.stream();
  const float u = context_.sampler.next_1d();
  const Flight flight = free_flight(media, ray_, 0, kInfinity, beta_, u, rng, context_.counters.tracking);
  const float margin = collision_margin(ray_, flight.t);
  if (!flight.collided || is_black(flight.weight) || flight.t < margin || flight.t > inside.t1) return std::nullopt;
  const auto crossings = world.geometry.trace_shadow(ray_, 0, flight.t + margin);
  if (!crossings || !crossings->empty()) return std::nullopt;
  beta_ *= flight.weight;
  flown_ *= flight.weight;
  return Vertex(Vertex::InMedium{ray_.at(flight.t), flight.phase}, -ray_.d, media_);
}

/// Go through the media before the ray's end. A vertex: the path collides there; else it arrives with its weight in
/// beta_.
std::optional<Vertex> Path::pass_media(const Trace& trace) {
  const bool receives = depth_ == 0 && sharing_ == Sharing::offering;
  Span made = make_span(context_.world.media_context(), media_, ray_, trace, context_.counters.parity_errors);
  const Span& span = receives && !made.empty() ? receive_along(std::move(made), trace) : made;
  if (depth_ == 0) record_camera_media(span);
  media_ = span.end;
  if (span.empty()) return std::nullopt;
  // After the last bounce only what the ray hits at its end counts: no collision need be drawn.
  if (depth_ >= limits_.max_depth) {
    dim(span);
    return std::nullopt;
  }
  if (context_.world.media_emit) add_volume_emission(span);
  gather(span);
  const auto seen = seen_beyond(span, trace);
  auto collision = fly(span, trace);
  if (segment_ && depth_ == 0) segment_->collide(collision_t_);
  if (!collision) {
    seen_ = seen;
  } else if (seen && !is_black(*seen)) {
    beyond_ = Beyond{ray_, *seen, span.end, trace};
  }
  return collision;
}

/// What is behind the camera's media is multiplied by the transmittance, instead of counted whole and only by rays that pass;
/// where little gets through, roulette decides. Nothing: by rays that pass (docs/measurements.md). Not where transmittance has
/// to be tracked, which costs more than it gains, nor where collisions carry direct light: there it is less noise if each ray
/// has one of the two.
std::optional<Rgb> Path::seen_beyond(const Span& span, const Trace& trace) {
  const RenderSettings& settings = context_.settings;
  if (depth_ > 0 || !span_search_ || !pairs_along_spans(settings)) return std::nullopt;
  if (!trace.hit && context_.world.lights.infinite().empty()) return std::nullopt;
  if (!homogeneous_throughout(span.parts)) return std::nullopt;
  Rgb T(1.0f);
  for (const SpanPart& part : span.parts) T *= sum_of(part.view()).transmittance(double{part.t1} - part.t0);
  const float chance = std::min(1.0f, kSeenMore * max_component(T));
  if (!(chance > 0)) return Rgb();
  // Many bits: behind fog of optical depth 17 the probability is below the steps of a float's number. The step is gather()'s.
  return context_.sampler.next_wide() < chance ? T * (1 / chance) : Rgb();
}

/// What receiving draws does not depend on what becomes of the path.
const Span& Path::receive_along(Span span, const Trace& trace) {
  context_.sampler.begin_step(kReceivingStep);
  const float u = context_.sampler.next_1d();
  return segment_.emplace(std::move(span), trace.hit, u, context_.sampler.stream()).span();
}

bool Path::lit_at_collisions(const Span& span) const {
  return lit_at_collisions_ ? *lit_at_collisions_ : !seeks_along_spans(context_) || collisions_suffice(context_, span);
}

/// Next-event estimation for the whole span.
void Path::gather(const Span& span) {
  context_.bounce = depth_;
  if (lit_at_collisions(span)) return;
  begin(Step::gather);
  span_search_ = span_search(context_, span);
  if (depth_ == 0 && segment_ && has_environment()) camera_search_ = span_search_;
  if (!span_search_ || !pairs_along_spans(context_.settings)) return;
  if (depth_ == 0) first_bounce_in_medium_ = true;  // of this light's path
  add_estimate(beta_, span_light(context_, span, *span_search_, beta_), depth_ + 1);
  if (context_.deep && depth_ == 0) context_.deep->settle(beta_);
}

/// Whether what the camera sees, mirrored or not, collides, and where, makes much of what a pixel's samples differ by: there it
/// is stratified.
bool Path::flies_regularly(MediaView media) const { return context_.smooth_bounces == 0 && !all_homogeneous(media); }

std::optional<Vertex> Path::fly(const Span& span, const Trace& trace) {
  begin(Step::fly);
  Rng rng = context_.sampler.stream();
  float u = context_.sampler.next_1d();
  for (const SpanPart& part : span.parts) {
    const MediaView media = part.view();
    const auto flies = flies_regularly(media) ? regular_flight : free_flight;
    const Flight flight = flies(media, ray_, part.t0, part.t1, beta_, u, rng, context_.counters.tracking);
    beta_ *= flight.weight;
    flown_ *= flight.weight;
    if (is_black(beta_)) return std::nullopt;
    if (flight.collided) {
      collision_t_ = collision_place(context_.world.geometry, ray_, part, trace.hit, flight.t);
      if (span_search_) collision_density_ = collision_density(span, *span_search_, collision_t_);
      if (depth_ == 0) record_collision(collision_t_);
      return Vertex(Vertex::InMedium{ray_.at(collision_t_), flight.phase}, -ray_.d, part.state);
    }
    u = flight.u_next;
  }
  return std::nullopt;
}

void Path::dim(const Span& span) {
  begin(Step::fly);
  const Rng rng = context_.sampler.stream();
  const Rgb T = TransmittanceWalk(span_method(context_), span, rng, context_.counters.tracking).to(span.t_end);
  beta_ *= T;
  flown_ *= T;
}

void Path::record_camera_media(const Span& span) {
  if (!limits_.want_transmittance && !context_.matte && !context_.deep) return;
  const Counters before = context_.counters;
  if (limits_.want_transmittance) record_transmittance(span);
  if (context_.matte) context_.matte->see_through(context_, span);
  if (context_.deep) context_.deep->see_through(context_, span);
  work_for_outputs_ = context_.counters.since(before);
}

void Path::record_transmittance(const Span& span) {
  const Rng rng = context_.sampler.side_stream();
  record_.transmittance *= TransmittanceWalk(span_method(context_), span, rng, context_.counters.tracking).to(span.t_end);
}

}  // namespace tyndall
