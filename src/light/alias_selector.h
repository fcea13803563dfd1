/// Choices that do not look at the point or segment: uniform, by power, all lights at once, and where there is no choice.
#pragma once

#include "light/selection.h"
#include "math/distribution.h"

namespace tyndall {

class AliasSelector : public LightSelector {
 public:
  explicit AliasSelector(const std::vector<double>& weights) : table_(weights) {}

  std::optional<SelectedLight> select(const PointQuery&, double u) const override { return draw(u); }
  std::optional<SelectedLight> select(const SegmentQuery&, double u) const override { return draw(u); }
  float pmf(const PointQuery&, LightId light) const override { return chance(light); }
  float pmf(const SegmentQuery&, LightId light) const override { return chance(light); }
  std::size_t memory_bytes() const override { return table_.memory_bytes(); }

 private:
  std::optional<SelectedLight> draw(double u) const {
    if (!(table_.total() > 0)) return std::nullopt;
    const auto choice = table_.sample(u);
    return SelectedLight{choice.index, static_cast<float>(choice.pmf)};
  }
  float chance(LightId light) const { return table_.total() > 0 ? static_cast<float>(table_.pmf(light)) : 0.0f; }

  AliasTable table_;
};

class ExhaustiveSelector final : public AliasSelector {
 public:
  using AliasSelector::AliasSelector;
  float pmf(const PointQuery&, LightId) const override { return 1; }
  float pmf(const SegmentQuery&, LightId) const override { return 1; }
  bool exhaustive() const override { return true; }
};

/// There is one light only.
class OnlyLight final : public LightSelector {
 public:
  explicit OnlyLight(LightId light) : light_(light) {}

  std::optional<SelectedLight> select(const PointQuery&, double) const override { return SelectedLight{light_, 1}; }
  std::optional<SelectedLight> select(const SegmentQuery&, double) const override { return SelectedLight{light_, 1}; }
  float pmf(const PointQuery&, LightId light) const override { return light == light_ ? 1.0f : 0.0f; }
  float pmf(const SegmentQuery&, LightId light) const override { return light == light_ ? 1.0f : 0.0f; }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  LightId light_;
};

}  // namespace tyndall
