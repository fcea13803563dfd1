/// A few lights that one pixel favours.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "light/query.h"
#include "math/small_vector.h"

namespace tyndall {

/// The brighter of two lights; of equals the first.
template <typename Item>
bool brighter(const Item& a, const Item& b) {
  return a.brightness != b.brightness ? a.brightness > b.brightness : a.light < b.light;
}

/// Weight of a light at an offset from the pixel, in radii of its filter. Less at the rim, as the filter is there, but what
/// reaches in from beyond has its share.
inline float toward_rim(float dx, float dy) { return std::exp(-2.25f * std::min(dx * dx + dy * dy, 1.5f)); }

/// The brightest of a pixel's lights, drawn in proportion to that. An `Item` has a `light` and a `brightness` >= 0, in any
/// unit.
template <typename Item>
class PixelLights {
 public:
  static constexpr std::size_t kMost = 8;  ///< others are left to the filter's samples
  using List = SmallVector<Item, kMost>;

  PixelLights() = default;
  explicit PixelLights(List items) : items_(std::move(items)) {
    if (items_.size() > kMost) {
      std::partial_sort(items_.begin(), items_.begin() + kMost, items_.end(), brighter<Item>);
      items_.truncate(kMost);
    }
    double sum = 0;
    for (const Item& item : items_) sum += item.brightness;
    if (!(sum > 0)) items_.clear();
    for (Item& item : items_) item.brightness = static_cast<float>(item.brightness / sum);
  }

  bool empty() const { return items_.empty(); }
  /// One of them, its brightness replaced by its probability; `u` in [0, 1). Not when empty.
  const Item& draw(float u) const {
    const Item* chosen = items_.begin();
    while (u >= chosen->brightness && chosen != &items_.back()) u -= (chosen++)->brightness;
    return *chosen;
  }
  /// Likewise; null where it is not among them.
  const Item* find(LightId light) const {
    const Item* found = std::find_if(items_.begin(), items_.end(), [&](const Item& item) { return item.light == light; });
    return found == items_.end() ? nullptr : found;
  }

 private:
  List items_;
};

}  // namespace tyndall
