#include "transport/suffix_reuse.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "volume/homogeneous.h"

namespace tyndall {
namespace {

/// Shadow rays end this fraction short of the surface, so that they do not meet it.
constexpr float kShadowEnd = 1 - 1e-4f;
/// Who finds a surface with a smaller part of the largest density is none of those who share it: it would hardly weigh, and
/// cost a shadow ray. What it finds of such surfaces by itself is its own. Any value is unbiased.
constexpr float kLeastPart = 0.05f;

/// From the first vertex of a path to a surface that was found.
struct Connection {
  Rgb f;          ///< scattering function times cosines over squared distance
  float pdf = 0;  ///< 1/area, with which the path would have found it, were nothing in between
};
/// What connections go through, and where they are counted.
struct Between {
  const BuiltWorld& world;
  Counters& counters;
};
using Connections = std::array<Connection, kMostSharing>;

bool same_side(Vec3 n, Vec3 a, Vec3 b) { return dot(n, a) * dot(n, b) > 0; }

Connection connect(const PathOffer& from, const Vertex& to) {
  const SurfaceHit& hit = to.surface()->hit;
  const Vec3 v = hit.p - from.first.p();
  const float d2 = length_squared(v);
  if (!(d2 > 0)) return {};
  const Vec3 w = v * (1 / std::sqrt(d2));
  if (!same_side(hit.ng, -w, to.wo()) || !same_side(hit.ns, -w, to.wo())) return {};
  const float pdf = from.directions.pdf(w, from.beta);
  if (!(pdf > 0)) return {};
  const float cosine_by_d2 = abs_dot(hit.ng, w) / d2;
  return {from.first.eval(w) * cosine_by_d2, pdf * cosine_by_d2};
}

/// What is in between: surfaces end the connection, and media that are not homogeneous; those that are weaken it.
Connection through(const Connection& connection, const Between& between, const PathOffer& from, const Vertex& to) {
  const BuiltWorld& world = between.world;
  const Vec3 w = normalize(to.p() - from.first.p()), origin = from.first.origin(world.geometry, w);
  const float distance = length(to.p() - origin);
  ++between.counters.shadow_rays;
  const auto crossings = world.geometry.trace_shadow({origin, w}, 0, distance * kShadowEnd);
  if (!crossings) return {};
  if (!world.has_media()) return connection;

  const MediaState media = from.first.media_toward(world.geometry, w);
  SpanWalk walk(world.media_context(), media, *crossings, distance);
  Connection passed = connection;
  while (const auto interval = walk.next()) {
    if (!all_homogeneous(interval->view())) return {};
    const UniformPassage passage = passage_of(interval->view(), double{interval->t1} - interval->t0, from.beta * passed.f);
    passed = {passed.f * passage.transmittance, passed.pdf * passage.probability};
  }
  between.counters.parity_errors += walk.parity_errors();
  return passed;
}

/// Who could have found what path number `finder` found, with which density: the others' are set to 0. Their sum; 0 where the
/// finder is left out, as its find is its own.
float keep_finders(const Between& between, std::span<Path* const> paths, std::size_t finder, Connections& all) {
  float most = 0;
  for (std::size_t k = 0; k < paths.size(); ++k) most = std::max(most, all[k].pdf);
  const float least = kLeastPart * most;
  const Vertex& found = *paths[finder]->offer().at;
  float sum = 0;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const bool finds = all[k].pdf > 0 && all[k].pdf >= least;
    all[k] = finds ? through(all[k], between, paths[k]->offer(), found) : Connection{};
    sum += all[k].pdf;
  }
  return all[finder].pdf > 0 ? sum : 0.0f;
}

}  // namespace

/// L(x1) = sum over finds x2 of f(x1, x2) L(x2) / sum_k p_k(x2): the balance heuristic's weights p_j / sum p_k over p_j.
void share_suffixes(const BuiltWorld& world, std::span<Path* const> paths, Counters& counters) {
  const Between between{world, counters};
  for (std::size_t j = 0; j < paths.size(); ++j) {
    const PathOffer& find = paths[j]->offer();
    if (is_black(find.radiance)) continue;
    Connections all;
    for (std::size_t k = 0; k < paths.size(); ++k) all[k] = connect(paths[k]->offer(), *find.at);
    // What is not a number stays with its path, and is counted once.
    const float sum = is_finite(find.radiance) ? keep_finders(between, paths, j, all) : 0;
    if (!(sum > 0) || !std::isfinite(sum)) {
      paths[j]->take(find.arrived * find.radiance);
      continue;
    }
    for (std::size_t k = 0; k < paths.size(); ++k) {
      if (all[k].pdf > 0) paths[k]->take(paths[k]->offer().beta * all[k].f * find.radiance * (1 / sum));
    }
  }
}

}  // namespace tyndall
