/// Choice among lights at infinity: suns and environments, by the irradiance they may give.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "light/cone.h"
#include "light/segment_importance.h"

namespace tyndall {

/// Light that arrives from the directions of a cone. A sun is one cone of angle 0, an environment several.
struct FarCone {
  DirectionCone directions;  ///< toward the light
  Vec3 mean;                 ///< mean direction of the light, not normalised: its length says how concentrated it is
  float fluence = 0;         ///< radiance integrated over the cone, W/m^2
  float sampled = 0;         ///< of the part that is not left to scattered rays
};

struct FarLight {
  std::vector<FarCone> cones;
  LightId light;
};

/// Importance is an irradiance: the unit of intensity / distance^2, so that it compares with the light tree's; for a
/// segment, irradiance times what of its length scatters the light toward the origin.
/// Chosen by a linear pass, since scenes have few such lights.
class FarLights {
 public:
  FarLights() = default;
  explicit FarLights(std::span<const FarLight> lights);

  struct Choice {
    LightId light;
    double pmf;
  };
  std::optional<Choice> select(const PointQuery& query, double u) const;
  std::optional<Choice> select(const Segment& query, double u) const;
  double pmf(const PointQuery& query, std::uint32_t index) const;  ///< index: order of construction
  double pmf(const Segment& query, std::uint32_t index) const;
  double importance(const PointQuery& query) const;  ///< of all
  double importance(const Segment& query) const;

  bool empty() const { return lights_.empty(); }
  std::size_t size() const { return lights_.size(); }
  std::size_t memory_bytes() const { return cones_.capacity() * sizeof(Cone) + lights_.capacity() * sizeof(Entry); }

 private:
  struct Cone {
    Vec3 axis, mean;
    double cos, sin;  ///< of the half angle
    float sampled;
  };
  struct Entry {
    LightId light;
    std::uint32_t begin, end;  ///< its cones
  };
  static double cone_importance(const Cone& cone, const PointQuery& query);
  struct LitSegment;
  static double cone_importance(const Cone& cone, const LitSegment& query);
  template <typename Query>
  double light_importance(std::uint32_t index, const Query& query) const;
  template <typename Query>
  std::optional<Choice> choose(const Query& query, double u) const;
  template <typename Query>
  double share(const Query& query, std::uint32_t index) const;
  template <typename Query>
  double sum(const Query& query) const;

  std::vector<Cone> cones_;
  std::vector<Entry> lights_;
};

}  // namespace tyndall
