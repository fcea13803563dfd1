#include "session/pixel_sample.h"

#include <algorithm>
#include <utility>

#include "math/warp.h"

namespace tyndall {
namespace {

Vec2 center_of(const SampleKey& key) { return {static_cast<float>(key.x) + 0.5f, static_cast<float>(key.y) + 0.5f}; }

}  // namespace

PixelSample::PixelSample(const SampleContext& sample, const SampleKey& key, PixelFilm film, Counters& counters)
    : world_(sample.world),
      key_(key),
      film_(std::move(film)),
      sampler_(key),
      offset_(sample.world.built.filter.sample(sampler_.next_2d())),
      on_film_(center_of(key) + offset_.p),
      joint_weight_(film_.points, on_film_, offset_.pdf),
      peak_weight_(film_.peaks, on_film_, offset_.pdf) {
  const Vec2 lens = sampler_.next_2d();
  LightContext context{world_.built, sample.selector, sample.settings, sampler_, counters};
  context.selector_with_volumes = sample.selector_with_volumes;
  if (!world_.built.light_groups.empty()) context.groups = &groups_.emplace(world_.built.light_groups);
  context.budget = sample.budget;
  if (sample.mattes) context.matte = &matte_.emplace();
  if (sample.bins) context.deep = &deep_.emplace(*sample.bins, world_.built.camera);
  if (!film_.points.empty()) {
    context.joint = &joint_weight_;
    of_points_ = camera_joint_estimate(context, film_.points, center_of(key), sampler_.fork());
  }
  if (!film_.peaks.empty()) {
    context.joint_at_surface = &peak_weight_;
    of_peaks_ = peak_estimate(context, film_.peaks, center_of(key), sampler_.fork());
  }
  if (!film_.emitters.empty()) {
    context.drawn_emission = &drawn_emission_.emplace(film_.emitters, on_film_, square_to_concentric_disk(lens));
    of_emitters_ = visible_emitters(context, film_.emitters, center_of(key), sampler_.fork());
  }
  if (groups_) groups_->settle(Rgb(1 / offset_.weight), groups_->found);
  if (deep_) deep_->scale(1 / offset_.weight);
  const auto seen = world_.built.camera.sample(on_film_, lens);
  if (!seen) return;
  weight_of_ray_ = seen->weight;
  path_.emplace(context, sample.limits, seen->ray);
}

PathRecord PixelSample::record() {
  PathRecord record = path_ ? path_->result() : PathRecord();
  if (path_) receive_light(record);
  if (deep_) {
    by_depth_ = deep_->parts(record);
    record.alpha = deep_->alpha();
  }
  place(record);
  return record;
}

void PixelSample::receive_light(PathRecord& record) {
  record.volume_direct += of_points_ * (1 / offset_.weight);  // the film takes it times that weight
  record.surface_direct += of_peaks_ * (1 / offset_.weight);
  record.emission += of_emitters_ * (1 / offset_.weight);
  expose(record);
}

/// Positions and depths, in the user's space and units.
void PixelSample::place(PathRecord& record) const {
  if (record.hit_surface) record.p = world_.to_user.point(record.p);
  record.z *= world_.unit;
  record.z_volume *= world_.unit;
}

void PixelSample::scale(PathRecord& record, float s) {
  record.scale_radiance(s);
  if (groups_) groups_->scale(s);
  if (deep_) deep_->scale(s);
}

void PixelSample::expose(PathRecord& record) {
  const Film& film = world_.built.scene.film;
  scale(record, film.imaging_ratio * weight_of_ray_);
  const Rgb radiance = record.radiance();  // may be negative, where the filter is
  const float brightest = std::max(max_component(radiance), max_component(radiance * -1.0f));
  if (brightest > film.max_component) scale(record, film.max_component / brightest);
}

void PixelGroup::run(const SampleContext& context, Counters& counters) {
  if (context.settings.reuse != ReuseStrategy::pixels) {
    for (std::size_t i = 0; i < size_; ++i) {
      if (Path* path = slots_[i]->path()) path->run();
    }
    return;
  }
  const Counters before = counters;
  std::array<Path*, kMostSharing> sharing;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    Path* const path = slots_[i]->path();
    if (!path) continue;
    path->run_until_offer();
    sharing[count++] = path;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (sharing[i]->offers() && sharing[i]->offer().at) sharing[i]->complete_offer();
  }
  Counters finding = counters.since(before);
  for (std::size_t i = 0; i < count; ++i) finding.leave_out(sharing[i]->work_for_outputs());
  const std::optional<bool> collisions_shared = context.budget ? context.budget->collisions_shared : std::nullopt;
  share_suffixes({context.world.built, context.settings.transmittance, counters}, {sharing.data(), count}, finding,
                 collisions_shared);
}

}  // namespace tyndall
