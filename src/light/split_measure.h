/// How much the lights of a cluster may differ in what they contribute: the measure of adaptive splitting.
#pragma once

#include "light/cluster.h"
#include "light/wide_segment.h"

namespace tyndall {

struct SplitMeasure {
  /// Distances of the sphere around the box, in the tree's unit; 0: it holds the point, or the segment crosses it.
  double nearest = 0, farthest = 0;
  /// Squared coefficient of variation of a light's contribution, distance and intensity taken as independent
  /// [Conty Estevez and Kulla 2018, sec. 5.4, made dimensionless]; infinite when the point is inside.
  double cv2 = 0;
  double score() const { return 1 / (1 + cv2); }  ///< in [0, 1]; low: split
};

/// By distances from the segment, as if all were scattered at its closest point; for `product` with the variation of
/// transmittance over these distances and with that of the phase function's peak, seen from where it can point best.
SplitMeasure split_measure(const Cluster& cluster, const WideSegment& segment);

/// Directions about an axis.
struct ConeLobe {
  Vec3 axis;        ///< unit
  float width = 0;  ///< radians off the axis where it has fallen considerably; 0: no lobe
};

/// How much a lobe at `p` varies over a cluster: nothing where it does not reach, and else as the angle that the cluster
/// is seen under, in widths of the lobe, squared.
double lobe_cv2(const ConeLobe& lobe, Vec3d p, const Cluster& cluster);

/// The peak of the phase function: where it has fallen to half. No lobe for isotropic scattering.
ConeLobe phase_lobe(float g, Vec3 d);

}  // namespace tyndall
