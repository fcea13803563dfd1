#include "surface/material.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "math/hash.h"
#include "surface/material_check.h"

namespace tyndall {

namespace {

/// Of light, whatever the texture gives.
Rgb share(Rgb c) { return clamp(c, 0, 1); }
Rgb at_least_zero(Rgb c) { return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)}; }

/// Evaluates one material's textures at one point. Values out of range are clamped as pbrt-v4 clamps them.
class LobeBuilder {
 public:
  LobeBuilder(const Textures& textures, const SurfaceQuery& query)
      : textures_(textures),
        query_(query),
        at_{.uv = query.uv, .p = query.p, .n = query.ng, .footprint = query.detail ? &query.detail->footprint : nullptr} {}

  Bsdf::Lobe operator()(const DiffuseMaterial& m) const { return DiffuseLobe{share(rgb(m.reflectance))}; }

  Bsdf::Lobe operator()(const ConductorMaterial& m) const { return conductor(m.optics, m.roughness, 1); }

  Bsdf::Lobe operator()(const DielectricMaterial& m) const {
    return dielectric(m.eta_rgb && query_.channel ? (*m.eta_rgb)[*query_.channel] : m.eta, m.roughness);
  }

  Bsdf::Lobe operator()(const ThinDielectricMaterial& m) const { return ThinDielectricLobe{index(m.eta)}; }

  Bsdf::Lobe operator()(const DiffuseTransmissionMaterial& m) const {
    return DiffuseTransmissionLobe{share(rgb(m.reflectance) * m.scale), share(rgb(m.transmittance) * m.scale)};
  }

  Bsdf::Lobe operator()(const CoatedDiffuseMaterial& m) const {
    const DielectricLobe coat_top = top(m.coating);
    const Rgb reflectance = share(rgb(m.reflectance));
    const Coat between = coat(m.coating);
    if (shares_) return ClearCoatLobe(coat_top, reflectance, between, *shares_);
    if (coat_top.is_specular() && is_black(between.albedo))
      return ClearCoatLobe(coat_top, reflectance, between, coat_shares(coat_top, between.thickness));
    return CoatedDiffuseLobe{.top = coat_top, .bottom = {reflectance}, .coat = between};
  }

  Bsdf::Lobe operator()(const CoatedConductorMaterial& m) const {
    return CoatedConductorLobe{.top = top(m.coating),
                               .bottom = conductor(m.optics, m.conductor_roughness, index(m.coating.eta)),
                               .coat = coat(m.coating)};
  }

  Bsdf::Lobe operator()(const MixMaterial&) const { return PassThroughLobe{}; }  // resolved before
  Bsdf::Lobe operator()(const InterfaceMaterial&) const { return PassThroughLobe{}; }

  float scalar(TextureId id) const { return textures_.eval_float(id, at_); }

  /// Of a clear coat that is the same everywhere, known beforehand; null: of none.
  void set_shares(const CoatShares* shares) { shares_ = shares; }
  DielectricLobe top(const Coating& c) const { return dielectric(c.eta, c.roughness); }

  Coat coat(const Coating& c) const {
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
    const Vec3 p = query_.p;
    return {.thickness = std::max(scalar(c.thickness), std::numeric_limits<float>::min()),
            .albedo = share(rgb(c.albedo)),
            .g = std::clamp(scalar(c.g), -0.99f, 0.99f),
            .max_depth = c.max_depth,
            .samples = std::max(1, c.samples),
            .seed = hash(bits(p.x), bits(p.y), bits(p.z), bits(query_.random))};
  }

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

  const Textures& textures_;
  const SurfaceQuery& query_;
  TextureQuery at_;
  const CoatShares* shares_ = nullptr;
};

}  // namespace

Materials::Materials(const Scene& scene, const Textures& textures) : materials_(scene.materials), textures_(&textures) {
  check_materials(materials_, textures.size());
  for (const Material& m : materials_) traits_.push_back(own_traits(m));
  find_shares();
  // Mixes have those of their parts; most are defined after them, and one round does.
  for (bool changed = true; changed;) {
    changed = false;
    for (MaterialId id = 0; id < materials_.size(); ++id) {
      const auto* mix = std::get_if<MixMaterial>(&materials_[id].kind);
      if (!mix) continue;
      Traits t = traits_[id];
      t.add(traits_[mix->first]);
      t.add(traits_[mix->second]);
      t.is_pane |= is_interface(mix->first) || is_interface(mix->second);
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
  t.is_pane = std::holds_alternative<ThinDielectricMaterial>(m.kind);
  return t;
}

/// Of coats that do not differ from place to place, once for all of the same top and thickness.
void Materials::find_shares() {
  std::map<std::array<float, 3>, std::shared_ptr<const CoatShares>> found;
  const SurfaceQuery anywhere;
  const LobeBuilder build(*textures_, anywhere);
  for (const Material& m : materials_) {
    shares_.emplace_back();
    const auto* coated = std::get_if<CoatedDiffuseMaterial>(&m.kind);
    if (!coated) continue;
    const Coating& c = coated->coating;
    const TextureId textures[] = {c.roughness.u, c.roughness.v, c.thickness, c.albedo};
    if (!std::ranges::all_of(textures, [this](TextureId id) { return textures_->is_constant(id); })) continue;
    const DielectricLobe top = build.top(c);
    const Coat coat = build.coat(c);
    const bool known = top.is_specular() || (top.ggx.alpha_x() == top.ggx.alpha_y() && top.eta >= 1);
    if (!is_black(coat.albedo) || !known) continue;
    auto& shares = found[{top.eta, top.is_specular() ? 0.0f : top.ggx.alpha_x(), coat.thickness}];
    if (!shares) shares = std::make_shared<const CoatShares>(coat_shares(top, coat.thickness));
    shares_.back() = shares;
  }
}

Bsdf Materials::bsdf(MaterialId id, const SurfaceQuery& query) const {
  LobeBuilder build(*textures_, query);
  // A mix keeps one material; what the choice leaves of the random number serves the mix inside it.
  float random = query.random;
  while (const auto* mix = std::get_if<MixMaterial>(&materials_[id].kind)) {
    const float amount = std::clamp(build.scalar(mix->amount), 0.0f, 1.0f);
    const bool second = random < amount;
    random = std::min(second ? random / amount : (random - amount) / (1 - amount), kOneMinusEpsilon);
    id = second ? mix->second : mix->first;
  }
  const Material& material = materials_[id];
  build.set_shares(shares_[id].get());
  const bool is_bent = material.normal_map || material.displacement;
  return {is_bent ? build.frame(material) : query.shading, std::visit(build, material.kind)};
}

bool Materials::is_interface(MaterialId id) const { return std::holds_alternative<InterfaceMaterial>(materials_[id].kind); }

}  // namespace tyndall
