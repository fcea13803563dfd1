/// The direction of a path at a vertex: by the scattering function, at the first surface also guided toward bright media, and
/// at collisions toward the aureoles of suns.
#pragma once

#include <optional>

#include "transport/sample/light_context.h"
#include "transport/vertex/media_directions.h"
#include "transport/vertex/vertex.h"
#include "volume/aureole.h"

namespace tyndall {

/// Whether rays are guided from all surfaces of bounce number `bounce`, whatever is before them: nothing else finds volume
/// emission.
bool guides_everywhere(const LightContext& context, int bounce);

/// Path guiding by a mixture of densities [Vorba et al. 2014], from what is known of the scene instead of learned.
class Directions {
 public:
  /// For bounce number context.bounce.
  Directions(const LightContext& context, const Vertex& vertex);

  const Vertex& vertex() const { return vertex_; }
  /// 1/sr, of sample(); `beta` as for a Vertex.
  float pdf(Vec3 wi, Rgb beta) const;
  std::optional<ScatterSample> sample(Rgb beta, Sampler& sampler) const;
  /// At a collision: what guides there.
  const std::optional<Aureole>& aureole() const { return aureole_; }

 private:
  float mixed(float guided, float scattered) const {
    return (1 - toward_media_->share()) * scattered + toward_media_->share() * guided;
  }
  std::optional<ScatterSample> mixed_sample(Rgb beta, float uc, Vec2 u) const;
  std::optional<ScatterSample> toward_media(Rgb beta, float u, Vec2 on_cone) const;
  std::optional<ScatterSample> toward_aureole(Rgb beta, Rng rng) const;

  const Vertex& vertex_;
  std::optional<MediaDirections> toward_media_;
  std::optional<Aureole> aureole_;
};

}  // namespace tyndall
