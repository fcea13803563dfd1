/// How one light is chosen among all. Each strategy is a LightSelector; registering one is a row in selection.cpp and
/// one in the table of names (math/settings.cpp).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "light/far_lights.h"
#include "light/light_cut.h"
#include "light/light_tree.h"
#include "light/query.h"
#include "light/segment_query.h"
#include "light/shared_lights.h"
#include "tyndall/settings.h"

namespace tyndall {

/// select() and pmf() belong together; both are pure functions of the query.
class LightSelector {
 public:
  virtual ~LightSelector() = default;

  /// One light for the point, by one number of 52 or more random bits in [0, 1). Nothing: no light is known to
  /// contribute.
  virtual std::optional<SelectedLight> select(const PointQuery& query, double u) const = 0;
  /// Probability that select() gives `light`; exhaustive: 1.
  virtual float pmf(const PointQuery& query, LightId light) const = 0;
  /// The clusters that a vertex draws its candidates from. Unless a strategy has finer ones: all lights as one.
  virtual LightCut cut(const PointQuery& query, const CutSettings& settings) const;
  /// All candidates of the query's cut by one number as of select(); fewer where no light is known to contribute.
  virtual LightCandidates draw(const LightCut& cut, const PointQuery& query, double u) const;
  /// n * pmf of `light` over the candidates of the cut; exhaustive: 1.
  virtual float n_pmf(const LightCut& cut, const PointQuery& query, LightId light) const;

  // The same for a segment of a ray through media: a light is chosen for all that the segment scatters.
  virtual std::optional<SelectedLight> select(const SegmentQuery& query, double u) const = 0;
  virtual float pmf(const SegmentQuery& query, LightId light) const = 0;
  virtual LightCut cut(const SegmentQuery& query, const CutSettings& settings) const;
  virtual LightCandidates draw(const LightCut& cut, const SegmentQuery& query, double u) const;
  virtual float n_pmf(const LightCut& cut, const SegmentQuery& query, LightId light) const;

  /// Callers loop over all lights, each with pmf 1, in place of select().
  virtual bool exhaustive() const { return false; }
  /// The strategy itself says how many candidates there are, and unless told otherwise all are traced: CutSettings::candidates
  /// is then the most that a cut may have, 0 for the strategy's own limit.
  virtual bool sizes_cut() const { return false; }
  virtual std::size_t memory_bytes() const = 0;
};

/// What selectors are built from. Lights without power stand in `power` alone.
struct SelectionInput {
  std::vector<double> power;  ///< by LightId, W; 0: never chosen. Lights of instances follow
  std::vector<TreeLight> near;
  std::vector<FarLight> far;
  std::vector<SharedLights> objects{};
  std::vector<LightInstance> instances{};  ///< in the order of their lights
  int threads = 0;                         ///< to build with; 0: one a core
  Bounds3 region{};                        ///< encloses what can be lit, but for media without bounds; empty: not known
};

/// Whether a strategy looks at `near` and `far`.
bool uses_bounds(LightStrategy strategy);
/// Frees what it has read of `input`: pass a copy where it is needed again. LightStrategy::tree keeps the lights of objects
/// once; the others store those of every instance on its own: uniform and power with 16 bytes each (40 while they are built),
/// binary trees with about 110 (170).
std::unique_ptr<const LightSelector> make_selector(LightStrategy strategy, SelectionInput input);

}  // namespace tyndall
