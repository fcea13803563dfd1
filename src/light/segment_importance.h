/// How much of the light that media scatter along a segment may come from a cluster: the counterpart of importance.h for a
/// segment of a ray.
///
/// All arithmetic is in double precision. Zero is returned only where no point of the segment can get light of the
/// cluster (with a margin for points and normals in floats), never by rounding; and no value is infinite, even where a
/// light lies on the ray and the integral of 1 / r^2 diverges.
#pragma once

#include "light/importance.h"
#include "light/segment_query.h"
#include "math/small_vector.h"

namespace tyndall {

/// A SegmentQuery made ready to be put to many clusters.
struct Segment {
  Segment(const SegmentQuery& query);  ///< implicit: they say the same

  struct Bin {
    double begin, end;     ///< along the ray; `end` may be infinite
    double scattering;     ///< relative to the bin with the most, > 0
    double sigma, escape;  ///< as in SegmentProfile
    /// Transmittance over `distance` toward a light.
    double transmittance(double distance) const { return sigma > 0 ? std::exp(-std::min(sigma * distance, escape)) : 1; }
  };

  Vec3d o, d;     ///< d is unit
  double reach;   ///< the largest coordinate of o when it was rounded to single precision
  double t0, t1;  ///< t1 may be infinite
  double length;  ///< t1 - t0, or what stands for it
  double g;       ///< mean cosine of the phase function, kept off -1 and 1
  MediaStrategy importance;
  SmallVector<Bin, SegmentProfile::kBins> bins;  ///< those that scatter; none: the profile is not read or says nothing

  /// The part of `length` that scatters light from infinity toward the origin: times the mean of scattering x
  /// transmittance.
  double lit_length() const;
};

/// What is scattered toward the origin counts at least this much, relative to isotropic scattering of the bin that
/// scatters most: means over bins and clusters may miss what matters.
inline constexpr double kLeastScattering = 1e-3;

/// The angle at distance `h` from a line under which the part between `from` and `till` of it is seen, places being
/// measured from the foot of the perpendicular; h > 0, `till` may be infinite. By one arc tangent: the difference of
/// two would cancel where the part is short or far.
double subtended_angle(double h, double from, double till);

/// The place between `from` and `till` that halves that angle.
double middle_of_angle(double h, double from, double till);

/// Henyey-Greenstein relative to isotropic scattering.
double phase_ratio(double g, double cosine);

/// Least angle between `axis` and the directions from a centre to the points of the segment, as its cosine. The line
/// passes the centre at `aside`, from where the segment reaches from `from` to `till` along d (unit). Exact
/// [differs from the case distinction in Conty Estevez and Kulla 2018 in form only].
double largest_cosine(Vec3d axis, Vec3d aside, Vec3d d, double from, double till);

/// Importance of a cluster for a segment, in the unit of intensity / length [2018, sec. 4]:
///   closest   cos / r^2 at the point of the segment closest to the centre, times the length
///   integral  cos x the integral of 1 / r^2 along the segment, (theta_b - theta_a) / D
///   product   that, times the mean over the angle of scattering x transmittance to the cluster x phase function
/// with the largest cosine of emission that any point can get (closest: the one there), and distances kept above half
/// the cluster's radius.
double importance(const ClusterBounds& cluster, bool two_sided, const Segment& segment);

/// That, were the whole intensity at the point of the sphere around the box closest to the segment; infinite for segments that
/// meet the sphere. Of distances a bound; not of what phase function and transmittance vary by over the cluster.
double greatest_importance(const ClusterBounds& cluster, bool two_sided, const Segment& segment);

/// The rule that asks for it takes none in media.
inline double least_importance(const ClusterBounds&, bool, const Segment&) { return 0; }

}  // namespace tyndall
