/// Several overlapping media along one ray.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "volume/medium.h"
#include "volume/medium_walk.h"
#include "volume/tracking.h"

namespace tyndall {

/// The pieces of each medium, cut where any of them ends; rates, controls and coefficients add. Same interface as
/// MediumWalk. Allocates only for more than kInline media.
template <WalkMode Mode>
class MergedWalk {
 public:
  MergedWalk(MediaView media, const Ray& ray, double t0, double t1) : count_(media.size()), t_(t0), t_end_(t0), limit_(t1) {
    walks_ = reinterpret_cast<MediumWalk<Mode>*>(inline_);
    if (count_ > kInline) {
      heap_ = std::make_unique<std::byte[]>(count_ * sizeof(MediumWalk<Mode>));
      walks_ = reinterpret_cast<MediumWalk<Mode>*>(heap_.get());
    }
    for (std::size_t i = 0; i < count_; ++i) std::construct_at(walks_ + i, media[i]->data(), ray, t0, t1);
  }
  MergedWalk(const MergedWalk&) = delete;
  MergedWalk& operator=(const MergedWalk&) = delete;

  bool next() {
    t_ = t_end_;
    if (t_ >= limit_) return false;
    t_end_ = limit_;
    rate_ = 0;
    control_ = {};
    for (std::size_t i = 0; i < count_; ++i) {
      MediumWalk<Mode>& walk = walks_[i];
      while (walk.t_end() <= t_ && walk.next()) ++steps_;
      t_end_ = std::min(t_end_, walk.t_end());
      rate_ += walk.rate();
      control_ += walk.control();
    }
    return true;
  }

  double t() const { return t_; }
  double t_end() const { return t_end_; }
  float rate() const { return rate_; }
  Rgb control() const { return control_; }
  std::uint64_t steps() const { return steps_; }
  std::uint64_t noise_lookups() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count_; ++i) sum += walks_[i].noise_lookups();
    return sum;
  }
  bool capped() const {
    for (std::size_t i = 0; i < count_; ++i)
      if (walks_[i].capped()) return true;
    return false;
  }

  LocalOptics optics_at(double t, bool with_emission) {
    LocalOptics sum;
    for (std::size_t i = 0; i < count_; ++i) {
      if (walks_[i].rate() == 0) continue;
      const LocalOptics one = walks_[i].optics_at(t, with_emission);
      sum.sigma_a += one.sigma_a;
      sum.sigma_s += one.sigma_s;
      sum.emission += one.emission;
    }
    return sum;
  }
  Rgb excess_at(double t) {
    Rgb sum;
    for (std::size_t i = 0; i < count_; ++i)
      if (walks_[i].rate() > 0) sum += walks_[i].excess_at(t);
    return sum;
  }
  ExcessSum excess_at(const Teeth& teeth) {
    ExcessSum sum;
    for (std::size_t i = 0; i < count_; ++i) {
      if (!(walks_[i].rate() > 0)) continue;
      const ExcessSum one = walks_[i].excess_at(teeth);
      sum.sum += one.sum;
      sum.largest += one.largest;
    }
    return sum;
  }
  bool is_cubic() {
    bool all = true;
    for (std::size_t i = 0; i < count_; ++i) all = all && (walks_[i].rate() == 0 || walks_[i].is_cubic());
    return all;
  }
  double next_face(double t) const {
    double first = kInfinity;
    for (std::size_t i = 0; i < count_; ++i)
      if (walks_[i].rate() > 0) first = std::min(first, walks_[i].next_face(t));
    return first;
  }
  bool scatters() const {
    bool any = false;
    for (std::size_t i = 0; i < count_; ++i) any = any || (walks_[i].rate() > 0 && walks_[i].scatters());
    return any;
  }
  void add_phase(PhaseMix& phase) const {
    for (std::size_t i = 0; i < count_; ++i)
      if (walks_[i].rate() > 0) walks_[i].add_phase(phase);
  }

 private:
  static constexpr std::size_t kInline = 4;
  static_assert(std::is_trivially_destructible_v<MediumWalk<Mode>>);

  std::size_t count_;
  MediumWalk<Mode>* walks_;
  double t_, t_end_, limit_;
  float rate_ = 0;
  Rgb control_;
  std::uint64_t steps_ = 0;
  std::unique_ptr<std::byte[]> heap_;
  alignas(MediumWalk<Mode>) std::byte inline_[kInline * sizeof(MediumWalk<Mode>)];
};

/// What a walk of rate `rate` meets at a tentative collision; counted.
template <typename Walk>
LocalOptics looked_up(Walk& walk, double t, bool emission, float rate, TrackingStats& stats) {
  const LocalOptics at = walk.optics_at(t, emission);
  kernel::count_lookup(max_component(at.sigma_t()), rate, stats);
  return at;
}

/// What body(walk) gives with the walk that suits `media`, which must not be empty; its steps are counted.
template <WalkMode Mode, typename Body>
auto with_walk(MediaView media, const Ray& ray, double t0, double t1, TrackingStats& stats, const Body& body) {
  const auto counted = [&](auto&& walk) {
    const auto result = body(walk);
    stats.segments += walk.steps();
    stats.noise_lookups += walk.noise_lookups();
    if (walk.capped()) ++stats.caps_hit;
    return result;
  };
  if (media.size() == 1) return counted(MediumWalk<Mode>(media[0]->data(), ray, t0, t1));
  return counted(MergedWalk<Mode>(media, ray, t0, t1));
}

}  // namespace tyndall
