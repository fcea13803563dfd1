/// What paths spend where it matters most: lights asked at their first vertex and along their first segment, and what they
/// share.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "tyndall/settings.h"

namespace tyndall {

struct LightCounts {
  int candidates;   ///< 0: as many as splitting makes clusters
  int shadow_rays;  ///< 0: to all candidates

  bool operator==(const LightCounts&) const = default;
};

/// What is counted: numbers of candidates and shadow rays, at a path's first vertex and along its first segment.
enum class Spent : std::size_t { vertex_candidates, vertex_rays, span_candidates, span_rays };
inline constexpr std::size_t kSpents = 4;

template <typename T>
class PerSpent : public std::array<T, kSpents> {
 public:
  using std::array<T, kSpents>::operator[];
  T& operator[](Spent s) { return (*this)[static_cast<std::size_t>(s)]; }
  const T& operator[](Spent s) const { return (*this)[static_cast<std::size_t>(s)]; }
};

struct LightBudget {
  LightCounts vertex, span;
  bool counts_measured = false;
  /// Whether neighbours share what they find beyond collisions in grids. Nothing: by how far apart they are (segment_shares.h).
  std::optional<bool> collisions_shared{};

  /// What stands where nothing is measured. Light of later vertices is averaged over the paths that share it, that of the first
  /// is not; and where there is none a path has nothing else to pay for.
  static LightBudget unmeasured(const RenderSettings& settings) {
    if (settings.max_depth == 1) return {{8, 4}, {16, 8}};
    return {settings.reuse == ReuseStrategy::pixels ? LightCounts{8, 4} : LightCounts{2, 2}, {3, 2}};
  }
};

/// Of samples that were rendered with some budget, each in the same unit of variance; averages over blocks.
struct Trials {
  PerSpent<double> variance{}, cost{};  ///< of the choices
  double all_variance = 0, all_cost = 0;
  double trust = 1;  ///< from 0, they may be wrong, to 1, they know: how far the budget follows them
};

/// What choices don't add, but no less than noise leaves to be known.
double rest_of_variance(const Trials& trials);

/// The choices of `choices` beside all else of `others`: numbers that make these pay hide what they leave to chance.
Trials beside(const Trials& choices, const Trials& others);

/// The numbers n_i that make variance x cost least. With B_i and c_i of one more of each, and A and C of all else, that is
/// (A + sum B_i / n_i) (C + sum c_i n_i), least at n_i = sqrt(B_i C / (A c_i)). From 2 to 64; what trials can't tell stays as
/// it was during them. No more rays than candidates.
LightBudget best_budget(const Trials& trials, const LightBudget& during);

}  // namespace tyndall
