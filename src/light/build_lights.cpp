// From the scene's descriptions to Lights: places every light, loads its images, and sets up the choice among them.
#include <algorithm>
#include <cmath>
#include <map>

#include "light/instance_runs.h"
#include "light/lights_parts.h"
#include "light/selection_input.h"
#include "tyndall/error.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

using Kind = Lights::Parts::Kind;

Bounds3 box_of(std::span<const Emitter> emitters) {
  Bounds3 box;
  for (const Emitter& e : emitters) {
    for (std::uint32_t k = 0; k < e.size(); ++k) box.expand(e.box(k));
  }
  return box;
}

class Builder {
 public:
  explicit Builder(const LightBuildOptions& options) : parts_(std::make_unique<Lights::Parts>()), options_(options) {
    parts_->maps.textures = options.textures;
  }

  void add(const Light& light);
  void add_alone(std::span<const EmitterShape> shapes, std::span<const InstanceRun> shared);
  void add(const VolumeEmitter& volume);
  void add_instance(std::span<const EmitterShape> shapes, const InstanceRun& run);
  Lights finish(const Bounds3& scene_bounds);

 private:
  static void require_finite(Rgb value, const Location& where);
  void require_room(std::size_t lights) const;
  void refer(Kind kind, std::size_t index, std::uint32_t primitive = 0);
  template <typename Described>
  void add_profile(const Described& light, const Location& where);
  Emitter emitter(const Shape& shape, const Transform& to_world);
  Emission emission(const Shape& shape);
  std::uint32_t image(const AreaLight& light, const Location& where);
  void add_selector(LightStrategy strategy, SelectionInput input);
  void add_selectors_of_surfaces(SelectionInput input);
  void count(const SelectionInput& input);
  void enclose();
  void gather_far();

  std::unique_ptr<Lights::Parts> parts_;
  LightBuildOptions options_;
  std::map<std::pair<std::string, std::array<float, 9>>, std::uint32_t> images_;
  std::map<ObjectId, std::uint32_t> objects_;  ///< to those of parts_->instanced
};

void Builder::require_finite(Rgb value, const Location& where) {
  if (!is_finite(value)) throw Error(where, "the light's strength is not finite; replace its NaN or infinite values");
}

void Builder::require_room(std::size_t lights) const {
  if (parts_->lights.size() + parts_->instanced_lights + lights > 0x3fffffff)
    throw Error(Failure::scene, "the scene has more than 2^30 lights; merge some of its emissive primitives");
}

void Builder::refer(Kind kind, std::size_t index, std::uint32_t primitive) {
  require_room(1);
  Lights::Parts::Reference& reference = parts_->lights.emplace_back();
  reference.kind = kind;
  reference.index = static_cast<std::uint32_t>(index) & 0x0fffffff;
  reference.primitive = primitive;
}

void Builder::add(const Light& light) {
  if (const auto* l = std::get_if<PointLight>(&light.kind)) {
    require_finite(l->I, light.where);
    refer(Kind::point, parts_->points.size());
    parts_->points.emplace_back(*l);
  } else if (const auto* s = std::get_if<SpotLight>(&light.kind)) {
    require_finite(s->I, light.where);
    refer(Kind::spot, parts_->spots.size());
    parts_->spots.emplace_back(*s);
  } else if (const auto* goniometric = std::get_if<GoniometricLight>(&light.kind)) {
    add_profile(*goniometric, light.where);
  } else if (const auto* projection = std::get_if<ProjectionLight>(&light.kind)) {
    add_profile(*projection, light.where);
  } else if (const auto* d = std::get_if<DistantLight>(&light.kind)) {
    require_finite(d->E, light.where);
    refer(Kind::distant, parts_->distants.size());
    parts_->distants.emplace_back(*d);
  } else {
    const auto& infinite = std::get<InfiniteLight>(light.kind);
    require_finite(infinite.L, light.where);
    parts_->infinite.push_back(static_cast<LightId>(parts_->lights.size()));
    if (infinite.portal) {
      refer(Kind::portal, parts_->portals.size());
      parts_->portals.emplace_back(infinite, light.where, options_.kept);
      return;
    }
    refer(Kind::environment, parts_->environments.size());
    parts_->environments.emplace_back(infinite, light.where, options_.kept);
    if (parts_->environments.back().even()) ++parts_->even_skies;
  }
}

template <typename Described>
void Builder::add_profile(const Described& light, const Location& where) {
  require_finite(light.I, where);
  const IntensityProfile& profile = parts_->profile_library.of(light, where, options_.kept);
  refer(Kind::profile, parts_->profiles.size());
  parts_->profiles.emplace_back(light.to_world, ProfileEmitter::Strength{light.I, light.power}, profile);
}

std::uint32_t Builder::image(const AreaLight& light, const Location& where) {
  const auto [entry, added] =
      images_.try_emplace({light.path, light.to_rec709}, static_cast<std::uint32_t>(parts_->maps.images.size()));
  if (added) {
    try {
      parts_->maps.images.push_back(TexelImage::load(options_.kept, light.path, light.to_rec709));
    } catch (const Error& error) {
      throw Error(where, error.what());
    }
  }
  return entry->second;
}

Emission Builder::emission(const Shape& shape) {
  const AreaLight& light = *shape.emission;
  require_finite(light.L, shape.where);
  Emission e;
  e.L = e.mean = light.L;
  e.power = light.power;
  e.two_sided = light.two_sided;
  if (!light.path.empty()) {
    e.image = image(light, shape.where);
    const Rgb average = parts_->maps.images[*e.image]->average();
    e.mean = light.L * average;
    e.power_per_radiosity = luminance(average);
  }
  if (shape.alpha && options_.textures) {
    const auto constant = options_.textures->constant(*shape.alpha);
    e.invisible = constant && mean(*constant) <= 0;
    if (!e.invisible && !(constant && mean(*constant) >= 1)) e.alpha = shape.alpha;
  }
  return e;
}

Emitter Builder::emitter(const Shape& shape, const Transform& to_world) {
  const Emission e = emission(shape);
  const auto surface = [&]() -> Emitter::Surface {
    const bool with_uvs = e.image || e.alpha;
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape.kind))
      return TriangleEmitter(*mesh, to_world, shape.reverse_orientation, with_uvs);
    if (const auto* mesh = std::get_if<BilinearMesh>(&shape.kind))
      return PatchEmitter(*mesh, to_world, shape.reverse_orientation, with_uvs);
    return QuadricEmitter(shape, to_world, !e.alpha && !e.invisible);
  };
  return Emitter(surface(), e);
}

/// Those that are in none of the runs.
void Builder::add_alone(std::span<const EmitterShape> shapes, std::span<const InstanceRun> shared) {
  parts_->first_light.resize(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!shared.empty() && i == shared.front().begin) {
      i = shared.front().end - 1;
      shared = shared.subspan(1);
      continue;
    }
    parts_->first_light[i] = static_cast<LightId>(parts_->lights.size());
    const Emitter& added = parts_->emitters.emplace_back(emitter(*shapes[i].shape, shapes[i].to_world));
    for (std::uint32_t k = 0; k < added.size(); ++k) refer(Kind::emitter, parts_->emitters.size() - 1, k);
  }
}

/// After all others: ids of instances' lights are computed.
void Builder::add_instance(std::span<const EmitterShape> shapes, const InstanceRun& run) {
  InstancedEmitters& instanced = parts_->instanced;
  const auto [known, is_new] = objects_.try_emplace(shapes[run.begin].instance->object);
  if (is_new) {
    std::vector<Emitter> emitters;
    for (const EmitterShape& s : shapes.subspan(run.begin, run.end - run.begin))
      emitters.push_back(emitter(*s.shape, s.shape->to_world));
    known->second = instanced.add_object(std::move(emitters));
  }
  const EmitterObject& object = instanced.objects()[known->second];
  require_room(object.size());
  const auto first = static_cast<LightId>(parts_->lights.size() + parts_->instanced_lights);
  instanced.add_instance(known->second, run.to_world, first);
  for (std::size_t i = run.begin; i < run.end; ++i) parts_->first_light[i] = first + object.first(i - run.begin);
  parts_->instanced_lights += object.size();
}

void Builder::add(const VolumeEmitter& volume) {
  refer(Kind::volume, parts_->volumes.size());
  parts_->volumes.push_back(volume);
}

void Builder::count(const SelectionInput& input) {
  LightStats& stats = parts_->stats;
  stats.lights = parts_->lights.size() + parts_->instanced_lights;
  stats.infinite = parts_->infinite.size();
  stats.points = parts_->points.size() + parts_->spots.size() + parts_->profiles.size() + parts_->distants.size();
  for (const Emitter& e : parts_->emitters) stats.emitters += e.size();
  double far = 0, near = 0;  // of their difference from the sum nothing might be left
  for (LightId id = 0; id < input.power.size(); ++id) {
    const Kind kind = parts_->lights[id].kind;
    (kind == Kind::distant || kind == Kind::environment ? far : near) += input.power[id];
    if (!(input.power[id] > 0)) ++stats.dark;
  }
  stats.shared = parts_->instanced_lights;
  stats.emitters += stats.shared;
  for (const LightInstance& i : input.instances) {
    for (const double power : input.objects[i.object].power) {
      near += power * i.growth;
      if (!(power > 0)) ++stats.dark;
    }
  }
  stats.power = far + near;
  parts_->near_power = near;
}

void Builder::enclose() {
  for (const PointEmitter& p : parts_->points) parts_->point_box.expand(p.position());
  for (const SpotEmitter& s : parts_->spots) parts_->point_box.expand(s.position());
  for (const ProfileEmitter& p : parts_->profiles) parts_->point_box.expand(p.position());
  Bounds3& all = parts_->near_box;
  all.expand(parts_->point_box);
  all.expand(box_of(parts_->emitters));
  for (const Portal& portal : parts_->portals) all.expand(portal.bounds().box);
  std::vector<Bounds3> objects;
  for (const EmitterObject& o : parts_->instanced.objects()) objects.push_back(box_of(o.emitters()));
  for (const EmitterInstance& i : parts_->instanced.instances()) {
    const Bounds3& box = objects[i.object];
    if (box.empty()) continue;
    for (int k = 0; k < 8; ++k) all.expand(to_vec3(i.to_world.point(Vec3d(box.corner(k)))));
  }
}

void Builder::gather_far() {
  Lights::Far& far = parts_->far;
  for (const DistantEmitter& d : parts_->distants) {
    const FarCone cone = d.cone();
    if (cone.fluence > 0 && std::isfinite(cone.fluence)) far.suns.push_back(cone);
  }
  for (const Environment& e : parts_->environments) {
    double rest = strength(e.mean_radiance()) * 4 * double{kPi};
    if (const auto sun = e.peak()) {
      rest -= double{sun->fluence};
      far.suns.push_back(*sun);
    }
    far.rest += static_cast<float>(std::max(rest, 0.0));
  }
  std::stable_sort(far.suns.begin(), far.suns.end(), [](const FarCone& a, const FarCone& b) { return a.fluence > b.fluence; });
}

void Builder::add_selector(LightStrategy strategy, SelectionInput input) {
  const Timer watch;
  parts_->selectors.push_back(make_selector(strategy, std::move(input)));
  parts_->selector_stats.push_back({strategy, watch.seconds(), parts_->selectors.back()->memory_bytes()});
}

/// For renders in which media that emit are found by scattered rays alone.
void Builder::add_selectors_of_surfaces(SelectionInput input) {
  if (parts_->volumes.empty()) return;
  const std::size_t first = parts_->lights.size() - parts_->volumes.size();
  std::fill(input.power.begin() + static_cast<std::ptrdiff_t>(first), input.power.end(), 0.0);
  std::erase_if(input.near, [first](const TreeLight& light) { return light.light >= first; });
  for (const LightStrategy strategy : options_.strategies)
    parts_->selectors_of_surfaces.push_back(make_selector(strategy, input));
}

Lights Builder::finish(const Bounds3& scene_bounds) {
  if (!scene_bounds.empty()) {
    const double radius = 0.5 * length(scene_bounds.extent());
    if (radius > 0 && std::isfinite(radius)) parts_->scene_radius = radius;
  }
  SelectionInput input = selection_input(*parts_, options_);
  input.region = scene_bounds;
  count(input);
  enclose();
  gather_far();
  add_selectors_of_surfaces(input);
  const auto& strategies = options_.strategies;
  for (std::size_t i = 0; i + 1 < strategies.size(); ++i) add_selector(strategies[i], input);
  if (!strategies.empty()) add_selector(strategies.back(), std::move(input));
  return Lights(std::move(parts_));
}

}  // namespace

Lights build_lights(const Scene& scene, std::span<const EmitterShape> shapes, const Bounds3& scene_bounds,
                    const LightBuildOptions& options) {
  Builder builder(options);
  for (const Light& light : scene.lights) builder.add(light);
  const std::vector<InstanceRun> shared = shared_runs(shapes);
  builder.add_alone(shapes, shared);
  for (const VolumeEmitter& volume : options.volumes) builder.add(volume);
  for (const InstanceRun& run : shared) builder.add_instance(shapes, run);
  return builder.finish(scene_bounds);
}

}  // namespace tyndall
