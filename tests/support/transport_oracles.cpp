#include "support/transport_oracles.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tyndall::test {
namespace {

constexpr double kPiExact = 3.14159265358979323846;

double density_at(const Grid& g, double x, double y, double z) {
  const auto sample = [&](int i, int j, int k) -> double {
    if (i < 0 || j < 0 || k < 0 || i >= g.nx || j >= g.ny || k >= g.nz) return 0;
    return g.density[static_cast<std::size_t>((k * g.ny + j) * g.nx + i)];
  };
  if (!g.bounds.contains({float(x), float(y), float(z)})) return 0;
  // Samples sit at the centres of cells.
  const Vec3 extent = g.bounds.extent();
  const double u = (x - g.bounds.min.x) / extent.x * g.nx - 0.5, v = (y - g.bounds.min.y) / extent.y * g.ny - 0.5,
               w = (z - g.bounds.min.z) / extent.z * g.nz - 0.5;
  const int i = int(std::floor(u)), j = int(std::floor(v)), k = int(std::floor(w));
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    const int di = c & 1, dj = (c >> 1) & 1, dk = c >> 2;
    const double weight = (di ? u - i : 1 - (u - i)) * (dj ? v - j : 1 - (v - j)) * (dk ? w - k : 1 - (w - k));
    sum += weight * sample(i + di, j + dj, k + dk);
  }
  return sum;
}

}  // namespace

double single_scattering(double sigma_t, double h, double d) {
  // t = d + h tan(theta): dt / r^2 = dtheta / h, r = h / cos(theta).
  const auto f = [&](double theta) { return std::exp(-sigma_t * (d + h * std::tan(theta) + h / std::cos(theta))); };
  return integrate(f, -std::atan2(d, h), kPiExact / 2, 400) / (4 * kPiExact * h);
}

double chandrasekhar_h(double w, double mu) {
  // ln H = -(mu/pi) int_0^{pi/2} ln(1 - w t cot t) / (cos^2 t + mu^2 sin^2 t) dt, with tan(phi) = mu tan(t).
  const auto f = [&](double phi) {
    const double t = std::atan2(std::sin(phi), mu * std::cos(phi));
    return std::log1p(-w * t / std::tan(t));
  };
  return std::exp(-integrate(f, 0, kPiExact / 2, 400) / kPiExact);
}

double optical_depth(const Grid& grid, const Ray& ray, double t0, double t1) {
  // A cubic polynomial between planes through voxels, and jumps where the bounds are.
  std::vector<double> ends{t0, t1};
  const int counts[3] = {grid.nx, grid.ny, grid.nz};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = grid.bounds.min[axis], size = double{grid.bounds.max[axis]} - low;
    const auto cut = [&](double x) {
      const double t = (x - ray.o[axis]) / ray.d[axis];
      if (t > t0 && t < t1) ends.push_back(t);
    };
    cut(low), cut(low + size);
    for (int i = 0; i < counts[axis]; ++i) cut(low + (i + 0.5) / counts[axis] * size);
  }
  std::sort(ends.begin(), ends.end());
  const auto f = [&](double t) {
    return density_at(grid, ray.o.x + t * ray.d.x, ray.o.y + t * ray.d.y, ray.o.z + t * ray.d.z);
  };
  double sum = 0;
  for (std::size_t i = 1; i < ends.size(); ++i) sum += integrate(f, ends[i - 1], ends[i], 1);
  return sum;
}

}  // namespace tyndall::test
