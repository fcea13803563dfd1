#include "transport/sample/emission_by_group.h"

#include "volume/homogeneous.h"

namespace tyndall {
namespace {

/// Of what a path counts the part that media of one group emit.
class GroupGauge final : public EmissionGauge {
 public:
  GroupGauge(const LightGroups& groups, std::size_t group, const EmissionGauge* gauge)
      : groups_(groups), group_(group), gauge_(gauge) {}

  Rgb counted(MediaView media, Vec3 p, Rgb) const override {
    Rgb sum;
    for (const ParticipatingMedium* const& medium : media) {
      if (!medium->emissive() || groups_.of(*medium) != group_) continue;
      const Coefficients c = medium->at(p);
      const Rgb emission = c.sigma_a * c.Le;
      sum += gauge_ ? gauge_->counted({&medium, 1}, p, emission) : emission;
    }
    return sum;
  }

 private:
  const LightGroups& groups_;
  std::size_t group_;
  const EmissionGauge* gauge_;
};

using Present = SmallVector<std::size_t, 4>;

Present groups_present(MediaView media, const LightGroups& groups) {
  Present present;
  for (const ParticipatingMedium* medium : media) {
    if (!medium->emissive()) continue;
    const std::size_t group = groups.of(*medium);
    if (std::find(present.begin(), present.end(), group) == present.end()) present.push_back(group);
  }
  return present;
}

/// In any unit that all groups share.
Rgb share_of(const PassedEmission& passed, const GroupGauge& gauge) {
  const MediaView media = passed.part.view();
  if (!passed.look.gauge && all_homogeneous(media)) return gauge.counted(media, passed.ray.o, {});
  Rng rng = passed.rng;
  TrackingStats seen_before;
  const EmissionLook look{&gauge, passed.look.density};
  return emission_and_transmittance(media, passed.ray, passed.part.t0, passed.part.t1, look, rng, seen_before).emitted;
}

}  // namespace

void add_by_medium(const PassedEmission& passed, Rgb emitted, Rgb T, const LightGroups& groups, GroupedLight::Sums& into) {
  if (is_black(emitted)) return;
  const Present present = groups_present(passed.part.view(), groups);
  if (present.size() == 1) {
    into[present[0]] += T * emitted;
    return;
  }
  SmallVector<Rgb, 4> shares;
  Rgb sum;
  for (const std::size_t group : present) {
    shares.push_back(share_of(passed, GroupGauge(groups, group, passed.look.gauge)));
    sum += shares.back();
  }
  for (std::size_t i = 0; i < present.size(); ++i) {
    Rgb light = T * emitted;
    for (int k = 0; k < 3; ++k) light[k] = sum[k] != 0 ? light[k] * (shares[i][k] / sum[k]) : 0.0f;
    into[present[i]] += light;
  }
}

}  // namespace tyndall
