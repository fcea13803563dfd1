/// How much light a point can get from a cluster: the heuristic behind every choice, and a strict test for zero.
///
/// All arithmetic is in double precision: no distance of floats under- or overflows when squared, and scaling the scene
/// changes nothing. Zero is returned only where no light of the cluster can contribute (with a margin for the rounding
/// of float normals), never by rounding.
#pragma once

#include "light/bounds.h"
#include "light/query.h"
#include "math/vec3d.h"

namespace tyndall {

/// LightBounds as stored in the tree: cosines in place of angles, rounded to the conservative side.
struct ClusterBounds {
  Bounds3 box;
  Vec3 axis;        ///< of the normals' cone
  float cos_o = 1;  ///< its half angle's cosine
  float cos_e = 0;  ///< cosine of the emission's reach beyond the normals
  float intensity = 0;

  static ClusterBounds from(const LightBounds& bounds);
};

/// Importance of a cluster for a point, in the unit of intensity / length^2.
/// [Conty Estevez and Kulla 2018, eq. 3], with the distance kept above half the cluster's radius.
double importance(const ClusterBounds& cluster, bool two_sided, const PointQuery& query);

/// What the cluster's intensity gives the point at most, wherever in the box its lights are: as importance(), at the distance
/// of the box. Infinite for points within it.
double greatest_importance(const ClusterBounds& cluster, bool two_sided, const PointQuery& query);

/// What the cluster's intensity gives the point at least, wherever in the box and however within the cones it is: 0 for
/// points that are inside, outside some light's emission or under some part of the horizon; and in media.
double least_importance(const ClusterBounds& cluster, bool two_sided, const PointQuery& query);

}  // namespace tyndall
