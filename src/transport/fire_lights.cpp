#include "transport/fire_lights.h"

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

/// Mean and standard deviation of where the fire is.
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

FireLights::FireLights(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
                       std::optional<MediumId> unbounded) {
  LightId next = 0;
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (!media[i].emissive()) continue;
    const Bounds3 reach = reach_of(static_cast<MediumId>(i), groups, unbounded);
    if (reach.empty()) continue;
    EmissiveBricks bricks(media[i]);
    if (bricks.empty()) continue;
    const auto count = static_cast<LightId>(bricks.size());
    media_.push_back({i, next, std::move(bricks), reach});
    next += count;
  }
  count_ = next;
  place_ = place_of(emitters());
}

std::vector<VolumeEmitter> FireLights::emitters() const {
  std::vector<VolumeEmitter> all;
  for (const Glow& glow : media_) {
    for (std::uint32_t i = 0; i < glow.bricks.size(); ++i) {
      const Bounds3 box = glow.bricks.box(i);
      all.push_back({box, overlap(box, glow.reach).empty() ? 0.0f : glow.bricks.intensity(i)});
    }
  }
  return all;
}

const FireLights::Glow& FireLights::glow_of(LightId light) const {
  const Glow* found = &media_.front();
  for (const Glow& glow : media_) {
    if (glow.begin <= light - first_) found = &glow;
  }
  return *found;
}

Vec3 FireLights::sample(LightId light, Vec3 p, Vec2 u) const {
  const Glow& glow = glow_of(light);
  return normalize(glow.bricks.sample(light - first_ - glow.begin, {u.x, u.y, third(u)}) - p);
}

FiresOnRay FireLights::along(const Ray& ray) const {
  FiresOnRay fires;
  for (const Glow& glow : media_) {
    for (const BrickOnRay& b : glow.bricks.along(ray)) {
      fires.push_back({first_ + glow.begin + b.brick, static_cast<float>(b.column * glow.bricks.intensity(b.brick)),
                       static_cast<float>(b.direction)});
    }
  }
  return fires;
}

std::size_t FireLights::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Glow& glow : media_) bytes += glow.bricks.memory_bytes();
  return bytes;
}

std::vector<std::string> FireLights::notes(const std::vector<Medium>& media) const {
  std::vector<std::string> notes;
  for (const Glow& glow : media_) {
    notes.push_back("medium \"" + media[glow.medium].name + "\" glows: its " + std::to_string(glow.bricks.size()) +
                    " emissive bricks are lights with --emission lights");
  }
  return notes;
}

}  // namespace tyndall
