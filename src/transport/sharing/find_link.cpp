#include "transport/sharing/find_link.h"

#include <cmath>

#include "transport/techniques/shadow_ray.h"
#include "transport/vertex/surface_vertex.h"
#include "volume/coarse.h"
#include "volume/homogeneous.h"

namespace tyndall {
namespace {

/// Half of shadow rays', as the noise of inverses has a longer tail.
constexpr float kInverseSpacing = 0.5f * kShadowSpacing;
/// Reads of a grid for the chance of passing it.
constexpr int kReads = 16;

bool same_side(Vec3 n, Vec3 a, Vec3 b) { return dot(n, a) * dot(n, b) > 0; }
bool has_all_channels(Rgb c) { return c.r != 0 && c.g != 0 && c.b != 0; }

Ray ray_to(const PathOffer& find, const Geometry& geometry, const Vertex& from) {
  const Vec3 w = find.escaped ? *find.escaped : normalize(find.at->p() - from.p());
  return {from.origin(geometry, w), w};
}

/// What the find scatters back along `w`, which points to it, and how likely.
Connection scattered_back(const Find& find, Vec3 w) {
  const PathOffer& of = *find.of;
  if (const auto* medium = of.at->medium()) {
    const Rgb phase = medium->phase.eval(-w, find.wi);
    if (!has_all_channels(phase)) return {phase, 0};
    float pdf = medium->phase.pdf(-w, find.wi, Rgb(1.0f));
    if (of.aureole) pdf *= of.aureole->pdf_ratio(medium->phase, -w, find.wi, Rgb(1.0f));
    return {phase, pdf};
  }
  const SurfaceHit& hit = of.at->surface()->hit;
  if (!same_side(hit.ng, -w, of.at->wo()) || !same_side(hit.ns, -w, of.at->wo())) return {};
  const float cosine = abs_dot(hit.ng, w);
  const Bsdf& bsdf = of.at->surface()->bsdf;
  if (of.is_separable()) {
    const auto [factor, chance] = bsdf.separable_part(-w);
    return {Rgb(cosine * factor), cosine * chance};
  }
  const Rgb f = bsdf.eval(-w, find.wi);
  return {f * cosine, has_all_channels(f) ? bsdf.pdf(-w, find.wi) * cosine : 0};
}

}  // namespace

std::optional<Sighting> sight(const Find& find, Vec3 p) {
  if (find.of->escaped) return Sighting{find.wi, {Rgb(1.0f), 1}};
  const Vec3 v = find.of->at->p() - p;
  const float d2 = length_squared(v);
  if (!(d2 > 0)) return std::nullopt;
  const Vec3 w = v * (1 / std::sqrt(d2));
  const Connection back = scattered_back(find, w);
  if (!(back.pdf > 0)) return std::nullopt;
  return Sighting{w, {back.f * (1 / d2), back.pdf / d2}};
}

Connection connect(const PathOffer& from, const Find& find) {
  if (from.bounces != find.of->bounces) return {};
  if (find.of->escaped && !from.sees_environment(find.wi)) return {};
  const auto sighting = sight(find, from.first.p());
  if (!sighting) return {};
  const auto& [w, back] = *sighting;
  const float pdf = from.directions.pdf(w, from.beta);
  if (!(pdf > 0)) return {};
  return {from.first.eval(w) * back.f, pdf * back.pdf};
}

Link::Link(const Between& between, const Vertex& from, PathOffer& find, bool own) : between_(between), find_(find), own_(own) {
  const Geometry& geometry = between.world.geometry;
  ray_ = own ? find.ray : ray_to(find, geometry, from);
  media_ = from.media_toward(geometry, ray_.d);
}

/// Of a link, from pane to pane.
struct Link::Piece {
  Ray ray;
  MediaState media;
  float left;  ///< to the find
};

std::optional<Passage> Link::pass(Rgb throughput) const {
  Passage passage;
  if (own_) passage.weight = find_.flown;
  std::optional<Piece> piece = Piece{ray_, media_, find_.escaped ? kInfinity : length(find_.at->p() - ray_.o)};
  for (int panes = 0; panes < find_.panes; ++panes) {
    piece = beyond_pane(*piece, throughput, passage);
    if (!piece) return std::nullopt;
  }
  ++between_.counters.shadow_rays;
  const bool on_surface = find_.at && find_.at->on_surface();
  const float end = on_surface ? piece->left * kShadowEnd : piece->left;
  const auto crossings = between_.world.geometry.trace_shadow(piece->ray, 0, end);
  if (!crossings) return std::nullopt;
  pass_media(*piece, *crossings, piece->left, throughput, passage);
  return passage;
}

std::optional<Link::Piece> Link::beyond_pane(const Piece& piece, Rgb& throughput, Passage& passage) const {
  ++between_.counters.shadow_rays;
  const Trace trace = between_.world.geometry.trace(piece.ray, 0, piece.left);
  if (!trace.hit) return std::nullopt;
  const MediaState there = pass_media(piece, trace.crossings, trace.t_end, throughput, passage);
  const auto behind = behind_pane(between_.world, piece.ray, *trace.hit, there);
  if (!behind) return std::nullopt;
  passage.weight *= own_ ? 1 / behind->unbent : behind->unbent;
  passage.chance *= behind->unbent;
  passage.likely *= behind->unbent;
  return Piece{behind->ray, behind->media, piece.left - trace.hit->t};
}

/// Membership at the end.
MediaState Link::pass_media(const Piece& piece, const Crossings& crossings, float t_end, Rgb& throughput,
                            Passage& passage) const {
  if (!between_.world.has_media()) return piece.media;
  SpanWalk walk(between_.world.media_context(), piece.media, crossings, t_end);
  while (const auto interval = walk.next()) {
    if (all_homogeneous(interval->view())) {
      pass_uniform(*interval, throughput, passage);
    } else {
      if (!has_all_channels(throughput)) passage.chance = 0;  // the flight does not tell of all
      pass_varying(*interval, piece.ray, passage);
    }
  }
  between_.counters.parity_errors += walk.parity_errors();
  return walk.state();
}

void Link::pass_uniform(const Interval& interval, Rgb& throughput, Passage& passage) const {
  const double length = double{interval.t1} - interval.t0;
  const UniformPassage uniform = passage_of(interval.view(), length, throughput);
  const Rgb T = uniform.transmittance;
  throughput *= T;
  passage.weight *= own_ ? Rgb(1 / T.r, 1 / T.g, 1 / T.b) : T;
  passage.chance *= has_all_channels(T) ? uniform.probability : 0.0f;
  passage.likely *= has_all_channels(T) ? mean(T) : 0.0f;
}

void Link::pass_varying(const Interval& interval, const Ray& ray, Passage& passage) const {
  const MediaView media = interval.view();
  const float t0 = interval.t0, t1 = interval.t1;
  TrackingStats& stats = between_.counters.tracking;
  passage.weight *= own_ ? inverse_transmittance(kInverseSpacing, media, ray, t0, t1, find_.rng, stats)
                         : transmittance({between_.transmittance}, media, ray, t0, t1, find_.rng, stats);
  const float passes = std::exp(-coarse_optical_depth(media, ray, t0, t1, kReads));
  passage.chance *= passes;
  passage.likely *= passes;
}

}  // namespace tyndall
