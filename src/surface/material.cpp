#include "surface/material.h"

#include <bit>

#include "math/hash.h"
#include "surface/material_check.h"

namespace tyndall {

namespace {

Rgb clamp01(Rgb c) { return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)}; }
Rgb at_least_zero(Rgb c) { return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)}; }

/// Evaluates one material's textures at one point. Values out of range are clamped as pbrt-v4 clamps them.
class LobeBuilder {
 public:
  LobeBuilder(const Textures& textures, const SurfaceQuery& query)
      : textures_(textures),
        query_(query),
        at_{.uv = query.uv, .p = query.p, .n = query.ng, .footprint = query.detail ? &query.detail->footprint : nullptr} {}

  Bsdf::Lobe operator()(const DiffuseMaterial& m) const { return DiffuseLobe{clamp01(rgb(m.reflectance))}; }

  Bsdf::Lobe operator()(const ConductorMaterial& m) const { return conductor(m.optics, m.roughness, 1); }

  Bsdf::Lobe operator()(const DielectricMaterial& m) const {
    return dielectric(m.eta_rgb && query_.channel ? (*m.eta_rgb)[*query_.channel] : m.eta, m.roughness);
  }

  Bsdf::Lobe operator()(const ThinDielectricMaterial& m) const { return ThinDielectricLobe{index(m.eta)}; }

  Bsdf::Lobe operator()(const DiffuseTransmissionMaterial& m) const {
    return DiffuseTransmissionLobe{clamp01(rgb(m.reflectance) * m.scale), clamp01(rgb(m.transmittance) * m.scale)};
  }

  Bsdf::Lobe operator()(const CoatedDiffuseMaterial& m) const {
    const DielectricLobe top = dielectric(m.coating.eta, m.coating.roughness);
    const Rgb reflectance = clamp01(rgb(m.reflectance));
    const Coat between = coat(m.coating);
    if (top.is_specular() && is_black(between.albedo)) return ClearCoatLobe(top.eta, reflectance, between);
    return CoatedDiffuseLobe{.top = top, .bottom = {reflectance}, .coat = between};
  }

  Bsdf::Lobe operator()(const CoatedConductorMaterial& m) const {
    return CoatedConductorLobe{.top = dielectric(m.coating.eta, m.coating.roughness),
                               .bottom = conductor(m.optics, m.conductor_roughness, index(m.coating.eta)),
                               .coat = coat(m.coating)};
  }

  Bsdf::Lobe operator()(const MixMaterial&) const { return PassThroughLobe{}; }  // resolved before
  Bsdf::Lobe operator()(const InterfaceMaterial&) const { return PassThroughLobe{}; }

  float scalar(TextureId id) const { return textures_.eval_float(id, at_); }

  /// The shading frame as the material bends it. A normal map wins over a displacement, as in pbrt.
  Frame frame(const Material& m) const {
    if (m.normal_map) return normal_mapped(query_.shading, query_.ng, rgb(*m.normal_map));
    if (!m.displacement || !query_.detail) return query_.shading;
    return bumped(query_.shading, at_, query_.detail->tangents,
                  [&](const TextureQuery& at) { return m.displacement_scale * textures_.eval_float(*m.displacement, at); });
  }

 private:
  Rgb rgb(TextureId id) const { return textures_.eval(id, at_); }

  static float index(float eta) { return eta > 0 ? eta : 1.0f; }

  Ggx ggx(const Roughness& r) const {
    const float u = scalar(r.u), v = scalar(r.v);
    return r.remap ? Ggx(roughness_to_alpha(u), roughness_to_alpha(v)) : Ggx(u, v);
  }

  DielectricLobe dielectric(float eta, const Roughness& roughness) const { return {index(eta), ggx(roughness)}; }

  /// `outside` is the index of what lies over the metal.
  ConductorLobe conductor(const ConductorOptics& optics, const Roughness& roughness, float outside) const {
    const Rgb eta = optics.reflectance ? Rgb(1.0f) : at_least_zero(rgb(optics.eta));
    const Rgb k = optics.reflectance ? conductor_k(rgb(*optics.reflectance)) : at_least_zero(rgb(optics.k));
    return {ggx(roughness), eta / outside, k / outside};
  }

  Coat coat(const Coating& c) const {
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
    const Vec3 p = query_.p;
    return {.thickness = std::max(scalar(c.thickness), std::numeric_limits<float>::min()),
            .albedo = clamp01(rgb(c.albedo)),
            .g = std::clamp(scalar(c.g), -0.99f, 0.99f),
            .max_depth = c.max_depth,
            .samples = std::max(1, c.samples),
            .seed = hash(bits(p.x), bits(p.y), bits(p.z), bits(query_.random))};
  }

  const Textures& textures_;
  const SurfaceQuery& query_;
  TextureQuery at_;
};

}  // namespace

Materials::Materials(const Scene& scene, const Textures& textures) : materials_(scene.materials), textures_(&textures) {
  check_materials(materials_, textures.size());
  for (const Material& m : materials_) traits_.push_back(own_traits(m));
  // Mixes have those of their parts; most are defined after them, and one round does.
  for (bool changed = true; changed;) {
    changed = false;
    for (MaterialId id = 0; id < materials_.size(); ++id) {
      const auto* mix = std::get_if<MixMaterial>(&materials_[id].kind);
      if (!mix) continue;
      Traits t = traits_[id];
      t.add(traits_[mix->first]);
      t.add(traits_[mix->second]);
      changed |= t != traits_[id];
      traits_[id] = t;
    }
  }
}

Materials::Traits Materials::own_traits(const Material& m) const {
  Traits t;
  t.wants_detail = m.displacement.has_value();
  t.bends_normals = m.displacement || m.normal_map;
  for_each_texture(m, [&](TextureId texture) { t.wants_detail |= textures_->uses_footprint(texture); });
  if (const auto* glass = std::get_if<DielectricMaterial>(&m.kind)) t.is_dispersive = glass->eta_rgb.has_value();
  return t;
}

Bsdf Materials::bsdf(MaterialId id, const SurfaceQuery& query) const {
  const LobeBuilder build(*textures_, query);
  // A mix keeps one material; what the choice leaves of the random number serves the mix inside it.
  float random = query.random;
  while (const auto* mix = std::get_if<MixMaterial>(&materials_[id].kind)) {
    const float amount = std::clamp(build.scalar(mix->amount), 0.0f, 1.0f);
    const bool second = random < amount;
    random = std::min(second ? random / amount : (random - amount) / (1 - amount), kOneMinusEpsilon);
    id = second ? mix->second : mix->first;
  }
  const Material& material = materials_[id];
  const bool is_bent = material.normal_map || material.displacement;
  return {is_bent ? build.frame(material) : query.shading, std::visit(build, material.kind)};
}

bool Materials::is_interface(MaterialId id) const { return std::holds_alternative<InterfaceMaterial>(materials_[id].kind); }

}  // namespace tyndall
