/// Next-event estimation at a vertex, for any search for lights and any technique that competes with it.
#pragma once

#include <optional>

#include "math/small_vector.h"
#include "transport/budget/light_trial.h"
#include "transport/sample/grouped_light.h"
#include "transport/techniques/resampling.h"
#include "transport/techniques/shadow_ray.h"
#include "transport/vertex/vertex.h"

namespace tyndall {

/// At a vertex. `Search` has a selector, whether volumes are among its lights, a query, the cut made for it
/// and shadow_rays; `Share` is a function of a LightSample and the density of the candidates: its MIS weight.
template <typename Search, typename Share>
class NextEvent {
 public:
  NextEvent(const LightContext& context, const Vertex& vertex, const Search& search, Rgb beta, const Share& share)
      : context_(context), vertex_(vertex), search_(search), beta_(beta), share_(share) {}

  /// Of all lights, or of the candidates that survive resampling.
  /// `trial`, unless null, is told what the choice adds to the noise.
  Rgb estimate(Sampler& sampler, LightTrial* trial = nullptr) const {
    return search_.among->exhaustive() ? all(sampler) : chosen(sampler, trial);
  }

 private:
  /// A candidate evaluated without visibility.
  struct Candidate {
    LightId id;
    LightSample light;
    Rgb contribution;  ///< were it visible: scattering x radiance x MIS weight / density, of all candidates together
    float weight;      ///< in resampling: the contribution's size
  };

  std::optional<Candidate> look_at(LightCandidate candidate, Vec2 u) const {
    const auto light = sample_light(context_, candidate.light, vertex_.p(), u);
    // What is not a number is kept, so that the film sees and counts it.
    if (!light || is_black(light->L)) return std::nullopt;
    const float density = candidate.n_pmf * light->pdf;
    if (density <= 0) return std::nullopt;
    const Rgb f = vertex_.eval(light->wi);
    if (is_black(f)) return std::nullopt;
    const Rgb contribution = f * light->L * (share_(*light, candidate.light, density) / density);
    const float weight = mean(beta_ * contribution);
    if (weight == 0) return std::nullopt;
    return Candidate{candidate.light, *light, contribution, weight};
  }

  /// The candidate's contribution times the transmittance in between and `scale`.
  Rgb trace(const Candidate& c, float scale, Sampler& sampler) const {
    const Geometry& geometry = context_.world.geometry;
    const MediaState media = vertex_.media_toward(geometry, c.light.wi);
    const Rgb light =
        c.contribution * arriving(context_, media, vertex_.origin(geometry, c.light.wi), c.light, sampler) * scale;
    if (context_.groups) context_.groups->estimate(c.id, light);
    if (context_.arrived) context_.arrived->push_back({c.id, c.light.wi, light});
    return light;
  }

  Rgb all(Sampler& sampler) const {
    Rgb sum;
    for (LightId id = 0; id < context_.world.lights.size(); ++id) {
      if (!search_.volumes && context_.world.volume_lights.holds(id)) continue;
      if (const auto c = look_at({id, 1}, sampler.next_2d())) sum += trace(*c, 1, sampler);
    }
    return sum;
  }

  Rgb chosen(Sampler& sampler, LightTrial* trial) const {
    ++context_.counters.choices;
    const float u = sampler.next_1d();
    SmallVector<Candidate, 8> candidates;
    for (const LightCandidate& candidate : search_.among->draw(search_.cut, search_.query, sampler.next_wide())) {
      ++context_.counters.candidates;
      if (const auto c = look_at(candidate, sampler.next_2d())) candidates.push_back(*c);
    }
    Rgb sum;
    RayTrial rays(context_, trial);
    for (const Survivor& s : resample(candidates, search_.shadow_rays, u)) {
      const Rgb light = trace(candidates[s.index], s.scale, sampler);
      rays.add(beta_ * light, s.scale);
      sum += light;
    }
    rays.note(Spent::vertex_rays);
    return sum;
  }

  const LightContext& context_;
  const Vertex& vertex_;
  const Search& search_;
  Rgb beta_;
  const Share& share_;
};

}  // namespace tyndall
