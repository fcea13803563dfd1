#include "light/instanced_emitters.h"

#include <algorithm>

namespace tyndall {
namespace {

/// A point of the world as the object's emitters are asked about it.
RoundedPoint in_object(Vec3 p, const Similarity& to_world) {
  const Vec3d inner = to_world.inner_point(Vec3d(p));
  const double reach = std::max({std::abs(inner.x), std::abs(inner.y), std::abs(inner.z)});
  return {inner, std::max(RoundedPoint(p).reach / to_world.scale(), reach)};
}

/// What an instance multiplies the radiance of an emitter by.
float radiance_scale(const Emitter& emitter, const Similarity& to_world) {
  return emitter.of_given_power() ? static_cast<float>(1 / (to_world.scale() * to_world.scale())) : 1.0f;
}

}  // namespace

EmitterObject::EmitterObject(std::vector<Emitter> emitters) : emitters_(std::move(emitters)), first_{0} {
  for (const Emitter& e : emitters_) first_.push_back(first_.back() + e.size());
}

EmitterObject::Part EmitterObject::part(std::uint32_t light) const {
  const auto next = std::upper_bound(first_.begin() + 1, first_.end(), light);
  const auto emitter = static_cast<std::size_t>(next - first_.begin()) - 1;
  return {emitters_[emitter], light - first_[emitter]};
}

std::size_t EmitterObject::memory_bytes() const {
  std::size_t bytes = first_.capacity() * sizeof(first_[0]);
  for (const Emitter& e : emitters_) bytes += e.memory_bytes();
  return bytes;
}

std::uint32_t InstancedEmitters::add_object(std::vector<Emitter> emitters) {
  objects_.emplace_back(std::move(emitters));
  return static_cast<std::uint32_t>(objects_.size() - 1);
}

std::uint32_t InstancedEmitters::add_instance(std::uint32_t object, const Similarity& to_world, LightId first) {
  instances_.push_back({object, first, to_world});
  return static_cast<std::uint32_t>(instances_.size() - 1);
}

InstancedEmitters::Ref InstancedEmitters::find(LightId light) const {
  const auto next = std::upper_bound(instances_.begin(), instances_.end(), light,
                                     [](LightId l, const EmitterInstance& i) { return l < i.first; });
  return {static_cast<std::uint32_t>(next - instances_.begin()) - 1, light - (next - 1)->first};
}

std::optional<Emitter::Sample> InstancedEmitters::sample(const EmissionMaps& maps, Ref light, Vec3 p, Vec2 u) const {
  const Similarity& to_world = instances_[light.instance].to_world;
  const auto [emitter, primitive] = part(light);
  auto point = emitter.sample_surface(primitive, in_object(p, to_world), u);
  if (!point) return std::nullopt;
  point->wi = to_vec3(normalize(to_world.direction(Vec3d(point->wi))));
  point->ng = to_vec3(normalize(to_world.normal(Vec3d(point->ng))));
  point->distance = static_cast<float>(point->distance * to_world.scale());
  auto sample = emitter.light_from(maps, primitive, *point, p);
  if (sample) sample->L *= radiance_scale(emitter, to_world);
  return sample;
}

float InstancedEmitters::pdf(Ref light, Vec3 p, Vec3 hit) const {
  const Similarity& to_world = instances_[light.instance].to_world;
  const auto [emitter, primitive] = part(light);
  return emitter.pdf(primitive, in_object(p, to_world), in_object(hit, to_world));
}

Rgb InstancedEmitters::radiance(const EmissionMaps& maps, Ref light, Vec2 uv, Vec3 ng, Vec3 wo) const {
  const auto [emitter, primitive] = part(light);
  return emitter.radiance(maps, primitive, uv, ng, wo) * radiance_scale(emitter, instances_[light.instance].to_world);
}

double InstancedEmitters::power(Ref light) const {
  const auto [emitter, primitive] = part(light);
  return emitter.power(primitive) * power_scale(emitter, instances_[light.instance].to_world);
}

LightPlace InstancedEmitters::place(Ref light) const {
  const auto [emitter, primitive] = part(light);
  LightPlace place = emitter.place(primitive);
  const Similarity& placed = to_world(light);
  place.center = to_vec3(placed.point(Vec3d(*place.center)));
  place.radius = static_cast<float>(place.radius * placed.scale());
  if (place.flat()) place.normal = to_vec3(normalize(placed.normal(Vec3d(place.normal))));
  return place;
}

std::size_t InstancedEmitters::memory_bytes() const {
  std::size_t bytes = instances_.capacity() * sizeof(EmitterInstance);
  for (const EmitterObject& o : objects_) bytes += sizeof(EmitterObject) + o.memory_bytes();
  return bytes;
}

double power_scale(const Emitter& emitter, const Similarity& to_world) {
  return emitter.of_given_power() ? 1 : to_world.scale() * to_world.scale();
}

}  // namespace tyndall
