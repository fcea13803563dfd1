#include "volume/medium.h"

#include <algorithm>
#include <utility>

#include "volume/medium_data.h"

namespace tyndall {

Rgb PlacedGrid::rgb_at(Vec3 p) const {
  float v[kMaxChannels];
  grid.lookup(to_local.point(p), v);
  return {v[0], v[1], v[2]};
}

Rgb EmissionField::at(Vec3 p) const {
  if (kind == Kind::none) return {};
  const float f = scale ? factor * scale->at(p) : factor;
  if (!(f > 0)) return {};
  switch (kind) {
    case Kind::constant:
      return Le * f;
    case Kind::blackbody:
      return (*table)((values->at(p) - temperature_offset) * temperature_scale) * f;
    case Kind::rgb_grid:
      return values->rgb_at(p) * f;
    case Kind::none:
      break;
  }
  return {};
}

namespace {

float clearest_of(const MediumData& m) {
  if (m.kind == MediumData::Kind::grid && m.density.grid.channels() != 1) return 0;
  const Rgb sigma_t = m.optics.sigma_a + m.optics.sigma_s;
  return is_black(sigma_t) ? 1.0f : std::min(1.0f, std::min({sigma_t.r, sigma_t.g, sigma_t.b}) / mean(sigma_t));
}

}  // namespace

ParticipatingMedium::ParticipatingMedium(std::shared_ptr<const MediumData> data)
    : data_(std::move(data)), clearest_channel_(clearest_of(*data_)) {}
ParticipatingMedium::ParticipatingMedium(ParticipatingMedium&&) noexcept = default;
ParticipatingMedium& ParticipatingMedium::operator=(ParticipatingMedium&&) noexcept = default;
ParticipatingMedium::~ParticipatingMedium() = default;

Coefficients ParticipatingMedium::at(Vec3 p) const {
  const auto [sigma_a, sigma_s] = optics_at(p);
  return {.sigma_a = sigma_a, .sigma_s = sigma_s, .Le = is_black(sigma_a) ? Rgb() : data_->emission.at(p)};
}

PointOptics ParticipatingMedium::optics_at(Vec3 p) const {
  const MediumData& m = *data_;
  if (m.kind == MediumData::Kind::homogeneous) return {m.optics.sigma_a, m.optics.sigma_s};
  PointOptics result;
  const GridVec local = m.density.to_local.point(p);
  if (!m.clip.contains(local)) return result;
  if (m.kind == MediumData::Kind::cloud) {
    const float d =
        cloud_density(m.cloud, {static_cast<float>(local[0]), static_cast<float>(local[1]), static_cast<float>(local[2])});
    result.sigma_a = m.optics.sigma_a * d;
    result.sigma_s = m.optics.sigma_s * d;
  } else {
    float values[kMaxChannels];
    m.density.grid.lookup(local, values);
    m.scale_by(values, result.sigma_a, result.sigma_s);
  }
  return result;
}

bool ParticipatingMedium::emissive() const { return data_->emission.kind != EmissionField::Kind::none; }

bool ParticipatingMedium::scatters() const {
  const MediumData& m = *data_;
  if (is_black(m.optics.sigma_s)) return false;
  if (m.kind != MediumData::Kind::grid) return true;
  const BrickGrid& grid = m.density.grid;
  for (int c = grid.channels() == 6 ? 3 : 0; c < grid.channels(); ++c)
    if (grid.range(c).max > 0) return true;
  return false;
}

bool ParticipatingMedium::homogeneous() const { return data_->kind == MediumData::Kind::homogeneous; }
float ParticipatingMedium::albedo() const {
  const float s = mean(data_->optics.sigma_s), all = s + mean(data_->optics.sigma_a);
  return all > 0 ? s / all : 0.0f;
}
const Phase& ParticipatingMedium::phase() const { return data_->optics.phase; }
Bounds3 ParticipatingMedium::bounds() const { return data_->bounds; }

float ParticipatingMedium::sigma_maj() const {
  const MediumData& m = *data_;
  if (m.kind != MediumData::Kind::grid) return max_component(m.optics.sigma_a + m.optics.sigma_s);
  float values[kMaxChannels];
  for (int c = 0; c < m.density.grid.channels(); ++c) values[c] = m.density.grid.range(c).max;
  Rgb sigma_a, sigma_s;
  m.scale_by(values, sigma_a, sigma_s);
  return max_component(sigma_a + sigma_s);
}

std::size_t ParticipatingMedium::memory_bytes() const {
  std::size_t bytes = sizeof(MediumData) + data_->density.grid.memory_bytes();
  if (data_->emission.scale) bytes += data_->emission.scale->grid.memory_bytes();
  if (data_->emission.values) bytes += data_->emission.values->grid.memory_bytes();
  return bytes;
}

}  // namespace tyndall
