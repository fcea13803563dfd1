/// What one thread counts while it renders.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "tyndall/render.h"
#include "volume/tracking.h"

namespace tyndall {

inline constexpr std::size_t kBadSamplesKept = 16;

struct Counters {
  std::uint64_t choices = 0;      ///< among lights, at vertices
  std::uint64_t candidates = 0;   ///< lights drawn for them
  std::uint64_t segments = 0;     ///< that lights are sought along
  std::uint64_t places = 0;       ///< along them, of a light each, that are evaluated
  std::uint64_t connections = 0;  ///< of a path with what another has found that are asked for
  std::uint64_t guided = 0;       ///< vertices that directions are guided at
  std::uint64_t paths = 0, rays = 0, shadow_rays = 0, non_finite = 0, parity_errors = 0;
  TrackingStats tracking;
  std::vector<BadSample> bad_samples;

  /// Keep the first few in the order of samples and pixels, whichever thread found them when.
  void trim_bad_samples() {
    const auto order = [](const BadSample& s) { return std::tuple(s.sample, s.y, s.x); };
    std::sort(bad_samples.begin(), bad_samples.end(),
              [&](const BadSample& a, const BadSample& b) { return order(a) < order(b); });
    if (bad_samples.size() > kBadSamplesKept) bad_samples.resize(kBadSamplesKept);
  }

  /// All numbers of `c`, in the order of checkpoints.
  template <typename C>
  static auto numbers_of(C& c) {
    auto& t = c.tracking;
    return std::tie(c.paths, c.rays, c.shadow_rays, c.choices, c.candidates, c.segments, c.places, c.connections, c.guided,
                    c.non_finite, c.parity_errors, t.lookups, t.noise_lookups, t.segments, t.majorant_violations, t.caps_hit);
  }

  Counters& operator+=(const Counters& other) {
    combine(other, [](auto& sum, auto number) { sum += number; });
    bad_samples.insert(bad_samples.end(), other.bad_samples.begin(), other.bad_samples.end());
    if (!other.bad_samples.empty()) trim_bad_samples();
    return *this;
  }

  /// The numbers counted since these were `before`.
  Counters since(const Counters& before) const {
    Counters result;
    result.combine(*this, [](auto& all, auto number) { all = number; });
    result.leave_out(before);
    return result;
  }
  /// Numbers alone.
  void leave_out(const Counters& part) {
    combine(part, [](auto& all, auto number) { all -= number; });
  }

 private:
  template <typename F>
  void combine(const Counters& other, const F& f) {
    const auto each = [&](auto&... mine) {
      std::apply([&](const auto&... theirs) { (f(mine, theirs), ...); }, numbers_of(other));
    };
    std::apply(each, numbers_of(*this));
  }
};

}  // namespace tyndall
