#include "surface/material_check.h"

#include "tyndall/error.h"

namespace tyndall {

namespace {

class Checker {
 public:
  Checker(const Material& material, std::size_t texture_count) : material_(material), textures_(texture_count) {}

  void operator()(const DiffuseMaterial& m) const { texture(m.reflectance); }
  void operator()(const ConductorMaterial& m) const {
    optics(m.optics);
    roughness(m.roughness);
  }
  void operator()(const DielectricMaterial& m) const {
    index(m.eta);
    roughness(m.roughness);
  }
  void operator()(const ThinDielectricMaterial& m) const { index(m.eta); }
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

  [[noreturn]] void fail(const std::string& what) const {
    std::string message = "material ";
    if (!material_.name.empty()) message.append("\"").append(material_.name).append("\" ");
    throw Error(material_.where, message.append(what));
  }

 private:
  void texture(TextureId id) const {
    if (id >= textures_)
      fail("uses texture " + std::to_string(id) + " of " + std::to_string(textures_) + "; add it to Scene::textures");
  }
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
    index(c.eta);
    texture(c.thickness);
    texture(c.g);
    texture(c.albedo);
  }
  void index(float eta) const {
    if (!(eta > 0) || std::isinf(eta)) fail("has eta " + std::to_string(eta) + "; give an index of refraction above 0");
  }

  const Material& material_;
  std::size_t textures_;
};

enum class Visit { never, open, done };

/// Depth first along mixes; meeting an open one again closes a circle.
void visit_mixes(const std::vector<Material>& materials, MaterialId id, std::vector<Visit>& state) {
  const auto* mix = std::get_if<MixMaterial>(&materials[id].kind);
  if (!mix || state[id] == Visit::done) return;
  const Checker checker(materials[id], 0);
  if (state[id] == Visit::open) checker.fail("is a mix that contains itself; break the circle");
  state[id] = Visit::open;
  for (const MaterialId part : {mix->first, mix->second}) {
    if (part >= materials.size())
      checker.fail("mixes material " + std::to_string(part) + " of " + std::to_string(materials.size()) +
                   "; add it to Scene::materials");
    visit_mixes(materials, part, state);
  }
  state[id] = Visit::done;
}

}  // namespace

void check_materials(const std::vector<Material>& materials, std::size_t texture_count) {
  for (const Material& m : materials) std::visit(Checker(m, texture_count), m.kind);
  std::vector<Visit> state(materials.size(), Visit::never);
  for (MaterialId id = 0; id < materials.size(); ++id) visit_mixes(materials, id, state);
}

}  // namespace tyndall
