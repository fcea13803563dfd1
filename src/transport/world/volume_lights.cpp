#include "transport/world/volume_lights.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/hash.h"
#include "transport/media/span.h"

namespace tyndall {
namespace {

/// A third uniform number out of two.
float third(Vec2 u) {
  const std::uint64_t bits = std::uint64_t{std::bit_cast<std::uint32_t>(u.x)} << 32 | std::bit_cast<std::uint32_t>(u.y);
  return unit_float(hash(bits));
}

/// Where a ray that begins outside of all groups is in `medium`.
std::vector<Chord> chords_of(const ParticipatingMedium& medium, const SpanWalk::Context& world, const Geometry& geometry,
                             const Ray& ray) {
  std::vector<Chord> chords;
  const Crossings crossings = geometry.trace_all(ray, 0, kInfinity);
  SpanWalk walk(world, MediaState(), crossings, kInfinity);
  while (const auto i = walk.next()) {
    if (std::find(i->media.begin(), i->media.end(), &medium) != i->media.end()) chords.push_back({i->t0, i->t1});
  }
  return chords;
}

}  // namespace

VolumeLights::VolumeLights(const std::vector<ParticipatingMedium>& media, const Geometry& geometry,
                           std::optional<MediumId> unbounded) {
  LightId next = 0;
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (!media[i].emissive()) continue;
    const Bounds3 reach = reach_of(static_cast<MediumId>(i), geometry.groups(), unbounded);
    if (reach.empty()) continue;
    const auto chords = [&](const Ray& ray) { return chords_of(media[i], {geometry.groups(), media}, geometry, ray); };
    EmissiveCells cells(media[i], {reach, chords});
    if (cells.empty()) continue;
    const auto count = static_cast<LightId>(cells.size());
    emissive_.push_back({&media[i], i, next, std::move(cells), reach});
    next += count;
  }
  count_ = next;
}

std::vector<VolumeEmitter> VolumeLights::emitters() const {
  std::vector<VolumeEmitter> all;
  for (const EmissiveMedium& medium : emissive_) {
    for (std::uint32_t i = 0; i < medium.cells.size(); ++i) {
      const Bounds3 box = medium.cells.box(i);
      all.push_back({box, overlap(box, medium.reach).empty() ? 0.0f : medium.cells.power(i)});
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

std::optional<LightSample> VolumeLights::sample(LightId light, Vec3 p, Vec2 u) const {
  const EmissiveMedium& medium = medium_of(light);
  const std::uint32_t cell = light - first_ - medium.begin;
  const Vec3 y = medium.cells.sample(cell, {u.x, u.y, third(u)}), to = y - p;
  const float t2 = length_squared(to), t = std::sqrt(t2), area = medium.area(cell);
  const auto per_volume = static_cast<float>(medium.cells.pdf(cell, y));
  if (!(t > 0 && t < kInfinity && per_volume > 0)) return std::nullopt;
  const Coefficients c = medium.medium->at(y);
  const Rgb emission = c.sigma_a * c.Le;
  if (is_black(emission)) return std::nullopt;
  return LightSample{.wi = to * (1 / t),
                     .distance = t,
                     .L = emission * (1 / (area * per_volume)),
                     .pdf = t2 / area,
                     .delta = false,
                     .volume = light};
}

std::optional<VolumeLights::Held> VolumeLights::at(const ParticipatingMedium& medium, Vec3 y, Vec3 from) const {
  for (const EmissiveMedium& m : emissive_) {
    if (m.medium != &medium) continue;
    const auto cell = m.cells.at(y);
    if (cell) return Held{first_ + m.begin + *cell, length_squared(y - from) / m.area(*cell)};
  }
  return std::nullopt;
}

std::size_t VolumeLights::memory_bytes() const {
  std::size_t bytes = 0;
  for (const EmissiveMedium& medium : emissive_) bytes += medium.cells.memory_bytes();
  return bytes;
}

std::vector<std::string> VolumeLights::notes(const std::vector<Medium>& media) const {
  std::vector<std::string> notes;
  for (const EmissiveMedium& medium : emissive_) {
    notes.push_back("medium \"" + media[medium.id].name + "\" emits light: its " + std::to_string(medium.cells.size()) +
                    " cells that emit are lights, unless --emission is paths");
  }
  return notes;
}

}  // namespace tyndall
