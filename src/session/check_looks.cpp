#include "session/scene_check.h"
#include "session/value_check.h"

namespace tyndall {
namespace {

struct TextureCheck {
  const ValueCheck& check;

  void operator()(const ConstantTexture& t) const { color("a value", t.value); }
  void operator()(const ScaleTexture&) const {}
  void operator()(const MixTexture&) const {}
  void operator()(const ImageTexture& t) const {
    mapping(t.mapping);
    check.finite("scale", t.scale);
    check.number("max_anisotropy", t.max_anisotropy, t.max_anisotropy >= 1 && t.max_anisotropy <= 100, "1 to 100");
    check.all_finite("to_rec709", t.to_rec709);
  }
  void operator()(const CheckerboardTexture& t) const {
    check.require(t.dimension == 2 || t.dimension == 3, "is a checkerboard of neither 2 nor 3 dimensions; give it either");
    mapping(t.mapping);
  }
  void operator()(const DotsTexture& t) const { mapping(t.mapping); }
  void operator()(const BilerpTexture& t) const {
    mapping(t.mapping);
    for (const Rgb& corner : {t.v00, t.v01, t.v10, t.v11}) color("a corner", corner);
  }
  void operator()(const DirectionMixTexture& t) const { check.direction("direction", t.direction); }
  void operator()(const NoiseTexture& t) const {
    constexpr int kMostOctaves = 64;  // the last is 10^19 times finer than the first
    check.require(t.octaves >= 0 && t.octaves <= kMostOctaves,
                  "has " + std::to_string(t.octaves) + " octaves; give 0 to " + std::to_string(kMostOctaves));
    check.finite("roughness", t.roughness);
    check.finite("scale", t.scale);
    check.finite("variation", t.variation);
  }

 private:
  void color(const char* name, Rgb c) const { check.all_finite(name, std::array{c.r, c.g, c.b}); }
  void mapping(const TextureMapping& m) const {
    check.all_finite("a mapping", std::array{m.scale.x, m.scale.y, m.offset.x, m.offset.y});
    check.vector("v1", m.v1);
    check.vector("v2", m.v2);
  }
};

void check_coating(const ValueCheck& check, const Coating& coating) {
  check.require(coating.max_depth >= 1 && coating.samples >= 1,
                "has a coating with max_depth " + std::to_string(coating.max_depth) + " and " +
                    std::to_string(coating.samples) + " samples; give at least 1 of both");
}

void check_material(const Material& material) {
  const ValueCheck check(material.where, material.name.empty() ? "material" : "material \"" + material.name + "\"");
  check.finite("displacement_scale", material.displacement_scale);
  if (const auto* m = std::get_if<DiffuseTransmissionMaterial>(&material.kind)) check.not_negative("scale", m->scale);
  if (const auto* m = std::get_if<CoatedDiffuseMaterial>(&material.kind)) check_coating(check, m->coating);
  if (const auto* m = std::get_if<CoatedConductorMaterial>(&material.kind)) check_coating(check, m->coating);
}

}  // namespace

void check_looks(const Scene& scene) {
  for (const Texture& texture : scene.textures) {
    const ValueCheck check(texture.where, "texture");
    std::visit(TextureCheck{check}, texture.kind);
  }
  for (const Material& material : scene.materials) check_material(material);
}

}  // namespace tyndall
