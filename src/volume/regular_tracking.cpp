#include "volume/regular_tracking.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "volume/delta_tracking.h"
#include "volume/homogeneous.h"
#include "volume/merged_walk.h"
#include "volume/tracking_kernel.h"

namespace tyndall {
namespace {

using namespace kernel;

/// Of one flight that are gone through one by one; what lies behind them is left to delta tracking.
constexpr int kMostCells = 512;

/// sigma_t along one cell, x in [0, 1]: of the trilinear interpolant a cubic polynomial.
class CellExtinction {
 public:
  template <typename Read>
  CellExtinction(double length, const Read& read) : length_(length) {
    Rgb f[4];
    for (int i = 0; i < 4; ++i) f[i] = read(i / 3.0);
    c_[0] = f[0];
    c_[1] = f[0] * -5.5f + f[1] * 9.0f + f[2] * -4.5f + f[3];
    c_[2] = f[0] * 9.0f + f[1] * -22.5f + f[2] * 18.0f + f[3] * -4.5f;
    c_[3] = (f[3] - f[0]) * 4.5f + (f[1] - f[2]) * 13.5f;
  }

  double at(double x, int c) const { return c_[0][c] + x * (c_[1][c] + x * (c_[2][c] + x * double{c_[3][c]})); }
  /// Integral from 0 to x.
  double depth(double x, int c) const {
    return length_ * x * (c_[0][c] + x * (c_[1][c] / 2.0 + x * (c_[2][c] / 3.0 + x * c_[3][c] / 4.0)));
  }
  /// x at which that is `depth`, or an end: Newton's steps, halves where these lead out of where it must be.
  double where(double depth, int c) const {
    double low = 0, high = 1, x = 0.5;
    for (int i = 0; i < kSteps; ++i) {
      const double beyond = this->depth(x, c) - depth;
      (beyond < 0 ? low : high) = x;
      const double next = x - beyond / (length_ * at(x, c));
      const double before = std::exchange(x, next > low && next < high ? next : 0.5 * (low + high));
      if (std::abs(x - before) < kPrecise) break;
    }
    return x;
  }

 private:
  static constexpr int kSteps = 40;
  static constexpr double kPrecise = 1e-9;
  double length_;
  Rgb c_[4];
};

/// A flight is over at the first of two independent collisions: one where the optical depth of a channel reaches a given one,
/// in pieces that are gone through cell by cell; and one by delta tracking in all others. The channel is chosen by throughput;
/// which it was makes no difference, as weights are those of the density over all of them [Wilkie et al. 2014].
template <typename Walk>
class RegularFlight {
 public:
  RegularFlight(Walk& walk, FlightState& state, Rng& rng, TrackingStats& stats)
      : walk_(walk), state_(state), rng_(rng), stats_(stats) {}

  void run() {
    choose_channel();
    while (walk_.next()) {
      if (!(walk_.rate() > 0)) continue;
      const bool regular =
          walk_.rate() * (walk_.t_end() - walk_.t()) > kLeastRegular && cells_ < kMostCells && walk_.is_cubic();
      if (regular ? pass_cells() : pass_by_chance()) return;
    }
    settle();
    state_.flight.u_next = uniform_of(state_.depth);
  }

 private:
  void choose_channel() {
    chance_ = normalised(absolute(state_.beta * state_.flight.weight));
    chance_ *= 1 / sum(chance_);
    const float u = rng_.uniform();
    channel_ = u < chance_.r ? 0 : u < chance_.r + chance_.g || chance_.b == 0 ? 1 : 2;
  }
  /// The cells that were passed weigh what they let through, over the chance of it.
  void settle() {
    const Rgb T = exp(depth_ * -1.0f);
    state_.flight.weight *= T * (1 / sum(chance_ * T));
    state_.depth = std::max(0.0f, state_.depth - depth_[channel_]);
    depth_ = {};
  }
  Rgb sigma_t(double t) { return looked_up(walk_, t, false, walk_.rate(), stats_).sigma_t(); }

  /// True: collided.
  bool pass_cells() {
    const double end = walk_.t_end();
    for (double t = walk_.t(); t < end; ++cells_) {
      const double next = std::min(walk_.next_face(t), end);
      if (next < kInfinity ? pass_cell(t, next) : pass_endless(t)) return true;
      t = next;
    }
    return false;
  }
  /// Where nothing changes any more.
  bool pass_endless(double t) {
    const Rgb sigma = sigma_t(t);
    if (!walk_.scatters()) return absorb(depth_of(sigma, kInfinity));
    const bool collides = sigma[channel_] > 0;
    const double length = collides ? (double{state_.depth} - depth_[channel_]) / sigma[channel_] : double{kInfinity};
    depth_ += depth_of(sigma, length);
    if (collides) end_at(t + length);
    return collides;
  }
  bool pass_cell(double t, double next) {
    constexpr double kGauss = 0.21132486540518713;  // two points integrate cubic polynomials exactly
    const double length = next - t;
    const Rgb depth = (sigma_t(t + kGauss * length) + sigma_t(next - kGauss * length)) * static_cast<float>(0.5 * length);
    if (!walk_.scatters()) return absorb(depth);
    if (depth_[channel_] + depth[channel_] < state_.depth) {
      depth_ += depth;
      return false;
    }
    const CellExtinction cell(length, [&](double x) { return sigma_t(t + x * length); });
    const double x = cell.where(double{state_.depth} - depth_[channel_], channel_);
    for (int c = 0; c < 3; ++c) depth_[c] += static_cast<float>(cell.depth(x, c));
    end_at(t + x * length);
    return true;
  }
  /// A collision would only end the path. True: nothing is left.
  bool absorb(Rgb depth) {
    state_.flight.weight *= exp(depth * -1.0f);
    return is_black(state_.flight.weight);
  }
  void end_at(double t) {
    Flight& flight = state_.flight;
    const LocalOptics at = looked_up(walk_, t, false, walk_.rate(), stats_);
    const Rgb T = exp(depth_ * -1.0f);
    const float density = sum(chance_ * at.sigma_t() * T);
    flight.weight *= density > 0 ? at.sigma_s * T * (1 / density) : Rgb();
    flight.collided = true;
    flight.t = static_cast<float>(t);
    if (!is_black(flight.weight)) walk_.add_phase(flight.phase);
  }

  bool pass_by_chance() {
    settle();
    float depth = exponential(rng_);
    if (fly_through(walk_, depth, state_, rng_, stats_) || is_black(state_.flight.weight)) return true;
    choose_channel();
    return false;
  }

  Walk& walk_;
  FlightState& state_;
  Rng& rng_;
  TrackingStats& stats_;
  Rgb chance_;  ///< of each channel
  int channel_, cells_ = 0;
  Rgb depth_;  ///< of the cells that were passed since
};

/// Of noise, not of cells.
bool is_procedural(const ParticipatingMedium* medium) { return medium->data().kind == MediumData::Kind::cloud; }

}  // namespace

// NOLINTNEXTLINE(readability-function-size): as free_flight
Flight regular_flight(MediaView media, const Ray& ray, float t0, float t1, Rgb beta, float u_first, Rng& rng,
                      TrackingStats& stats) {
  if (all_homogeneous(media) || std::ranges::any_of(media, is_procedural))
    return free_flight(media, ray, t0, t1, beta, u_first, rng, stats);
  FlightState state(beta, t1, u_first);
  if (!(t0 < t1) || is_black(state.beta)) return state.flight;
  state.depth = exponential(u_first);
  return with_walk<WalkMode::regular>(media, ray, t0, t1, stats, [&](auto& walk) {
    RegularFlight(walk, state, rng, stats).run();
    return state.flight;
  });
}

}  // namespace tyndall
