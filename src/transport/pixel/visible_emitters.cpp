#include "transport/pixel/visible_emitters.h"

#include <optional>

#include "transport/pixel/directly_visible.h"
#include "transport/pixel/emitter_image.h"
#include "transport/pixel/fibonacci_lattice.h"
#include "transport/sample/deep_sample.h"
#include "transport/sample/grouped_light.h"

namespace tyndall {
namespace {

/// How many points farther the lens is for the film's next: so that any two of the four coordinates are spread evenly.
int lens_step(int count) { return count == FibonacciLattice::kFew ? 2 : 4; }

/// Random numbers for a place on an emitter's image, and one on the lens.
struct PlaceNumbers {
  Vec2 film, lens;
};

/// What the rays through places on emitters' images, from places on the lens that they are seen from there, find for a pixel.
class Finder {
 public:
  Finder(const LightContext& context, const PixelEmitters& emitters, Vec2 center, Sampler& sampler)
      : context_(context), emitters_(emitters), middle_{center.x, center.y}, sampler_(sampler) {}

  Rgb find(PlaceNumbers u) {
    const BuiltWorld& world = context_.world;
    const FilmEmitter& emitter = emitters_.draw(u.film.x);
    const EmitterImage& image = image_of(emitter);
    const auto place = emitters_.cells->sample(image.on_film().moved({-middle_.x, -middle_.y}), u.film);
    const auto filter = world.filter.at({static_cast<float>(place.at.x), static_cast<float>(place.at.y)});
    if (!(place.pdf > 0) || !(filter.pdf > 0)) return {};
    const Point2 film{middle_.x + place.at.x, middle_.y + place.at.y};
    const LensPart part = image.on_lens(film);
    const auto lens = part.sample(u.lens);
    if (!lens) return {};
    const auto pdf = static_cast<float>(place.pdf / part.share()) * emitter.share;
    return seen(emitter.light(world), world.camera.ray_through(film, *lens),
                filter.weight * filter.pdf / (pdf * static_cast<float>(emitters_.positions)));
  }

 private:
  /// That of the one before, where it is the same emitter.
  const EmitterImage& image_of(const FilmEmitter& emitter) {
    if (&emitter != before_) image_ = EmitterImage::of(context_.world, emitter.shape, emitter.primitive);
    before_ = &emitter;
    return *image_;
  }

  /// What a ray sees of a light, times `weight`.
  Rgb seen(LightId light, const Ray& ray, float weight) {
    ++context_.counters.rays;
    const auto seen = directly_visible(context_.world, ray);
    if (!seen || seen->light != light) return {};
    const Rgb found = seen->L * attenuated(context_, ray, *seen, sampler_) * weight;
    if (context_.groups) context_.groups->estimate(light, found);
    if (context_.deep) context_.deep->from_surface(context_.world.camera.depth(seen->hit.p), found);
    return found;
  }

  const LightContext& context_;
  const PixelEmitters& emitters_;
  Point2 middle_;
  Sampler& sampler_;
  const FilmEmitter* before_ = nullptr;
  std::optional<EmitterImage> image_;
};

}  // namespace

Rgb visible_emitters(const LightContext& context, const PixelEmitters& emitters, Vec2 center, Sampler sampler) {
  const int count = emitters.positions;
  const FibonacciLattice on_film(count, sampler.next_2d());
  Finder finder(context, emitters, center, sampler);
  Rgb sum;
  if (context.world.camera.is_sharp()) {
    for (int i = 0; i < count; ++i) sum += finder.find({on_film[i], {}});
    return sum;
  }
  const FibonacciLattice on_lens(count, sampler.next_2d());
  // Points of lattices stay in cells of their own: which go together is left to chance.
  const int first = static_cast<int>(sampler.next_1d() * static_cast<float>(count));
  for (int i = 0; i < count; ++i) sum += finder.find({on_film[i], on_lens[(first + i * lens_step(count)) % count]});
  return sum;
}

}  // namespace tyndall
