#include "surface/material_check.h"

#include <cmath>

#include "tyndall/error.h"

namespace tyndall {

namespace {

/// Hands on the textures that each kind of material names.
class TextureVisitor {
 public:
  explicit TextureVisitor(const std::function<void(TextureId)>& visit) : visit_(visit) {}

  void operator()(const DiffuseMaterial& m) const { texture(m.reflectance); }
  void operator()(const ConductorMaterial& m) const {
    optics(m.optics);
    roughness(m.roughness);
  }
  void operator()(const DielectricMaterial& m) const { roughness(m.roughness); }
  void operator()(const ThinDielectricMaterial&) const {}
  void operator()(const DiffuseTransmissionMaterial& m) const {
    texture(m.reflectance);
    texture(m.transmittance);
  }
  void operator()(const CoatedDiffuseMaterial& m) const {
    texture(m.reflectance);
    coating(m.coating);
  }
  void operator()(const CoatedConductorMaterial& m) const {
    optics(m.optics);
    roughness(m.conductor_roughness);
    coating(m.coating);
  }
  void operator()(const MixMaterial& m) const { texture(m.amount); }
  void operator()(const InterfaceMaterial&) const {}

 private:
  void roughness(const Roughness& r) const {
    texture(r.u);
    texture(r.v);
  }
  void optics(const ConductorOptics& o) const {
    if (o.reflectance) return texture(*o.reflectance);
    texture(o.eta);
    texture(o.k);
  }
  void coating(const Coating& c) const {
    roughness(c.roughness);
    texture(c.thickness);
    texture(c.g);
    texture(c.albedo);
  }

  void texture(TextureId id) const { visit_(id); }

  const std::function<void(TextureId)>& visit_;
};

[[noreturn]] void fail(const Material& material, const std::string& what) {
  std::string message = "material ";
  if (!material.name.empty()) message.append("\"").append(material.name).append("\" ");
  throw Error(material.where, message.append(what));
}

/// The indices of refraction that a material names.
std::vector<float> indices_of(const Material& material) {
  if (const auto* m = std::get_if<DielectricMaterial>(&material.kind)) {
    if (!m->eta_rgb) return {m->eta};
    return {m->eta, m->eta_rgb->r, m->eta_rgb->g, m->eta_rgb->b};
  }
  if (const auto* m = std::get_if<ThinDielectricMaterial>(&material.kind)) return {m->eta};
  if (const auto* m = std::get_if<CoatedDiffuseMaterial>(&material.kind)) return {m->coating.eta};
  if (const auto* m = std::get_if<CoatedConductorMaterial>(&material.kind)) return {m->coating.eta};
  return {};
}

void check_material(const Material& material, std::size_t texture_count) {
  for_each_texture(material, [&](TextureId id) {
    if (id >= texture_count)
      fail(material,
           "uses texture " + std::to_string(id) + " of " + std::to_string(texture_count) + "; add it to Scene::textures");
  });
  for (const float eta : indices_of(material))
    if (!(eta > 0) || std::isinf(eta))
      fail(material, "has eta " + std::to_string(eta) + "; give an index of refraction above 0");
}

enum class Visit { never, open, done };

/// Depth first along mixes; meeting an open one again closes a circle.
void visit_mixes(const std::vector<Material>& materials, MaterialId id, std::vector<Visit>& state) {
  const auto* mix = std::get_if<MixMaterial>(&materials[id].kind);
  if (!mix || state[id] == Visit::done) return;
  if (state[id] == Visit::open) fail(materials[id], "is a mix that contains itself; break the circle");
  state[id] = Visit::open;
  for (const MaterialId part : {mix->first, mix->second}) {
    if (part >= materials.size())
      fail(materials[id], "mixes material " + std::to_string(part) + " of " + std::to_string(materials.size()) +
                              "; add it to Scene::materials");
    visit_mixes(materials, part, state);
  }
  state[id] = Visit::done;
}

}  // namespace

void for_each_texture(const Material& material, const std::function<void(TextureId)>& visit) {
  std::visit(TextureVisitor(visit), material.kind);
  if (material.displacement) visit(*material.displacement);
  if (material.normal_map) visit(*material.normal_map);
}

void check_materials(const std::vector<Material>& materials, std::size_t texture_count) {
  for (const Material& m : materials) check_material(m, texture_count);
  std::vector<Visit> state(materials.size(), Visit::never);
  for (MaterialId id = 0; id < materials.size(); ++id) visit_mixes(materials, id, state);
}

}  // namespace tyndall
