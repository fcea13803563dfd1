/// Emissive shapes of objects that stand in a scene many times: stored once, in the object's space. Every primitive of
/// every instance is a light of its own; instances that only turn, mirror, scale evenly and move what they show share
/// everything but their transform.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light/emitter.h"
#include "light/query.h"
#include "math/similarity.h"

namespace tyndall {

/// All emissive shapes of one object, its lights numbered in their order.
class EmitterObject {
 public:
  explicit EmitterObject(std::vector<Emitter> emitters);

  std::uint32_t size() const { return first_.back(); }  ///< lights
  struct Part {
    const Emitter& emitter;
    std::uint32_t primitive;
  };
  Part part(std::uint32_t light) const;
  std::uint32_t first(std::size_t emitter) const { return first_[emitter]; }  ///< light of the emitter
  std::span<const Emitter> emitters() const { return emitters_; }
  std::size_t memory_bytes() const;

 private:
  std::vector<Emitter> emitters_;
  std::vector<std::uint32_t> first_;  ///< light of each emitter, and their number
};

struct EmitterInstance {
  std::uint32_t object;
  LightId first;        ///< light of the instance
  Similarity to_world;  ///< from the object's space
};

class InstancedEmitters {
 public:
  /// A light: the instance, and its number there.
  struct Ref {
    std::uint32_t instance, light;
  };

  std::uint32_t add_object(std::vector<Emitter> emitters);
  /// Instances are added in the order of their lights, the first of which is `first`. Gives its index.
  std::uint32_t add_instance(std::uint32_t object, const Similarity& to_world, LightId first);

  std::span<const EmitterObject> objects() const { return objects_; }
  std::span<const EmitterInstance> instances() const { return instances_; }
  const EmitterObject& object_of(const EmitterInstance& i) const { return objects_[i.object]; }
  Ref find(LightId light) const;  ///< which must be a light of an instance

  // As of an Emitter, in the world.
  std::optional<Emitter::Sample> sample(const EmissionMaps& maps, Ref light, Vec3 p, Vec2 u) const;
  float pdf(Ref light, Vec3 p, Vec3 hit) const;
  Rgb radiance(const EmissionMaps& maps, Ref light, Vec2 uv, Vec3 ng, Vec3 wo) const;
  bool delta(Ref light) const { return part(light).emitter.delta(); }
  double power(Ref light) const;
  LightPlace place(Ref light) const;
  const Similarity& to_world(Ref light) const { return instances_[light.instance].to_world; }

  std::size_t memory_bytes() const;

 private:
  EmitterObject::Part part(Ref light) const { return object_of(instances_[light.instance]).part(light.light); }

  std::vector<EmitterObject> objects_;
  std::vector<EmitterInstance> instances_;
};

/// What an instance multiplies the power of an emitter by.
double power_scale(const Emitter& emitter, const Similarity& to_world);

}  // namespace tyndall
