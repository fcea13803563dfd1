#include "transport/sharing/segment_shares.h"

#include <algorithm>
#include <cmath>

#include "transport/media/scattering.h"
#include "transport/media/span_distance.h"
#include "transport/media/transmittance_walk.h"

namespace tyndall {
namespace {

/// Distances toward several finds are spread by the golden ratio.
constexpr float kGolden = 0.618034f;

/// Where media are known by look-ups, what is received behind them has to be tracked for every ray: more than it gains. Where
/// few rays collide, passing and colliding are told apart with little noise anyway (docs/measurements.md).
constexpr std::size_t kLooks = 4;
constexpr float kCloser = 4, kLeastColliding = 0.25f;
/// Of the density with which a path makes a find itself, the least part of others that have part in it.
constexpr double kLeastPart = 0.05;
/// Mean free paths between two rays, a third of the block apart, beyond which sharing is more noise than it takes away.
constexpr float kApart = 2;

/// About how far light goes along the segment from one collision to the next.
float free_path(CameraSegment& segment) {
  return segment.profile()->reach() / std::max(segment.profile()->optical_depth(), 1.0f);
}

/// Between two rays where one of them scatters most.
float gap(const CameraSegment& a, CameraSegment& b) {
  const float t = b.profile()->begin() + 0.5f * b.profile()->reach();
  return length(a.span().ray.at(t) - b.span().ray.at(t));
}

/// Colliding on the camera's ray, and going on toward a find: what both ways to receive it know of that.
struct Collision {
  Collision(CameraSegment& segment, float t, const Find& find)
      : part(&segment.span().part_at(t)),
        p(segment.span().ray.at(t)),
        wo(-segment.span().ray.d),
        scattering(Scattering::at(part->media, p)) {
    const auto sighting = sight(find, p);
    if (!sighting) return;
    const auto& [w, back] = *sighting;
    f = scattering.sigma_s * scattering.phase.eval(wo, w) * back.f;
    pdf = segment.density(t, scattering.sigma_t) * scattering.pdf(wo, w) * back.pdf;
  }

  const SpanPart* part;
  Vec3 p, wo;
  Scattering scattering;
  Rgb f;
  float pdf = 0;  ///< 1/length, times that of the find; without the chance of flying there
};

/// Whether the path rather than others finds this: they would hardly have part in it, and cost shadow rays. By what all know
/// who might receive it there.
bool is_own(const Collision& collision, double others) { return !(kLeastPart * double{collision.pdf} < others); }

/// Of a block's rays a few tell: number i of them; null where it passes no media that scatter.
CameraSegment* look(std::span<Path* const> paths, std::size_t i) {
  CameraSegment* const segment = paths[i * (paths.size() - 1) / (kLooks - 1)]->segment();
  return segment && segment->profile() ? segment : nullptr;
}

}  // namespace

/// Of a find's light at a place of the receiver's ray, before visibility.
struct SegmentShares::Candidate {
  const Shared* shared;
  float t;
  Collision collision;
  float others;  ///< density with which others made the find, and the receiver drew the place
};

bool SegmentShares::pay(std::span<Path* const> paths) {
  CameraSegment* before = nullptr;
  float colliding = 0;
  for (std::size_t i = 0; i < kLooks; ++i) {
    CameraSegment* const segment = look(paths, i);
    if (!segment) continue;
    if (!homogeneous_throughout(segment->span().parts)) return false;
    if (before && kCloser * gap(*before, *segment) > free_path(*segment)) return false;
    colliding += 1 - segment->chance_of_passing();
    before = segment;
  }
  return colliding >= kLeastColliding * kLooks;
}

bool SegmentShares::near_each_other(std::span<Path* const> paths) {
  CameraSegment* before = nullptr;
  float gaps = 0, free_paths = 0;
  for (std::size_t i = 0; i < kLooks; ++i) {
    CameraSegment* const segment = look(paths, i);
    if (!segment) continue;
    if (homogeneous_throughout(segment->span().parts)) return true;
    if (before) gaps += gap(*before, *segment), free_paths += free_path(*segment);
    before = segment;
  }
  return gaps <= kApart * free_paths;
}

SegmentShares::SegmentShares(const Between& between, std::span<Path* const> paths) : between_(between), paths_(paths) {
  for (std::size_t k = 0; k < paths.size(); ++k) {
    if (paths[k]->offers() && !paths[k]->offer().first.on_surface()) makers_.push_back(k);
    CameraSegment* const segment = paths[k]->segment();
    if (segment && segment->profile()) receivers_.push_back(k);
  }
}

SegmentShares::Shared SegmentShares::consider(const Find& find) const {
  Shared shared{.find = &find, .maker = 0, .scale = 1, .flight = {}};
  between_.counters.connections += makers_.size();
  for (const std::size_t k : makers_) {
    if (&paths_[k]->offer() == find.of) shared.maker = k;
    shared.might[k] = connect(paths_[k]->offer(), find).pdf;
    shared.might_sum += double{shared.might[k]};
  }
  return shared;
}

float SegmentShares::sharers(const Find& find) {
  const Shared shared = consider(find);
  CameraSegment& segment = *paths_[shared.maker]->segment();
  if (!segment.profile()) return 1;
  const double others = shared.might_sum - double{shared.might[shared.maker]};
  const double b = others * double{segment.distances_to(find.of->place()).pdf(segment.collision())};
  const auto all = static_cast<double>(makers_.size() + receivers_.size());
  return static_cast<float>(std::min(1 + b / double{Collision(segment, segment.collision(), find).pdf}, all));
}

void SegmentShares::share(const Find& find, float scale) {
  Shared shared = consider(find);
  shared.scale = scale;
  for (const std::size_t k : makers_) {
    if (!(shared.might[k] > 0)) continue;
    const PathOffer& maker = paths_[k]->offer();
    const bool own = k == shared.maker;
    const Link link = own ? Link::own(between_, *find.of) : Link(between_, maker.first, *find.of);
    const auto passage = link.pass(maker.beta * connect(maker, find).f);
    if (!passage) continue;
    shared.made[k] = shared.might[k] * passage->chance;
    shared.made_sum += double{shared.made[k]};
    if (!own) continue;
    shared.likely = passage->likely;
    shared.flight = passage->flight();
  }
  finds_.push_back(shared);
}

void SegmentShares::hand_out() {
  for (const std::size_t k : receivers_) receive(k);
  for (const Shared& shared : finds_) {
    Path& path = *paths_[shared.maker];
    if (!path.segment()->profile())
      path.take(path.own_factor(*shared.find) * shared.scale, *shared.find, Path::Received::in_medium);
  }
}

void SegmentShares::receive(std::size_t k) {
  CameraSegment& segment = *paths_[k]->segment();
  between_.counters.connections += finds_.size();
  std::vector<Candidate> candidates;
  float u = segment.u();
  for (const Shared& shared : finds_) {
    u += u < 1 - kGolden ? kGolden : kGolden - 1;
    if (shared.maker == k) {
      take_own(shared);
    } else if (const auto candidate = draw(shared, k, u)) {
      candidates.push_back(*candidate);
    }
  }
  if (candidates.empty()) return;
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.t < b.t; });
  TransmittanceWalk walk({between_.transmittance, kSegmentSpacing}, segment.span(), segment.rng(), between_.counters.tracking);
  for (const Candidate& candidate : candidates) {
    const Rgb T = walk.to(candidate.t);
    if (is_black(T)) return;
    link(candidate, *paths_[k], T);
  }
}

void SegmentShares::take_own(const Shared& shared) const {
  const std::size_t k = shared.maker;
  const Find& find = *shared.find;
  CameraSegment& segment = *paths_[k]->segment();
  const float t = segment.collision(), drawn = segment.distances_to(find.of->place()).pdf(t);
  const Collision collision(segment, t, find);
  float share = 1;
  if (!is_own(collision, (shared.might_sum - double{shared.might[k]}) * double{drawn})) {
    const float own = collision.pdf * shared.likely;
    const float others = static_cast<float>(shared.made_sum - double{shared.made[k]}) * drawn;
    if (own > 0 && std::isfinite(own + others)) share = own / (own + others);
  }
  paths_[k]->take(paths_[k]->own_factor(find) * (shared.scale * share), find, Path::Received::in_medium);
}

std::optional<SegmentShares::Candidate> SegmentShares::draw(const Shared& shared, std::size_t k, float u) const {
  CameraSegment& segment = *paths_[k]->segment();
  const Find& find = *shared.find;
  const auto made = static_cast<float>(shared.made_sum - double{shared.made[k]});
  if (is_black(shared.flight) || !(made > 0) || !std::isfinite(made)) return std::nullopt;
  const auto [t, drawn] = segment.distances_to(find.of->place()).sample(std::min(u, kOneMinusEpsilon));
  if (!(drawn > 0) || !std::isfinite(t)) return std::nullopt;
  const Collision collision(segment, t, find);
  if (t < collision.part->t0 || t > collision.part->t1 || is_black(collision.f)) return std::nullopt;
  if (!(collision.pdf > 0)) return std::nullopt;
  if (is_own(collision, (shared.might_sum - double{shared.might[k]}) * double{drawn})) return std::nullopt;
  return Candidate{&shared, t, collision, made * drawn};
}

void SegmentShares::link(const Candidate& candidate, Path& receiver, Rgb T) const {
  const auto& [shared, t, collision, others] = candidate;
  const Vertex vertex(Vertex::InMedium{collision.p, collision.scattering.phase}, collision.wo, collision.part->state);
  const auto passage = Link(between_, vertex, *shared->find->of).pass(Rgb(1.0f));
  if (!passage) return;
  const float own = collision.pdf * passage->likely;
  if (!(own > 0) || !std::isfinite(own + others)) return;
  receiver.take_at(vertex, t, collision.f * T * passage->weight * shared->flight * (shared->scale / (own + others)),
                   *shared->find);
}

}  // namespace tyndall
