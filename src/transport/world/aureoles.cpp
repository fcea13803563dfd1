#include "transport/world/aureoles.h"

#include <algorithm>
#include <cmath>

#include "transport/sample/light_context.h"
#include "volume/coarse.h"

namespace tyndall {
namespace {

/// Suns with less of the brightest one's light are not worth a look at the media before them.
constexpr float kLeastSun = 0.1f;
/// Of a direction e^-4 is left after this many turns of the mean cosine each: behind more, all light is even.
constexpr float kTurns = 4;
/// Of a path, from being guided, beyond which it is guided less and less: it was sent where its light is not, and such weights
/// multiply.
constexpr float kMostWeight = 10;

/// Mean albedo of single scattering.
float albedo_of(const ActiveMedia& media) {
  float sum = 0, count = 0;
  for (const ParticipatingMedium* medium : media) {
    if (!medium->scatters()) continue;
    sum += medium->albedo(), count += 1;
  }
  return count > 0 ? sum / count : 0.0f;
}

}  // namespace

Aureoles::Aureoles(const Lights& lights) : rest_(lights.far().rest) {
  for (const FarCone& sun : lights.far().suns) {
    const bool seen = suns_.size() < Aureole::kMostSources && (suns_.empty() || sun.fluence >= kLeastSun * suns_[0].fluence);
    if (seen) {
      suns_.push_back(sun);
    } else {
      rest_ += sun.fluence;
    }
  }
  if (!suns_.empty() && !lights.near_box().empty())
    near_ = NearFluence(lights.near_box(), static_cast<float>(lights.near_power()));
}

std::optional<Aureole> Aureoles::at(const LightContext& context, const Vertex& vertex) const {
  const BuiltWorld& world = context.world;
  const auto& groups = world.geometry.groups();
  const ActiveMedia media = vertex.media().active(groups, world.media);
  const Bounds3 box = vertex.media().bounds(groups);
  const Vec3 p = vertex.p();
  const float g = vertex.medium()->phase.mean_cosine(), deepest = kTurns / std::max(1 - g, 0.05f);
  const int orders = context.settings.max_depth - context.bounce - 1;
  Aureole aureole({g, albedo_of(media), orders}, rest_ + near_.at(p), std::max(context.guided_weight / kMostWeight, 1.0f));
  for (const FarCone& sun : suns_) {
    const Ray ray{p, sun.directions.axis};
    if (world.geometry.occluded(ray, 0, kInfinity)) continue;
    const float depth = nearby_optical_depth({media.data(), media.size()}, ray, exit_distance(box, ray), deepest);
    aureole.add({ray.d, sun.fluence, std::min(length(sun.mean), 1.0f), depth});
  }
  return aureole.shows() ? std::optional(aureole) : std::nullopt;
}

}  // namespace tyndall
