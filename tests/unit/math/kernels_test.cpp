/// Numeric kernels of src/math against their promises, at their worst.
#include <span>

#include "math/blackbody.h"
#include "math/distribution.h"
#include "math/frame.h"
#include "math/half_float.h"
#include "math/spherical.h"
#include "math/warp.h"
#include "support/adversarial.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

bool is_unit(Vec3 w) { return std::abs(length(w) - 1) < 1e-5f; }
bool is_finite(Vec3d v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_unit(Vec3d w) { return std::abs(length(w) - 1) < 1e-9; }

Vec3d place(Adversary& any, float exponent) {
  const float size = any.positive(exponent);
  return Vec3d(any.vector(4)) * double(size);
}

}  // namespace

TEST_CASE("kernels: warps stay on their domains") {
  check_kernel("concentric disk", [](Adversary& any) {
    const Vec2 u = any.square(), p = square_to_concentric_disk(u);
    return holds(std::hypot(p.x, p.y) <= 1 + 1e-6f, u, p);
  });
  check_kernel("uniform hemisphere", [](Adversary& any) {
    const Vec2 u = any.square();
    const Vec3 w = square_to_uniform_hemisphere(u);
    return holds(is_unit(w) && w.z >= 0, u, w);
  });
  check_kernel("cosine hemisphere", [](Adversary& any) {
    const Vec2 u = any.square();
    const Vec3 w = square_to_cosine_hemisphere(u);
    return holds(is_unit(w) && w.z >= 0 && cosine_hemisphere_pdf(w) >= 0, u, w);
  });
  check_kernel("sphere", [](Adversary& any) {
    const Vec2 u = any.square();
    const Vec3 w = square_to_uniform_sphere(u);
    return holds(is_unit(w), u, w);
  });
  check_kernel("cone", [](Adversary& any) {
    const Vec2 u = any.square();
    const float h = std::min(any.positive(60), 2.0f);
    const Vec3 w = square_to_uniform_cone(u, h);
    return holds(is_unit(w) && 1 - w.z <= h + 2e-7f && uniform_cone_pdf({0, 0, 1}, h) > 0, u, h, w);
  });
}

TEST_CASE("kernels: frames are orthonormal") {
  const auto off = [](const Frame& f) {
    return std::max({std::abs(dot(f.x, f.y)), std::abs(dot(f.y, f.z)), std::abs(dot(f.z, f.x)), std::abs(length(f.x) - 1),
                     std::abs(length(f.y) - 1), length(cross(f.x, f.y) - f.z)});
  };
  check_kernel("around a normal", [&](Adversary& any) {
    const Vec3 n = any.direction();
    return holds(off(Frame::around(n)) < 1e-5f, n);
  });
  check_kernel("around a normal, toward a tangent", [&](Adversary& any) {
    const Vec3 n = any.direction(), t = any.direction() * any.positive(20);
    const Vec3 slanted = any.chance() ? n + t * 1e-6f : t;
    return holds(off(Frame::around(n, slanted)) < 1e-5f, n, slanted);
  });
}

TEST_CASE("kernels: solid angles") {
  check_kernel("triangle", [](Adversary& any) {
    const Vec3d a = place(any, 30), b = any.chance() ? place(any, 30) : a * (1 + 1e-7), c = place(any, 30);
    const SphericalTriangle triangle(a, b, c);
    const double omega = triangle.solid_angle();
    if (!(omega >= 0 && omega <= 2 * M_PI * (1 + 1e-12))) return holds(false, omega);
    if (omega == 0 || omega > 2 * M_PI * (1 - 1e-9)) return Fault();
    const Vec2 u = any.square();
    return holds(is_unit(triangle.sample(u)), omega, u, to_vec3(a), to_vec3(b), to_vec3(c));
  });
  check_kernel("rectangle", [](Adversary& any) {
    const Vec3d corner = place(any, 30);
    const Frame frame = Frame::around(any.direction());
    const double width = any.positive(30), height = any.positive(30);
    const SphericalRectangle rectangle(corner, Vec3d(frame.x) * width, Vec3d(frame.y) * height);
    const double omega = rectangle.solid_angle();
    if (!(omega >= 0 && omega <= 2 * M_PI * (1 + 1e-12))) return holds(false, omega);
    if (omega == 0) return Fault();
    const Vec2 u = any.square();
    const auto s = rectangle.sample(u);
    return holds(is_finite(s.p) && s.uv.x >= 0 && s.uv.x <= 1 && s.uv.y >= 0 && s.uv.y <= 1, omega, u, s.uv);
  });
  check_kernel("sphere", [](Adversary& any) {
    const double distance = any.positive(100), radius = any.chance() ? any.positive(100) : distance * (1 - any.unit());
    const auto h = sphere_cone_height(distance, radius);
    if (distance <= radius) return holds(!h, distance, radius);
    const double ratio = radius / distance;
    return holds(
        h && *h >= 0 && *h <= 1 + 1e-12 && std::abs(*h - ratio * ratio / (1 + std::sqrt(1 - ratio * ratio))) <= 1e-6 * *h,
        distance, radius, h.value_or(-1));
  });
}

TEST_CASE("kernels: numbers") {
  check_kernel("upper half of a float", [](Adversary& any) {
    const float x = any.positive(126);
    const double above = from_upper_half(upper_half_above(x)), near = from_upper_half(upper_half_near(x));
    return holds(above >= x && above <= x * (1 + 0x1p-7) && std::abs(near - x) <= x * 0x1p-8, x, above, near);
  });
  check_kernel("black body", [](Adversary& any) {
    const double lambda = any.positive(20), kelvin = any.real(40), b = normalized_blackbody(lambda, kelvin);
    return holds(b >= 0 && b <= 1 + 1e-9 && (kelvin > 0 || b == 0), lambda, kelvin, b);
  });
}

TEST_CASE("kernels: discrete and piecewise constant choices") {
  check_kernel("alias table", [](Adversary& any) {
    std::array<double, 7> weights{};
    const std::uint32_t n = 1 + any.below(7);
    for (std::uint32_t i = 0; i < n; ++i) weights[i] = any.chance() ? any.positive(60) : 0;
    const AliasTable table(std::span<const double>(weights.data(), n));
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) sum += table.pmf(i);
    const auto s = table.sample(any.unit());
    const bool drawn = s.index < n && s.pmf > 0 && s.pmf == table.pmf(s.index) && (table.total() == 0 || weights[s.index] > 0);
    return holds(drawn && std::abs(sum - 1) < 1e-9, n, s.index, s.pmf, sum);
  });
  check_kernel("piecewise constant", [](Adversary& any) {
    std::array<float, 7> weights{};
    const std::uint32_t n = 1 + any.below(7);
    for (std::uint32_t i = 0; i < n; ++i) weights[i] = any.chance() ? any.positive(60) : 0;
    const PiecewiseConstant1D density(std::span<const float>(weights.data(), n));
    const auto s = density.sample(any.unit());
    const bool drawn = s.x >= 0 && s.x < 1 && s.cell < n && s.pdf > 0 && (density.total() == 0 || weights[s.cell] > 0);
    return holds(drawn && density.pdf(s.x) == s.pdf, n, s.x, s.pdf, s.cell);
  });
}
