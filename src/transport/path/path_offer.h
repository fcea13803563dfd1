/// What a path offers to the paths of neighbouring pixels.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "transport/sample/grouped_light.h"
#include "transport/techniques/sought_lights.h"

namespace tyndall {

/// Most paths that share.
inline constexpr std::size_t kMostSharing = 64;

struct PathOffer;

/// Light that comes from one direction to where a path went after its first vertex: of a light that was sought there, or by the
/// path's next ray. What a separable surface scatters, wherever it came from, is a single find, from no direction.
struct Find {
  PathOffer* of = nullptr;
  Vec3 wi{};            ///< where it comes from; of an environment, where that is
  Rgb radiance{};       ///< an estimate, over no density of wi; of an environment, which all know, what its path counts
  Rgb scattered{1.0f};  ///< what is scattered of it toward PathOffer::first, over the density of wi
  GroupedLight::Sums by_group{};  ///< radiance by light groups, where the scene has such
};

/// What the path met after its first vertex that spreads light, a surface or a collision, and the light that is scattered
/// there; or an environment, where it left the scene.
struct PathOffer {
  /// For bounce number context.bounce.
  PathOffer(const LightContext& context, const Vertex& vertex, Rgb throughput)
      : first(vertex),
        bounces(context.bounce + 1),
        directions(context, first),
        beta(throughput),
        lights(context.world.lights) {}
  PathOffer(const PathOffer&) = delete;  // directions refers to first

  Vertex first;           ///< the first that spreads light
  int bounces;            ///< with that at `first`: 1 where no mirror or pane is before it
  Directions directions;  ///< how the path went on from there
  Rgb beta;               ///< throughput before that bounce

  const Lights& lights;
  std::unique_ptr<const SoughtLights> sought;  ///< there; where an environment may be found

  std::optional<Vertex> at;     ///< what was met; nothing: others may still have found something for this path
  std::optional<Vec3> escaped;  ///< instead of it: the direction to an environment, a find at infinity
  int panes = 0;                ///< that are in between
  Ray ray;                      ///< on which it came there: what alpha lets pass depends on that
  Rgb arrived;                  ///< throughput with which the path itself came there
  Rgb flown;                    ///< the part of it that the flight through media weighs
  Rng rng{0};                   ///< for the connections of others

  std::vector<Find> finds;         ///< of `at` none before that is complete
  std::optional<Aureole> aureole;  ///< by which the path went on from `at`
  bool has_lights = false;         ///< `at` is not separable, and lights that were sought there are among the finds
  Rgb own;                         ///< light that `at` scatters toward `first` and that only the path itself counts

  /// Whether what `at` sends to all on its side is known, but for the factor of the direction. Else what comes to it from a
  /// direction is.
  bool is_separable() const { return at->on_surface() && at->surface()->bsdf.separable(); }
  int bounces_of_find() const { return bounces + panes + 1; }
  /// Of a find; nothing: at infinity.
  std::optional<Vec3> place() const { return at ? std::optional(at->p()) : std::nullopt; }
  bool found() const { return at || escaped; }
  /// Radiance of an environment that comes from `w`, were nothing in between.
  Rgb environment(LightId light, Vec3 w) const { return lights.environment(light, {first.p(), w}); }
  /// Whether there is any: else the path would not have offered that direction, wherever others see something.
  bool sees_environment(Vec3 w) const {
    const auto shows = [&](LightId light) { return !is_black(environment(light, w)); };
    return std::any_of(lights.infinite().begin(), lights.infinite().end(), shows);
  }
};

}  // namespace tyndall
