#include "transport/suffix_reuse.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "volume/coarse.h"
#include "volume/homogeneous.h"

namespace tyndall {
namespace {

/// Shadow rays end this fraction short of the surface, so that they do not meet it.
constexpr float kShadowEnd = 1 - 1e-4f;
/// Who makes a find with a smaller part of the largest density is none of those who share it: it would hardly weigh, and
/// cost a shadow ray. What it finds there by itself is its own. Any value is unbiased.
constexpr float kLeastPart = 0.05f;
/// Steps of marching: as for shadow rays, and half of it for inverses, whose noise has a longer tail.
constexpr float kSpacing = 0.5f, kInverseSpacing = 0.25f;
/// Reads of a grid for the chance of passing it.
constexpr int kReads = 16;

/// From the first vertex of a path to a find.
struct Connection {
  Rgb f;          ///< scattering functions times cosine over squared distance
  float pdf = 0;  ///< 1/area or 1/volume, times that of the find's direction, by which the path would have made it
};
/// What lies in between.
struct Passage {
  Rgb weight{1.0f};  ///< the transmittance; of a path's own find, what its flight weighs over its transmittance
  float chance = 1;  ///< of flying through: a proxy in grids, that both sides know
};
using Connections = std::array<Connection, kMostSharing>;

bool same_side(Vec3 n, Vec3 a, Vec3 b) { return dot(n, a) * dot(n, b) > 0; }
bool has_all_channels(Rgb c) { return c.r != 0 && c.g != 0 && c.b != 0; }

/// What the find scatters back along `w`, and how likely: the factors of a Connection that are the find's.
Connection scattered_back(const PathOffer& find, Vec3 w) {
  if (const auto* medium = find.at->medium()) {
    const Rgb phase = medium->phase.eval(-w, find.wi);
    return {phase, has_all_channels(phase) ? medium->phase.pdf(-w, find.wi, Rgb(1.0f)) : 0.0f};
  }
  const SurfaceHit& hit = find.at->surface()->hit;
  if (!same_side(hit.ng, -w, find.at->wo()) || !same_side(hit.ns, -w, find.at->wo())) return {};
  const float cosine = abs_dot(hit.ng, w);
  return {Rgb(cosine), cosine};
}

Connection connect(const PathOffer& from, const PathOffer& find) {
  const Vec3 v = find.at->p() - from.first.p();
  const float d2 = length_squared(v);
  if (!(d2 > 0)) return {};
  const Vec3 w = v * (1 / std::sqrt(d2));
  const Connection back = scattered_back(find, w);
  if (!(back.pdf > 0)) return {};
  const float pdf = from.directions.pdf(w, from.beta);
  if (!(pdf > 0)) return {};
  return {from.first.eval(w) * back.f * (1 / d2), pdf * back.pdf / d2};
}

/// From the first vertex of a path to a find, which may be its own.
class Link {
 public:
  Link(const Between& between, const PathOffer& from, PathOffer& find) : between_(between), find_(find), own_(&from == &find) {
    const Geometry& geometry = between.world.geometry;
    const Vec3 w = normalize(find.at->p() - from.first.p());
    ray_ = {from.first.origin(geometry, w), w};
    media_ = from.first.media_toward(geometry, w);
  }

  /// By light of `throughput` before it. Nothing where surfaces are in between, and where a flight does not tell of all
  /// channels.
  std::optional<Passage> pass(Rgb throughput) const {
    const BuiltWorld& world = between_.world;
    const float distance = length(find_.at->p() - ray_.o);
    ++between_.counters.shadow_rays;
    const auto crossings = world.geometry.trace_shadow(ray_, 0, find_.at->on_surface() ? distance * kShadowEnd : distance);
    if (!crossings) return std::nullopt;
    Passage passage;
    if (own_) passage.weight = find_.flown;
    if (!world.has_media()) return passage;

    SpanWalk walk(world.media_context(), media_, *crossings, distance);
    while (const auto interval = walk.next()) {
      if (all_homogeneous(interval->view())) {
        pass_uniform(*interval, throughput, passage);
      } else if (has_all_channels(throughput)) {
        pass_varying(*interval, passage);
      } else {
        return std::nullopt;
      }
    }
    between_.counters.parity_errors += walk.parity_errors();
    return passage;
  }

 private:
  void pass_uniform(const Interval& interval, Rgb& throughput, Passage& passage) const {
    const double length = double{interval.t1} - interval.t0;
    const UniformPassage uniform = passage_of(interval.view(), length, throughput);
    const Rgb T = uniform.transmittance;
    throughput *= T;
    passage.weight *= own_ ? Rgb(1 / T.r, 1 / T.g, 1 / T.b) : T;
    passage.chance *= has_all_channels(T) ? uniform.probability : 0.0f;
  }

  void pass_varying(const Interval& interval, Passage& passage) const {
    const MediaView media = interval.view();
    const float t0 = interval.t0, t1 = interval.t1;
    TrackingStats& stats = between_.counters.tracking;
    passage.weight *= own_ ? inverse_transmittance(kInverseSpacing, media, ray_, t0, t1, find_.rng, stats)
                           : transmittance({between_.transmittance, kSpacing}, media, ray_, t0, t1, find_.rng, stats);
    passage.chance *= std::exp(-coarse_optical_depth(media, ray_, t0, t1, kReads));
  }

  const Between& between_;
  PathOffer& find_;
  Ray ray_;
  MediaState media_;
  bool own_;
};

/// One find, and who shares it.
class Shares {
 public:
  Shares(const Between& between, std::span<Path* const> paths, std::size_t finder) {
    PathOffer& find = paths[finder]->offer();
    for (std::size_t k = 0; k < paths.size(); ++k) to_[k] = connect(paths[k]->offer(), find);
    const float least = kLeastPart * largest_pdf();
    for (std::size_t k = 0; k < paths.size(); ++k) {
      if (to_[k].pdf > 0 && to_[k].pdf >= least) {
        reach(k, Link(between, paths[k]->offer(), find).pass(paths[k]->offer().beta * to_[k].f), k == finder);
      } else {
        to_[k] = {};
      }
      sum_ += to_[k].pdf;
    }
    shared_ = to_[finder].pdf > 0 && std::isfinite(sum_);
  }

  bool shared() const { return shared_; }  ///< else it is its path's own
  const Connection& operator[](std::size_t k) const { return to_[k]; }
  float sum() const { return sum_; }
  Rgb flight() const { return flight_; }

 private:
  float largest_pdf() const {
    return std::max_element(to_.begin(), to_.end(), [](auto& a, auto& b) { return a.pdf < b.pdf; })->pdf;
  }

  void reach(std::size_t k, const std::optional<Passage>& passage, bool own) {
    Connection& to = to_[k];
    if (!passage || !(passage->chance > 0)) {
      to = {};
      return;
    }
    to.pdf *= passage->chance;
    if (own) {
      flight_ = passage->weight * passage->chance;
    } else {
      to.f *= passage->weight;
    }
  }

  Connections to_;  // of pdf 0: not one who shares
  float sum_ = 0;   // of their densities
  Rgb flight_;      // what the find's own flight weighs, over its proxy
  bool shared_ = false;
};

}  // namespace

/// L(x1) = sum over finds x2 of f(x1, x2) L(x2) / sum_k p_k(x2): the balance heuristic's weights p_j / sum p_k over p_j. All
/// paths count as finders, whether they found anything or not.
void share_suffixes(const Between& between, std::span<Path* const> paths) {
  for (std::size_t j = 0; j < paths.size(); ++j) {
    const PathOffer& find = paths[j]->offer();
    if (!find.at || is_black(find.radiance)) continue;
    const Rgb reached = find.arrived * find.scattered, own = reached * find.radiance;
    if (!is_finite(find.radiance)) {
      paths[j]->take(own, reached, *paths[j]);  // what is not a number stays with its path, and is counted once
      continue;
    }
    const Shares shares(between, paths, j);
    if (!shares.shared()) {
      paths[j]->take(own, reached, *paths[j]);
      continue;
    }
    const Rgb others = shares.flight() * find.radiance * (1 / shares.sum());
    const Rgb by_flight = shares.flight() * (1 / shares.sum());
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const Connection& to = shares[k];
      if (!(to.pdf > 0)) continue;
      const float part = to.pdf / shares.sum();
      const Rgb connected = paths[k]->offer().beta * to.f;
      if (k == j) {
        paths[k]->take(own * part, reached * part, *paths[j]);
      } else {
        paths[k]->take(connected * others, connected * by_flight, *paths[j]);
      }
    }
  }
}

}  // namespace tyndall
