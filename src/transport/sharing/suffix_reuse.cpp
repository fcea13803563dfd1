#include "transport/sharing/suffix_reuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "transport/sample/prices.h"
#include "transport/sharing/segment_shares.h"
#include "transport/sharing/vertex_shares.h"

namespace tyndall {
namespace {

/// Of the work of finding, what handing out may take: about where variance x cost is least (docs/measurements.md). Where
/// finding is cheap little but finds makes noise, and so many for each path pay in any case.
constexpr double kHandingOut = 0.7, kCheapFinds = 16;

/// What a connection takes, by the prices of the same media on the paths' rays.
double price_of_link(const Prices& prices, const Counters& finding) {
  Counters link;
  link.connections = link.shadow_rays = 1;
  const auto rays = static_cast<double>(finding.rays + finding.shadow_rays);
  Counters media;
  media.tracking = finding.tracking;
  return prices.of(link) + (rays > 0 ? prices.of(media) / rays : 0);
}

/// Finds for each path, at most on average.
double finds_that_pay(const Prices& prices, const Counters& finding, std::size_t paths) {
  const double links = kHandingOut * prices.of(finding) / price_of_link(prices, finding);
  return std::max(kCheapFinds, links / static_cast<double>(paths));
}

/// Counts a find of the path where it is alone.
void keep(Path& path, const Find& find) { path.take(path.own_factor(find), find, Path::received_at(find.of->first)); }

/// What the find brings its own path, which is of the order of what it brings others. Zero: there is nothing to share, for none
/// of them; what brings its own path alone nothing, by its colour or its weight, is worth next to nothing instead. What is not
/// a number stays with its path, where it is counted once.
float worth_of(Path& path, const Find& find) {
  if (find.of->at && is_black(find.radiance)) return 0;
  const Rgb own = path.own_factor(find) * find.radiance;
  if (is_finite(own)) return std::max(mean(absolute(own)), std::numeric_limits<float>::min());
  keep(path, find);
  return 0;
}

/// Finds that have something to share, each with what it is worth.
struct Worth {
  const Find* find;
  float worth;
};

std::vector<Worth> worth_of(std::span<Path* const> finders) {
  std::vector<Worth> finds;
  for (Path* path : finders) {
    for (const Find& find : path->offer().finds) {
      if (const float worth = worth_of(*path, find); worth > 0) finds.push_back({&find, worth});
    }
  }
  return finds;
}

/// About how many receive a find: asked once for all finds of a path, which are at the same place, as the first of them.
template <typename Shares>
class Sharers {
 public:
  explicit Sharers(Shares& shares) : shares_(shares) {}
  double of(const Find& find) {
    if (find.of != asked_) {
      asked_ = find.of;
      answer_ = double{shares_.sharers(find)};
    }
    return answer_;
  }

 private:
  Shares& shares_;
  const PathOffer* asked_ = nullptr;
  double answer_ = 0;
};

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

/// Of the `finders`, whose finds `receivers` can receive. A find of worth c that a of n receive costs a connections, and the
/// variance of leaving it to chance is spread over as many: c^2 / a is least for a given cost where chances go with c / a. With
/// n c / (a sum c) times `most` each gets that many, at most; where few finds have nearly all, as where rays pass a flame
/// by chance, fewer.
template <typename Shares>
void share_among(Shares& shares, std::span<Path* const> finders, std::size_t receivers, double most) {
  const std::vector<Worth> finds = worth_of(finders);
  if (finds.empty()) return;
  double total = 0;
  for (const Worth& w : finds) total += double{w.worth};
  Sharers sharers(shares);
  Roulette roulette(finds.front().find->of->rng.uniform() + 0x1p-25);
  for (const auto& [find, worth] : finds) {
    double chance = most * worth / total;
    if (chance < 1) chance *= static_cast<double>(receivers) / sharers.of(*find);
    chance = std::min(1.0, chance);
    if (roulette.survives(chance)) shares.share(*find, static_cast<float>(1 / chance));
  }
}

void share_at_vertices(const Between& between, std::span<Path* const> finders, double most) {
  VertexShares shares(between);
  for (Path* path : finders) shares.add_arrived(*path);
  share_among(shares, finders, finders.size(), most);
}

}  // namespace

/// Finders on surfaces and in media are not mixed: what they find is found so differently that it is not worth connecting.
void share_suffixes(const Between& between, std::span<Path* const> paths, const Counters& finding,
                    std::optional<bool> collisions_shared) {
  if (paths.empty()) return;
  std::array<Path*, kMostSharing> finders;
  auto* const end = std::copy_if(paths.begin(), paths.end(), finders.begin(), [](const Path* path) { return path->offers(); });
  auto* const middle = std::stable_partition(finders.begin(), end, [](Path* path) { return path->offer().first.on_surface(); });
  const std::span<Path* const> on_surface(finders.begin(), middle);
  const std::span<Path* const> in_medium(middle, end);
  const double most = finds_that_pay(Prices(between.world.lights.size()), finding, paths.size());
  if (!SegmentShares::pay(paths)) {
    share_at_vertices(between, on_surface, most);
    if (in_medium.empty()) return;
    if (collisions_shared ? *collisions_shared : SegmentShares::near_each_other(paths)) {
      share_at_vertices(between, in_medium, most);
    } else {
      for (Path* path : in_medium) {
        for (const Find& find : path->offer().finds) keep(*path, find);
      }
    }
    return;
  }
  // What is received along a ray and behind it has half of the work each.
  VertexShares surfaces(between);
  for (Path* path : paths) surfaces.add_behind(*path);
  share_among(surfaces, on_surface, paths.size(), most / 2);
  SegmentShares segments(between, paths);
  share_among(segments, in_medium, paths.size(), most / 2);
  segments.hand_out();
}

}  // namespace tyndall
