#include "math/similarity.h"

namespace tyndall {
namespace {

Vec3d column(const Transform::Matrix& m, std::size_t j) { return {m[0][j], m[1][j], m[2][j]}; }

}  // namespace

std::optional<double> similarity_scale(const Transform::Matrix& m) {
  const Vec3d x = column(m, 0), y = column(m, 1), z = column(m, 2);
  const double s = length(x), tolerance = 1e-6;
  if (std::abs(length(y) - s) > tolerance * s || std::abs(length(z) - s) > tolerance * s) return std::nullopt;
  if (std::max({std::abs(dot(x, y)), std::abs(dot(y, z)), std::abs(dot(z, x))}) > tolerance * s * s) return std::nullopt;
  return s;
}

Similarity::Map Similarity::map_of(const Transform::Matrix& m) {
  return {column(m, 0), column(m, 1), column(m, 2), column(m, 3)};
}

std::optional<Similarity> Similarity::of(const Transform& map) {
  const auto scale = similarity_scale(map.matrix());
  if (!scale) return std::nullopt;
  Similarity s;
  s.out_ = map_of(map.matrix());
  s.in_ = map_of(map.inverse().matrix());
  s.scale_ = *scale;
  return s;
}

Similarity Similarity::from_origin(Vec3d origin) const {
  Similarity s = *this;
  s.out_.move = point(origin);
  s.in_.move = in_.move - origin;
  return s;
}

}  // namespace tyndall
