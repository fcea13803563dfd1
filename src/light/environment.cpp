#include "light/environment.h"

#include <numbers>

#include "light/bounds.h"
#include "light/equal_area.h"
#include "math/vec3d.h"
#include "math/warp.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr double kFullSphere = 4 * std::numbers::pi;

}  // namespace

Environment::Environment(const InfiniteLight& light, const Location& where, KeptFiles* kept)
    : to_world_(light.to_world), L_(light.L) {
  const Transform::Matrix m = light.to_world.inverse().matrix();
  std::array<Vec3d, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) rows_[i] = to_vec3(rows[i] = Vec3d(m[i][0], m[i][1], m[i][2]));
  determinant_ = static_cast<float>(std::abs(dot(rows[0], cross(rows[1], rows[2]))));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) rotation_ = rotation_ && std::abs(dot(rows[i], rows[j]) - (i == j ? 1 : 0)) < 1e-6;

  if (!light.path.empty()) {
    load(light, where, kept);
    return;
  }
  image_ = std::make_shared<const TexelImage>();
  // An upward surface under constant radiance L receives pi L.
  if (light.illuminance) L_ *= *light.illuminance / kPi;
  mean_ = L_;
}

void Environment::load(const InfiniteLight& light, const Location& where, KeptFiles* kept) {
  try {
    image_ = TexelImage::load(kept, light.path, light.to_rec709);
  } catch (const Error& error) {
    throw Error(where, error.what());
  }
  if (image_->width() == image_->height() && image_->width() > 0) {
    layout_ = Layout::equal_area;
  } else if (image_->width() == 2 * image_->height() && image_->height() > 0) {
    layout_ = Layout::latitude_longitude;
  } else {
    throw Error(where, "environment map \"" + light.path + "\" is " + std::to_string(image_->width()) + " x " +
                           std::to_string(image_->height()) +
                           "; it must be square (equal-area) or twice as wide as high (latitude-longitude)");
  }

  std::array<double, 3> sum{};
  double upward = 0;
  for_each_texel(1, [&](Texel t, Vec3 w, double omega) {
    const Rgb c = texel(t);
    for (int i = 0; i < 3; ++i) sum[static_cast<std::size_t>(i)] += c[i] * omega;
    upward += luminance(c) * std::max(w.z, 0.0f) * omega;
  });
  if (light.illuminance) {
    // pbrt-v4 measures a map's illuminance as half of what it is, and we scale like it: its picture is the reference.
    if (!(upward > 0))
      throw Error(where, "environment map \"" + light.path +
                             "\" has no light above to scale to an illuminance; remove \"illuminance\"");
    L_ *= static_cast<float>(*light.illuminance / (upward / 2));
  }
  mean_ = L_ * Rgb(static_cast<float>(sum[0] / kFullSphere), static_cast<float>(sum[1] / kFullSphere),
                   static_cast<float>(sum[2] / kFullSphere));
  build_distribution();
}

float Environment::weight(std::uint32_t x, std::uint32_t y) const { return luminance(absolute(texel({x, y}))); }

float Environment::excess(std::uint32_t x, std::uint32_t y) const { return std::max(weight(x, y) - mean_weight_, 0.0f); }

void Environment::build_distribution() {
  const auto width = static_cast<std::uint32_t>(image_->width()), height = static_cast<std::uint32_t>(image_->height());
  double sum = 0;
  for (std::uint32_t y = 0; y < height; ++y) {
    const double omega = texel_solid_angle(y);
    for (std::uint32_t x = 0; x < width; ++x) sum += weight(x, y) * omega;
  }
  mean_weight_ = static_cast<float>(sum / kFullSphere);
  std::vector<float> weights;
  weights.reserve(std::size_t(width) * height);
  for (std::uint32_t y = 0; y < height; ++y) {
    const double omega = texel_solid_angle(y);
    for (std::uint32_t x = 0; x < width; ++x) weights.push_back(static_cast<float>(excess(x, y) * omega * width * height));
  }
  excess_ = PiecewiseConstant2D(image_->width(), image_->height(), weights);
  has_excess_ = excess_.total() > 1e-6 * sum * width * height;
}

double Environment::cos_row(std::uint32_t y) const { return std::cos(std::numbers::pi * y / image_->height()); }

double Environment::texel_solid_angle(std::uint32_t y) const {
  const double width = image_->width();
  if (layout_ == Layout::equal_area) return kFullSphere / (width * image_->height());
  // cos a - cos b as a product, which keeps its digits near the poles.
  const double step = std::numbers::pi / image_->height();
  return kFullSphere / width * std::sin((y + 0.5) * step) * std::sin(0.5 * step);
}

Vec3 Environment::direction(Vec2 st) const {
  if (layout_ == Layout::equal_area) return equal_area_square_to_sphere(st);
  return toward(meridian(st.x), parallel(st.y));
}

Environment::Meridian Environment::meridian(float s) {
  const double phi = 2 * std::numbers::pi * s;
  return {std::cos(phi), std::sin(phi)};
}

Environment::Parallel Environment::parallel(float t) const {
  const std::uint32_t y = texel_of({0, t}).y;
  const double within = std::clamp(static_cast<double>(t) * image_->height() - y, 0.0, 1.0);
  const double z = cos_row(y) + within * (cos_row(y + 1) - cos_row(y));
  return {std::sqrt(std::max(0.0, (1 - z) * (1 + z))), z};
}

Vec2 Environment::square(Vec3 w) const {
  if (layout_ == Layout::equal_area) return equal_area_sphere_to_square(w);
  const float phi = std::atan2(w.y, w.x) * (0.5f / kPi);
  return {phi < 0 ? phi + 1 : phi, std::atan2(std::hypot(w.x, w.y), w.z) * kInvPi};
}

Environment::Texel Environment::texel_of(Vec2 st) const {
  const auto cell = [](float s, int n) {
    return static_cast<std::uint32_t>(std::clamp(static_cast<int>(s * static_cast<float>(n)), 0, n - 1));
  };
  return {cell(st.x, image_->width()), cell(st.y, image_->height())};
}

Vec3 Environment::to_light(Vec3 w) const { return {dot(rows_[0], w), dot(rows_[1], w), dot(rows_[2], w)}; }

Vec3 Environment::to_world(Vec3 w) const { return normalize(to_world_.vector(w)); }

float Environment::stretch(Vec3 w) const {
  if (rotation_) return 1;
  const float l = length(to_light(w));
  return determinant_ / (l * l * l);
}

Rgb Environment::radiance(Vec3 w) const {
  if (layout_ == Layout::constant) return L_;
  const Texel t = texel_of(square(normalize(to_light(w))));
  return L_ * image_->texel(static_cast<int>(t.x), static_cast<int>(t.y));
}

Rgb Environment::interpolated(Vec3 w) const {
  if (layout_ != Layout::equal_area) return radiance(w);
  const Vec2 st = equal_area_sphere_to_square(normalize(to_light(w)));
  const int n = image_->width();
  const float x = st.x * static_cast<float>(n) - 0.5f, y = st.y * static_cast<float>(n) - 0.5f;
  const int left = static_cast<int>(std::floor(x)), above = static_cast<int>(std::floor(y));
  const float s = x - static_cast<float>(left), t = y - static_cast<float>(above);
  const auto texel = [&](int i, int j) {
    const auto [column, row] = equal_area_neighbor(i, j, n);
    return image_->texel(column, row);
  };
  return L_ * ((texel(left, above) * (1 - s) + texel(left + 1, above) * s) * (1 - t) +
               (texel(left, above + 1) * (1 - s) + texel(left + 1, above + 1) * s) * t);
}

std::optional<Environment::Sample> Environment::sample(Vec2 u) const {
  if (!has_excess_) return std::nullopt;
  // Density and radiance are those of the direction as rounded, which every other caller will see.
  const Vec3 wi = to_world(direction(excess_.sample(u).p));
  const Sample sample{wi, pdf(wi), radiance(wi)};
  if (!(sample.pdf > 0)) return std::nullopt;
  return sample;
}

float Environment::pdf(Vec3 w) const {
  if (!has_excess_) return 0;
  const Texel t = texel_of(square(normalize(to_light(w))));
  const Vec2 center{(t.x + 0.5f) / image_->width(), (t.y + 0.5f) / image_->height()};
  const double per_texel = static_cast<double>(excess_.pdf(center)) / (static_cast<double>(image_->width()) * image_->height());
  return static_cast<float>(per_texel / texel_solid_angle(t.y) * stretch(w));
}

std::vector<FarCone> Environment::cones() const {
  const double octant_angle = std::acos(1 / std::sqrt(3.0));
  std::vector<FarCone> cones(8);
  std::array<Vec3d, 8> mean;
  std::array<double, 8> fluence{}, sampled{};
  double reach = 0;  // how far a texel may stick out of the octant that its centre is in
  if (layout_ == Layout::constant) {
    for (auto& f : fluence) f = strength(L_) * kFullSphere / 8;
    for (std::size_t i = 0; i < 8; ++i)
      mean[i] = Vec3d(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5) * fluence[i];
  } else {
    // Small maps are cut finer, so that each piece falls into one octant, roughly.
    const int pieces = std::max(1, 64 / image_->height());
    reach = 2 * std::sqrt(kFullSphere) / (image_->height() * pieces);
    for_each_texel(pieces, [&](Texel t, Vec3 toward, double part) {
      const Vec3 w = to_world(toward);
      const double value = strength(L_ * texel(t)) * (part / stretch(w));
      const double above = has_excess_ ? excess(t.x, t.y) : 0;
      const std::size_t octant = (w.x > 0 ? 1u : 0u) | (w.y > 0 ? 2u : 0u) | (w.z > 0 ? 4u : 0u);
      fluence[octant] += value;
      if (above > 0) sampled[octant] += value * above / weight(t.x, t.y);
      mean[octant] = mean[octant] + Vec3d(w) * value;
    });
  }
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3d axis = normalize(Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    const auto theta = static_cast<float>(std::min(octant_angle + reach + 1e-5, std::numbers::pi));
    cones[i] = {DirectionCone::around(to_vec3(axis), theta), fluence[i] > 0 ? to_vec3(mean[i] / fluence[i]) : Vec3{},
                static_cast<float>(fluence[i]), static_cast<float>(sampled[i])};
  }
  return cones;
}

std::size_t Environment::memory_bytes() const {
  return static_cast<std::size_t>(image_->width()) * static_cast<std::size_t>(image_->height()) * sizeof(Rgb) +
         excess_.memory_bytes();
}

}  // namespace tyndall
