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
/// Finds for each path, at most on average.
constexpr double kMostFinds = 16;
/// Paths, with the finder, that are asked whether they might have made a find.
constexpr std::size_t kProbes = 8;

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

/// What a path makes of the light of its own find.
Rgb reached(const PathOffer& find) { return find.arrived * find.scattered; }

/// L(x1) = sum over finds x2 of f(x1, x2) L(x2) / sum_k p_k(x2): the balance heuristic's weights p_j / sum p_k over p_j. All
/// of `paths` count as finders, whether they found anything or not. `scale`: of the find's light.
void share_find(const Between& between, std::span<Path* const> paths, std::size_t finder, float scale) {
  const Path& path = *paths[finder];
  const Rgb own = reached(path.offer()) * scale;
  const Shares shares(between, paths, finder);
  if (!shares.shared()) {
    paths[finder]->take(own, path);
    return;
  }
  const Rgb others = shares.flight() * (scale / shares.sum());
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const Connection& to = shares[k];
    if (to.pdf > 0) paths[k]->take(k == finder ? own * (to.pdf / shares.sum()) : paths[k]->offer().beta * to.f * others, path);
  }
}

/// What the find brings its own path, which is of the order of what it brings others. Zero: there is nothing to share. What is
/// not a number stays with its path, where it is counted once.
float worth_of(Path& path) {
  const PathOffer& find = path.offer();
  if (!find.at || is_black(find.radiance)) return 0;
  const Rgb own = reached(find) * find.radiance;
  if (is_finite(own)) return mean(own);
  path.take(reached(find), path);
  return 0;
}

/// Roulette by strata of one number: how many survive hardly varies.
class Roulette {
 public:
  explicit Roulette(double u) : next_(u) {}
  bool survives(double chance) {
    passed_ += chance;
    if (!(passed_ > next_)) return false;
    next_ += 1;
    return true;
  }

 private:
  double passed_ = 0, next_;
};

/// How many of `paths`, about, might have made the find: itself, and of the others as many as of some, evenly spread.
float finders_of(std::span<Path* const> paths, std::size_t finder) {
  const PathOffer& find = paths[finder]->offer();
  const float least = kLeastPart * connect(find, find).pdf;
  if (!(least > 0)) return 1;
  const std::size_t n = paths.size(), step = (n + kProbes - 1) / kProbes;
  int probes = 0, might = 0;
  for (std::size_t i = step; i < n; i += step, ++probes) might += connect(paths[(finder + i) % n]->offer(), find).pdf >= least;
  return might > 0 ? 1 + static_cast<float>(might) / static_cast<float>(probes) * static_cast<float>(n - 1) : 1;
}

/// A find of worth c that a of n paths share costs a connections, and the variance of leaving it to chance is spread over as
/// many: c^2 / a is least for a given cost where chances go with c / a. With n c / (a sum c) times kMostFinds each path gets
/// that many, at most; where few finds have nearly all, as where rays pass a flame by chance, fewer.
void share_among(const Between& between, std::span<Path* const> paths) {
  std::array<float, kMostSharing> worth;
  double total = 0;
  for (std::size_t j = 0; j < paths.size(); ++j) total += worth[j] = worth_of(*paths[j]);
  if (!(total > 0)) return;
  const auto* const first = std::find_if(worth.begin(), worth.end(), [](float w) { return w > 0; });
  Roulette roulette(paths[static_cast<std::size_t>(first - worth.begin())]->offer().rng.uniform() + 0x1p-25);
  for (std::size_t j = 0; j < paths.size(); ++j) {
    double chance = std::min(1.0, kMostFinds * worth[j] / total);
    if (worth[j] > 0 && chance < 1) chance = std::min(1.0, chance * static_cast<double>(paths.size()) / finders_of(paths, j));
    if (worth[j] > 0 && roulette.survives(chance)) share_find(between, paths, j, static_cast<float>(1 / chance));
  }
}

}  // namespace

/// Paths whose first vertices are of one kind: what surfaces find and what collisions find is found so differently that it is
/// not worth connecting.
void share_suffixes(const Between& between, std::span<Path* const> paths) {
  for (const bool on_surface : {true, false}) {
    std::array<Path*, kMostSharing> alike;
    const auto end = std::copy_if(paths.begin(), paths.end(), alike.begin(),
                                  [&](Path* path) { return path->offer().first.on_surface() == on_surface; });
    share_among(between, {alike.begin(), end});
  }
}

}  // namespace tyndall
