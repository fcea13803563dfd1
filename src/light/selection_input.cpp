#include "light/selection_input.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

using Kind = Lights::Parts::Kind;

void add_instances(const InstancedEmitters& instanced, SelectionInput& input) {
  for (const EmitterObject& object : instanced.objects()) {
    SharedLights& lights = input.objects.emplace_back();
    for (const Emitter& e : object.emitters()) {
      for (std::uint32_t i = 0; i < e.size(); ++i) {
        const double power = e.power(i);
        const auto number = static_cast<LightId>(lights.power.size());
        lights.power.push_back(std::isfinite(power) ? power : 0);
        if (lights.power.back() > 0) lights.near.push_back({e.bounds(i), number});
      }
    }
  }
  for (const EmitterInstance& i : instanced.instances()) {
    const double growth = power_scale(instanced.object_of(i).emitters().front(), i.to_world);
    input.instances.push_back({i.object, i.first, i.to_world, growth});
  }
}

}  // namespace

SelectionInput selection_input(const Lights::Parts& p, const LightBuildOptions& options) {
  SelectionInput input;
  input.threads = options.threads;
  input.power.reserve(p.lights.size());
  const auto& wanted = options.strategies;
  const bool tree = std::any_of(wanted.begin(), wanted.end(), uses_bounds);
  if (tree) input.near.reserve(p.lights.size());
  const auto add_near = [&](LightBounds bounds, LightId id) { input.near.push_back({bounds, id}); };
  for (LightId id = 0; id < p.lights.size(); ++id) {
    const auto r = p.lights[id];
    const double power = p.power(id);
    input.power.push_back(std::isfinite(power) ? power : 0);
    if (!tree || !(input.power.back() > 0)) continue;
    if (r.kind == Kind::emitter) add_near(p.emitters[r.index].bounds(r.primitive), id);
    if (r.kind == Kind::volume) add_near(p.volumes[r.index].bounds(), id);
    if (r.kind == Kind::profile) add_near(p.profiles[r.index].bounds(), id);
    if (r.kind == Kind::portal) add_near(p.portals[r.index].bounds(), id);
    if (r.kind == Kind::environment) input.far.push_back({p.environments[r.index].cones(), id});
    if (r.kind == Kind::distant) input.far.push_back({{p.distants[r.index].cone()}, id});
    if (r.kind == Kind::point || r.kind == Kind::spot) {
      LightBounds bounds = r.kind == Kind::point ? p.points[r.index].bounds() : p.spots[r.index].bounds();
      const Rgb I = r.kind == Kind::point ? p.points[r.index].intensity() : p.spots[r.index].intensity();
      bounds.intensity = static_cast<float>(strength(I));
      add_near(bounds, id);
    }
  }
  add_instances(p.instanced, input);
  return input;
}

}  // namespace tyndall
