#include "light/lights.h"

#include "light/lights_parts.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

using Kind = Lights::Parts::Kind;

std::optional<LightSample> delta_sample(const std::optional<DeltaArrival>& a) {
  if (!a || is_black(a->L)) return std::nullopt;
  return LightSample{a->wi, a->distance, a->L, 1, true};
}

std::optional<LightSample> far_sample(const std::optional<Environment::Sample>& s) {
  if (!s || is_black(s->L)) return std::nullopt;
  return LightSample{s->wi, kInfinity, s->L, s->pdf, false};
}

std::optional<LightSample> surface_sample(const std::optional<Emitter::Sample>& s, bool delta) {
  if (!s) return std::nullopt;
  if (delta) return LightSample{s->point.wi, s->point.distance, s->L * (1 / s->point.pdf), 1, true};
  return LightSample{s->point.wi, s->point.distance, s->L, s->point.pdf, false};
}

}  // namespace

std::size_t primitives_of(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape.kind)) return mesh->indices.size() / 3;
  if (const auto* mesh = std::get_if<BilinearMesh>(&shape.kind)) return mesh->indices.size() / 4;
  return 1;
}

double Lights::Parts::power(LightId light) const {
  const Reference r = find(light);
  const double disk = kPi * scene_radius * scene_radius;
  switch (r.kind) {
    case Kind::point:
      return strength(points[r.index].power());
    case Kind::spot:
      return strength(spots[r.index].power());
    case Kind::profile:
      return strength(profiles[r.index].power());
    case Kind::distant:
      return strength(distants[r.index].irradiance()) * disk;
    case Kind::environment:
      return strength(environments[r.index].mean_radiance()) * 4 * kPi * disk;
    case Kind::portal:
      return portals[r.index].power();
    case Kind::emitter:
      return emitters[r.index].power(r.primitive);
    case Kind::volume:
      return volumes[r.index].power();
    case Kind::instanced:
      return instanced.power(instanced.find(light));
  }
  return 0;
}

Lights::Lights() : Lights(std::make_unique<Parts>()) {}
Lights::Lights(std::unique_ptr<const Parts> parts) : parts_(std::move(parts)) {}
Lights::~Lights() = default;
Lights::Lights(Lights&&) noexcept = default;
Lights& Lights::operator=(Lights&&) noexcept = default;

std::size_t Lights::size() const { return parts_->lights.size() + parts_->instanced_lights; }
std::size_t Lights::sought(bool with_volumes) const {
  return size() - parts_->even_skies - (with_volumes ? 0 : parts_->volumes.size());
}
const Lights::Far& Lights::far() const { return parts_->far; }
const LightStats& Lights::stats() const { return parts_->stats; }
double Lights::power(LightId light) const { return parts_->power(light); }
const Bounds3& Lights::near_box() const { return parts_->near_box; }
double Lights::near_power() const { return parts_->near_power; }
const Bounds3& Lights::point_box() const { return parts_->point_box; }
std::span<const LightId> Lights::infinite() const { return parts_->infinite; }
LightId Lights::first_light(std::size_t emitter_shape) const { return parts_->first_light[emitter_shape]; }

std::span<const SelectorStats> Lights::selectors() const { return parts_->selector_stats; }

LightId Lights::first_volume() const { return static_cast<LightId>(parts_->lights.size() - parts_->volumes.size()); }

const LightSelector& Lights::selector(LightStrategy strategy, bool with_volumes) const {
  const auto& selectors = with_volumes || parts_->volumes.empty() ? parts_->selectors : parts_->selectors_of_surfaces;
  for (std::size_t i = 0; i < selectors.size(); ++i) {
    if (parts_->selector_stats[i].strategy == strategy) return *selectors[i];
  }
  throw Error(Failure::usage, "the world was not built for light strategy " + std::string(name_of(strategy)) +
                                  "; name it in BuildSettings::lights");
}

std::optional<LightSample> Lights::sample(LightId light, Vec3 p, Vec2 u) const {
  const Parts::Reference r = parts_->find(light);
  switch (r.kind) {
    case Kind::point:
      return delta_sample(parts_->points[r.index].arrival(p));
    case Kind::spot:
      return delta_sample(parts_->spots[r.index].arrival(p));
    case Kind::profile:
      return delta_sample(parts_->profiles[r.index].arrival(p));
    case Kind::distant:
      return delta_sample(parts_->distants[r.index].arrival());
    case Kind::environment:
      return far_sample(parts_->environments[r.index].sample(u));
    case Kind::portal:
      return far_sample(parts_->portals[r.index].sample(p, u));
    case Kind::emitter: {
      const Emitter& emitter = parts_->emitters[r.index];
      return surface_sample(emitter.sample(parts_->maps, r.primitive, p, u), emitter.delta());
    }
    case Kind::instanced: {
      const auto ref = parts_->instanced.find(light);
      return surface_sample(parts_->instanced.sample(parts_->maps, ref, p, u), parts_->instanced.delta(ref));
    }
    case Kind::volume:
      break;
  }
  return std::nullopt;
}

LightPlace Lights::place(LightId light) const {
  const Parts::Reference r = parts_->find(light);
  switch (r.kind) {
    case Kind::point:
      return {.center = parts_->points[r.index].position()};
    case Kind::spot:
      return {.center = parts_->spots[r.index].position(), .beam = parts_->spots[r.index].beam()};
    case Kind::profile:
      return {.center = parts_->profiles[r.index].position(), .beam = parts_->profiles[r.index].beam()};
    case Kind::portal:
      return parts_->portals[r.index].place();
    case Kind::emitter:
      return parts_->emitters[r.index].place(r.primitive);
    case Kind::volume:
      return place_of(parts_->volumes[r.index].box);
    case Kind::instanced:
      return parts_->instanced.place(parts_->instanced.find(light));
    case Kind::distant:
    case Kind::environment:
      break;
  }
  return {};
}

std::optional<Vec3> Lights::point(LightId light) const {
  const Kind kind = parts_->find(light).kind;
  return kind == Kind::point || kind == Kind::spot || kind == Kind::profile ? place(light).center : std::nullopt;
}

float Lights::pdf(LightId light, Vec3 p, const EmitterHit& hit) const {
  const Parts::Reference r = parts_->find(light);
  if (r.kind == Kind::instanced) {
    const auto ref = parts_->instanced.find(light);
    return parts_->instanced.delta(ref) ? 0 : parts_->instanced.pdf(ref, p, hit.p);
  }
  if (r.kind != Kind::emitter || parts_->emitters[r.index].delta()) return 0;
  return parts_->emitters[r.index].pdf(r.primitive, p, hit.p);
}

Rgb Lights::emitted(LightId light, const EmitterHit& hit, Vec3 wo) const {
  const Parts::Reference r = parts_->find(light);
  if (r.kind == Kind::instanced)
    return parts_->instanced.radiance(parts_->maps, parts_->instanced.find(light), hit.uv, hit.ng, wo);
  if (r.kind != Kind::emitter) return {};
  return parts_->emitters[r.index].radiance(parts_->maps, r.primitive, hit.uv, hit.ng, wo);
}

Rgb Lights::environment(LightId light, const Ray& ray) const {
  const Parts::Reference r = parts_->lights[light];
  return r.kind == Kind::portal ? parts_->portals[r.index].radiance(ray.o, ray.d)
                                : parts_->environments[r.index].radiance(ray.d);
}

float Lights::environment_pdf(LightId light, const Ray& ray) const {
  const Parts::Reference r = parts_->lights[light];
  return r.kind == Kind::portal ? parts_->portals[r.index].pdf(ray.o, ray.d) : parts_->environments[r.index].pdf(ray.d);
}

std::size_t Lights::memory_bytes() const {
  const Parts& p = *parts_;
  std::size_t bytes = p.lights.capacity() * sizeof(Parts::Reference) + p.points.capacity() * sizeof(PointEmitter) +
                      p.spots.capacity() * sizeof(SpotEmitter) + p.profiles.capacity() * sizeof(ProfileEmitter) +
                      p.profile_library.memory_bytes() + p.distants.capacity() * sizeof(DistantEmitter) +
                      p.volumes.capacity() * sizeof(VolumeEmitter) + p.first_light.capacity() * sizeof(LightId) +
                      p.instanced.memory_bytes();
  for (const SelectorStats& s : p.selector_stats) bytes += s.memory_bytes;
  for (const Environment& e : p.environments) bytes += e.memory_bytes();
  for (const Portal& portal : p.portals) bytes += portal.memory_bytes();
  for (const Emitter& e : p.emitters) bytes += e.memory_bytes();
  for (const auto& i : p.maps.images)
    bytes += static_cast<std::size_t>(i->width()) * static_cast<std::size_t>(i->height()) * sizeof(Rgb);
  return bytes;
}

}  // namespace tyndall
