/// What a path offers to the paths of neighbouring pixels.
#pragma once

#include <optional>

#include "transport/directions.h"

namespace tyndall {

/// The light of a diffuse surface that the path met after its first bounce.
struct PathOffer {
  PathOffer(const LightContext& context, const Vertex& vertex, Rgb throughput)
      : first(vertex), directions(context, first), beta(throughput) {}
  PathOffer(const PathOffer&) = delete;  // directions refers to first

  Vertex first;           ///< of the first bounce
  Directions directions;  ///< how the path went on from there
  Rgb beta;               ///< throughput before that bounce

  std::optional<Vertex> at;  ///< the surface, seen from `first` through at most homogeneous media
  Rgb arrived;               ///< throughput with which the path itself came there
  Rgb radiance;              ///< what it scatters toward `first`, and to all on that side: an estimate
};

}  // namespace tyndall
