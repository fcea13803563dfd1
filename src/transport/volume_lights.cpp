#include "transport/volume_lights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "math/hash.h"
#include "transport/media/media_state.h"

namespace tyndall {
namespace {

/// A third uniform number out of two.
float third(Vec2 u) {
  const std::uint64_t bits = std::uint64_t{std::bit_cast<std::uint32_t>(u.x)} << 32 | std::bit_cast<std::uint32_t>(u.y);
  return static_cast<float>(hash(bits) >> 40) * 0x1p-24f;
}

/// Mean and standard deviation of the positions of volume emission.
LightPlace place_of(const std::vector<VolumeEmitter>& emitters) {
  double total = 0;
  std::array<double, 3> sum{}, squares{};
  for (const VolumeEmitter& e : emitters) {
    const Vec3 p = e.box.center();
    total += double{e.intensity};
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = p[static_cast<int>(i)];
      sum[i] += e.intensity * x;
      squares[i] += e.intensity * x * x;
    }
  }
  if (!(total > 0)) return {};
  Vec3 center;
  double variance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double mean = sum[i] / total;
    center[static_cast<int>(i)] = static_cast<float>(mean);
    variance += squares[i] / total - mean * mean;
  }
  return {center, static_cast<float>(std::sqrt(std::max(variance, 0.0)))};
}

}  // namespace

VolumeLights::VolumeLights(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
                           std::optional<MediumId> unbounded) {
  LightId next = 0;
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (!media[i].emissive()) continue;
    const Bounds3 reach = reach_of(static_cast<MediumId>(i), groups, unbounded);
    if (reach.empty()) continue;
    EmissiveBricks bricks(media[i]);
    if (bricks.empty()) continue;
    const auto count = static_cast<LightId>(bricks.size());
    emissive_.push_back({i, next, std::move(bricks), reach});
    next += count;
  }
  count_ = next;
  place_ = place_of(emitters());
}

std::vector<VolumeEmitter> VolumeLights::emitters() const {
  std::vector<VolumeEmitter> all;
  for (const EmissiveMedium& medium : emissive_) {
    for (std::uint32_t i = 0; i < medium.bricks.size(); ++i) {
      const Bounds3 box = medium.bricks.box(i);
      all.push_back({box, overlap(box, medium.reach).empty() ? 0.0f : medium.bricks.intensity(i)});
    }
  }
  return all;
}

const VolumeLights::EmissiveMedium& VolumeLights::medium_of(LightId light) const {
  const EmissiveMedium* found = &emissive_.front();
  for (const EmissiveMedium& medium : emissive_) {
    if (medium.begin <= light - first_) found = &medium;
  }
  return *found;
}

Vec3 VolumeLights::sample(LightId light, Vec3 p, Vec2 u) const {
  const EmissiveMedium& medium = medium_of(light);
  return normalize(medium.bricks.sample(light - first_ - medium.begin, {u.x, u.y, third(u)}) - p);
}

VolumesOnRay VolumeLights::along(const Ray& ray) const {
  VolumesOnRay volumes;
  for (const EmissiveMedium& medium : emissive_) {
    for (const BrickOnRay& b : medium.bricks.along(ray)) {
      volumes.push_back({first_ + medium.begin + b.brick, static_cast<float>(b.column * medium.bricks.intensity(b.brick)),
                         static_cast<float>(b.direction)});
    }
  }
  return volumes;
}

std::size_t VolumeLights::memory_bytes() const {
  std::size_t bytes = 0;
  for (const EmissiveMedium& medium : emissive_) bytes += medium.bricks.memory_bytes();
  return bytes;
}

std::vector<std::string> VolumeLights::notes(const std::vector<Medium>& media) const {
  std::vector<std::string> notes;
  for (const EmissiveMedium& medium : emissive_) {
    notes.push_back("medium \"" + media[medium.medium].name + "\" emits light: its " + std::to_string(medium.bricks.size()) +
                    " emissive bricks are lights with --emission lights");
  }
  return notes;
}

}  // namespace tyndall
