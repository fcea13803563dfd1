#include "transport/pixel/visible_emitters.h"

#include <cmath>

#include "transport/pixel/directly_visible.h"
#include "transport/sample/deep_sample.h"
#include "transport/sample/grouped_light.h"

namespace tyndall {
namespace {

/// Of a Fibonacci lattice of 13 points: spread evenly in the square and along both of its sides.
constexpr int kLatticeStep = 8;

float wrapped(float u) { return std::min(u - std::floor(u), kOneMinusEpsilon); }

/// `count` points, moved within one cell of their lattice, between its two shortest vectors: so the lattices of all samples
/// together are as even as the points that move them. A single point is its own lattice.
class Lattice {
 public:
  Lattice(int count, Vec2 u) : count_(count), shift_(u) {
    if (count > 1) shift_ = {(2 * u.x + 3 * u.y) / static_cast<float>(count), (3 * u.x - 2 * u.y) / static_cast<float>(count)};
  }
  Vec2 operator[](int i) const {
    const float spacing = 1 / static_cast<float>(count_);
    const int row = i * kLatticeStep % count_;
    return {wrapped(shift_.x + static_cast<float>(i) * spacing), wrapped(shift_.y + static_cast<float>(row) * spacing)};
  }

 private:
  int count_;
  Vec2 shift_;
};

/// By the ray through a place on an emitter's image, drawn by `u`.
Rgb found_at(const LightContext& context, const PixelEmitters& emitters, Vec2 center, Vec2 u, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  const FilmEmitter& emitter = emitters.draw(u.x);
  const Point2 middle{center.x, center.y};
  const auto image = image_of(world, emitter.shape, emitter.primitive);
  const auto place = emitters.cells->sample(image->moved({-middle.x, -middle.y}), u);
  const auto filter = world.filter.at({static_cast<float>(place.at.x), static_cast<float>(place.at.y)});
  if (!(place.pdf > 0) || !(filter.pdf > 0)) return {};
  const Ray ray = world.camera.ray_through({middle.x + place.at.x, middle.y + place.at.y});
  ++context.counters.rays;
  const auto seen = directly_visible(world, ray);
  if (!seen || seen->light != emitter.light(world)) return {};
  const auto pdf = static_cast<float>(place.pdf) * emitter.share;
  const Rgb light = seen->L * attenuated(context, ray, *seen, sampler) *
                    (filter.weight * filter.pdf / (pdf * static_cast<float>(emitters.positions)));
  if (context.groups) context.groups->estimate(seen->light, light);
  if (context.deep) context.deep->from_surface(world.camera.depth(seen->hit.p), light);
  return light;
}

}  // namespace

Rgb visible_emitters(const LightContext& context, const PixelEmitters& emitters, Vec2 center, Sampler sampler) {
  const Lattice lattice(emitters.positions, sampler.next_2d());
  Rgb sum;
  for (int i = 0; i < emitters.positions; ++i) sum += found_at(context, emitters, center, lattice[i], sampler);
  return sum;
}

}  // namespace tyndall
