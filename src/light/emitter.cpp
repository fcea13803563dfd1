#include "light/emitter.h"

namespace tyndall {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;  // clang 14 does not deduce aggregates

}  // namespace

std::uint32_t Emitter::size() const {
  return std::visit(Overloaded{[](const QuadricEmitter&) { return 1u; }, [](const auto& mesh) { return mesh.size(); }},
                    surface_);
}

double Emitter::area(std::uint32_t i) const {
  return std::visit(
      Overloaded{[](const QuadricEmitter& q) { return q.area(); }, [&](const auto& mesh) { return mesh.area(i); }}, surface_);
}

double Emitter::projected_area(std::uint32_t i) const {
  const auto* quadric = std::get_if<QuadricEmitter>(&surface_);
  return quadric ? quadric->projected_area() : area(i);
}

float Emitter::scale(std::uint32_t i) const {
  if (!emission_.power) return 1;
  const double radiosity = kPi * area(i) * (emission_.two_sided ? 2 : 1) * emission_.power_per_radiosity;
  return radiosity > 0 ? static_cast<float>(*emission_.power / radiosity) : 0.0f;
}

double Emitter::power(std::uint32_t i) const {
  return kPi * area(i) * (emission_.two_sided ? 2 : 1) * strength(emission_.mean) * scale(i);
}

Bounds3 Emitter::box(std::uint32_t i) const {
  return std::visit(Overloaded{[](const QuadricEmitter& q) { return q.extent().box; },
                               [&](const TriangleEmitter& mesh) { return mesh.box(i); },
                               [&](const PatchEmitter& mesh) { return mesh.extent(i).box; }},
                    surface_);
}

LightPlace Emitter::place(std::uint32_t i) const {
  LightPlace place = std::visit(
      Overloaded{[](const QuadricEmitter& q) { return q.place(); }, [&](const auto& mesh) { return mesh.place(i); }}, surface_);
  place.two_sided = emission_.two_sided;
  return place;
}

LightBounds Emitter::bounds(std::uint32_t i) const {
  const EmitterExtent extent = std::visit(
      Overloaded{[](const QuadricEmitter& q) { return q.extent(); }, [&](const auto& mesh) { return mesh.extent(i); }},
      surface_);
  const double intensity = projected_area(i) * strength(emission_.mean) * scale(i);
  return {extent.box, extent.normals, kPi / 2, static_cast<float>(std::clamp(intensity, 1e-37, 1e38)), emission_.two_sided};
}

Rgb Emitter::radiance(const EmissionMaps& maps, std::uint32_t i, Vec2 uv, Vec3 ng, Vec3 wo) const {
  if (!emission_.two_sided && !(dot(ng, wo) > 0)) return {};
  Rgb L = emission_.power ? emission_.L * scale(i) : emission_.L;
  if (emission_.image) L *= maps.images[*emission_.image]->bilinear({uv.x, 1 - uv.y}, TexelImage::Wrap::clamp);
  return L;
}

std::optional<EmitterSample> Emitter::sample_surface(std::uint32_t i, const RoundedPoint& p, Vec2 u) const {
  return std::visit(Overloaded{[&](const QuadricEmitter& q) { return q.sample(p, u); },
                               [&](const auto& mesh) { return mesh.sample(i, p, u); }},
                    surface_);
}

std::optional<Emitter::Sample> Emitter::light_from(const EmissionMaps& maps, std::uint32_t i, const EmitterSample& point,
                                                   Vec3 p) const {
  Rgb L = radiance(maps, i, point.uv, point.ng, -point.wi);
  if (is_black(L)) return std::nullopt;
  // Rays meet the surface with probability alpha; light sampling takes the mean.
  if (emission_.alpha)
    L *= std::clamp(maps.textures->eval_float(*emission_.alpha, {point.uv, p + point.wi * point.distance, point.ng}), 0.0f,
                    1.0f);
  if (is_black(L)) return std::nullopt;
  return Sample{point, L};
}

std::optional<Emitter::Sample> Emitter::sample(const EmissionMaps& maps, std::uint32_t i, Vec3 p, Vec2 u) const {
  const auto point = sample_surface(i, p, u);
  return point ? light_from(maps, i, *point, p) : std::nullopt;
}

float Emitter::pdf(std::uint32_t i, const RoundedPoint& p, const RoundedPoint& hit) const {
  return std::visit(
      Overloaded{[&](const QuadricEmitter& q) { return q.pdf(p, hit); }, [&](const auto& mesh) { return mesh.pdf(i, p, hit); }},
      surface_);
}

std::size_t Emitter::memory_bytes() const {
  return sizeof(Emitter) + std::visit(Overloaded{[](const QuadricEmitter&) { return std::size_t(0); },
                                                 [](const auto& mesh) { return mesh.memory_bytes(); }},
                                      surface_);
}

}  // namespace tyndall
