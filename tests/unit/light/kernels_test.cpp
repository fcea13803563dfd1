/// Numeric kernels of src/light against their promises, at their worst.
#include "light/cone.h"
#include "light/equal_area.h"
#include "light/segment_importance.h"
#include "math/warp.h"
#include "support/adversarial.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

DirectionCone cone(Adversary& any) {
  const float theta = any.chance() ? any.between(0, kPi) : std::min(any.positive(40), kPi);
  return DirectionCone::around(any.direction(), theta);
}

/// A unit vector in the cone, often on its rim.
Vec3d in_cone(Adversary& any, const DirectionCone& cone) {
  const double theta = double(cone.theta) * (any.chance() ? 1.0 : double(any.unit())), phi = 2 * M_PI * double(any.unit());
  const Vec3d z = normalize(Vec3d(cone.axis)), h = std::abs(z.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d x = normalize(cross(h, z)), y = cross(z, x);
  return (x * std::cos(phi) + y * std::sin(phi)) * std::sin(theta) + z * std::cos(theta);
}

double angle(Vec3d a, Vec3d b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

ClusterBounds cluster(Adversary& any, float exponent) {
  LightBounds b;
  b.box.expand(any.vector(exponent));
  if (any.chance()) b.box.expand(any.vector(exponent));
  b.normals = cone(any);
  b.theta_e = any.between(0, kPi);
  b.intensity = any.positive(60);
  return ClusterBounds::from(b);
}

PointQuery point(Adversary& any, float exponent) {
  PointQuery q{};
  q.p = any.vector(exponent);
  if (any.chance()) {
    q.n = any.direction();
    q.transmissive = any.chance();
  } else if (any.chance()) {
    q.g = any.between(-0.98f, 0.98f);
    q.forward = any.direction();
  }
  return q;
}

SegmentQuery segment(Adversary& any, float exponent) {
  SegmentQuery q{.o = any.vector(exponent), .d = any.direction(), .t0 = any.chance() ? 0 : any.positive(exponent), .t1 = 0};
  q.t1 = any.chance() ? q.t0 + any.positive(exponent) : kInfinity;
  if (!(q.t1 > q.t0)) q.t1 = std::nextafter(q.t0, kInfinity);
  q.reach = any.positive(exponent);
  constexpr std::array<MediaStrategy, 3> kImportances{MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product};
  q.importance = kImportances[any.below(3)];
  const double length = std::min(q.t1 - q.t0, q.reach), sigma = any.positive(20) / length;
  q.profile.g = any.between(-0.99f, 0.99f);
  for (int i = 0; i <= SegmentProfile::kBins; ++i) {
    const auto k = static_cast<std::size_t>(i);
    q.profile.edge[k] = i == SegmentProfile::kBins ? q.t1 : static_cast<float>(q.t0 + length * i / SegmentProfile::kBins);
    if (i == SegmentProfile::kBins) break;
    q.profile.scattering[k] = any.chance() ? static_cast<float>(std::min(sigma * double(any.unit()), 1e30)) : 0;
    q.profile.sigma[k] = static_cast<float>(std::min(sigma, 1e30));
    q.profile.escape[k] = any.chance() ? kInfinity : any.positive(10);
  }
  return q;
}

}  // namespace

TEST_CASE("kernels: cones") {
  check_kernel("angle", [](Adversary& any) {
    const Vec3 a = any.direction(), b = any.chance() ? any.direction() : normalize(a + any.direction() * 1e-4f);
    const double theta = angle_between(a, b);
    return holds(std::abs(theta - angle(Vec3d(a), Vec3d(b))) < 1e-7, a, b, theta);
  });
  check_kernel("union", [](Adversary& any) {
    const DirectionCone a = cone(any), b = cone(any), both = cone_union(a, b);
    const Vec3d w = in_cone(any, any.chance() ? a : b);
    return holds(both.full() || angle(w, Vec3d(both.axis)) <= both.theta + 1e-6, a.axis, a.theta, b.axis, b.theta, both.axis,
                 both.theta);
  });
  check_kernel("square maps of the sphere", [](Adversary& any) {
    const Vec3 w = any.direction();
    const Vec2 p = equal_area_sphere_to_square(w);
    const Vec3 back = equal_area_square_to_sphere(p);
    return holds(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1 && length(back - w) < 2e-3f, w, p, back);
  });
}

TEST_CASE("kernels: what segments see") {
  check_kernel("angle of a segment", [](Adversary& any) {
    const double h = any.positive(60), from = any.real(60),
                 till = any.chance() ? from + double(any.positive(60)) : double(kInfinity);
    if (!(till > from)) return Fault();
    const double whole = subtended_angle(h, from, till), middle = middle_of_angle(h, from, till);
    if (!(whole >= 0 && whole <= M_PI && middle >= from && middle <= till)) return holds(false, h, from, till, whole, middle);
    // What is a few roundings of its place long has no middle.
    if (till - from < 1e-9 * std::abs(from)) return Fault();
    return holds(std::abs(subtended_angle(h, from, middle) - 0.5 * whole) <= 1e-6 * whole, h, from, till, whole, middle);
  });
  check_kernel("largest cosine", [](Adversary& any) {
    const Vec3d d = normalize(Vec3d(any.direction())), axis = normalize(Vec3d(any.direction()));
    Vec3d aside = Vec3d(any.direction()) * double(any.positive(30));
    for (int i = 0; i < 2; ++i) aside = aside - d * dot(aside, d);  // one that was along d has digits to get rid of
    const double from = any.real(30), till = from + double(any.positive(30)), c = largest_cosine(axis, aside, d, from, till);
    const Vec3d some = aside + d * (from + (till - from) * double(any.unit()));
    return holds(c <= 1 + 1e-12 && (length(some) == 0 || c >= dot(axis, normalize(some)) - 1e-9), from, till, c);
  });
  check_kernel("phase function", [](Adversary& any) {
    const double g = any.between(-0.99f, 0.99f), cosine = any.between(-1, 1), p = phase_ratio(g, cosine);
    return holds(std::isfinite(p) && p > 0, g, cosine, p);
  });
}

TEST_CASE("kernels: importance is a finite number, never negative") {
  check_kernel("of a point", [](Adversary& any) {
    const ClusterBounds c = cluster(any, 40);
    const PointQuery q = point(any, 40);
    const double i = importance(c, any.chance(), q), least = least_importance(c, any.chance(), q);
    return holds(std::isfinite(i) && i >= 0 && std::isfinite(least) && least >= 0, q.p, c.box.min, c.box.max, i, least);
  });
  check_kernel("of a segment", [](Adversary& any) {
    const ClusterBounds c = cluster(any, 30);
    const SegmentQuery q = segment(any, 30);
    const double i = importance(c, any.chance(), Segment(q));
    return holds(std::isfinite(i) && i >= 0, q.o, q.d, q.t0, q.t1, c.box.min, c.box.max, i);
  });
}
