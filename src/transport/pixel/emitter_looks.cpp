#include "transport/pixel/emitter_looks.h"

#include <algorithm>

#include "transport/pixel/directly_visible.h"

namespace tyndall {
namespace {

/// Between looks, relative to the brighter: more than emission varies, less than another emitter differs.
constexpr float kLeastContrast = 0.1f;

float fraction(float x) { return x - std::floor(x); }

/// Points that are spread evenly, by their number [Roberts 2018].
Vec2 on_lens(int i) {
  return {fraction(0.5f + 0.7548777f * static_cast<float>(i)), fraction(0.5f + 0.5698403f * static_cast<float>(i))};
}

}  // namespace

EmitterLooks::Met EmitterLooks::at(Point2 center, const EmitterImage& image, std::size_t count) const {
  const ConvexPolygon about = image.on_film().moved({-center.x, -center.y});
  Met looks;
  for (std::size_t i = 0; i < count; ++i) {
    const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(count),
                across = fraction(0.5f + 0.618034f * static_cast<float>(i));
    const auto place = cells_.sample(about, {along, across});
    if (!(place.pdf > 0)) continue;
    const Point2 film{center.x + place.at.x, center.y + place.at.y};
    const LensPart part = image.on_lens(film);
    looks.through += part.share() / static_cast<double>(count);
    const auto lens = part.sample(on_lens(static_cast<int>(i)));
    if (!lens) continue;
    const Ray ray = world_.camera.ray_through(film, *lens);
    const auto seen = directly_visible(world_, ray);
    ++looks.rays;
    looks.met += seen && seen->light == image.light() && attenuated_roughly(world_, ray, *seen) > 0;
  }
  return looks;
}

bool EmitterLooks::even(Point2 center, int side) const {
  float least = kInfinity, most = 0;
  const auto place = [&](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(side); };
  for (int i = 0; i < side * side; ++i) {
    const Vec2 offset = world_.filter.sample({place(i % side), place(i / side)}).p;
    const auto lens = LensPart().sample(on_lens(i));
    const Ray ray = world_.camera.ray_through({center.x + offset.x, center.y + offset.y}, *lens);
    const auto seen = directly_visible(world_, ray);
    const float brightness = seen ? mean(seen->L) * attenuated_roughly(world_, ray, *seen) : 0.0f;
    least = std::min(least, brightness);
    most = std::max(most, brightness);
  }
  return most - least <= kLeastContrast * most;
}

}  // namespace tyndall
