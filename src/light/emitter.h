/// The emissive primitives of one placed shape, and what they emit.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "light/bounds.h"
#include "light/light_place.h"
#include "light/patch_emitter.h"
#include "light/quadric_emitter.h"
#include "light/triangle_emitter.h"
#include "texture/textures.h"

namespace tyndall {

/// What emission is looked up in; shared by all emitters.
struct EmissionMaps {
  std::vector<std::shared_ptr<const TexelImage>> images;
  const Textures* textures = nullptr;
};

/// Diffuse emission over a surface. The radiance of a primitive is `L` times the image's colour, and where `power` is
/// set times what makes the primitive emit that power, as pbrt does for each primitive.
struct Emission {
  Rgb L;
  Rgb mean;  ///< of L times the image, over the image
  std::optional<float> power;
  float power_per_radiosity = 1;  ///< the image's mean luminance, which `power` is divided by
  bool two_sided = false;
  std::optional<std::uint32_t> image;
  std::optional<TextureId> alpha;
  bool invisible = false;  ///< alpha is 0 everywhere: no ray meets the surface, yet it gives its light [pbrt-v4]
};

class Emitter {
 public:
  using Surface = std::variant<TriangleEmitter, PatchEmitter, QuadricEmitter>;
  Emitter(Surface surface, const Emission& emission) : surface_(std::move(surface)), emission_(emission) {}

  std::uint32_t size() const;           ///< primitives
  double power(std::uint32_t i) const;  ///< W, mean of the channels
  LightBounds bounds(std::uint32_t i) const;
  Bounds3 box(std::uint32_t i) const;
  LightPlace place(std::uint32_t i) const;
  bool delta() const { return emission_.invisible; }
  /// The power is given, not the radiance: it does not grow with the area.
  bool of_given_power() const { return emission_.power.has_value(); }

  struct Sample {
    EmitterSample point;
    Rgb L;
  };
  std::optional<Sample> sample(const EmissionMaps& maps, std::uint32_t i, Vec3 p, Vec2 u) const;
  /// The two halves of sample(): a point of the surface, and what it sends to `p`.
  std::optional<EmitterSample> sample_surface(std::uint32_t i, const RoundedPoint& p, Vec2 u) const;
  std::optional<Sample> light_from(const EmissionMaps& maps, std::uint32_t i, const EmitterSample& point, Vec3 p) const;
  float pdf(std::uint32_t i, const RoundedPoint& p, const RoundedPoint& hit) const;
  Rgb radiance(const EmissionMaps& maps, std::uint32_t i, Vec2 uv, Vec3 ng, Vec3 wo) const;

  std::size_t memory_bytes() const;

 private:
  double area(std::uint32_t i) const;
  double projected_area(std::uint32_t i) const;
  float scale(std::uint32_t i) const;  ///< what `power` multiplies the radiance by

  Surface surface_;
  Emission emission_;
};

}  // namespace tyndall
