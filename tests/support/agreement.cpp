#include "support/agreement.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "report/block_test.h"
#include "support/pooled_renders.h"
#include "support/sanitized.h"

namespace tyndall::test {
namespace {

constexpr double kErrors = 4;  // standard errors that a difference may have
constexpr std::array<const char*, 3> kChannel{"R", "G", "B"};

/// Standard errors in d: a difference of d is found with a power of 0.95, nightly of 0.994.
double resolution() { return nightly() ? 6.5 : 5.65; }

double budget(const Agreement& how) { return nightly() ? 40 * how.seconds : how.seconds; }

/// Factor by which the variance of a mean is above that of the wanted standard error.
double excess(const Estimate& e, double wanted_error) {
  return e.variance == 0 ? 0 : e.variance / (wanted_error * wanted_error);
}

void print(const std::string& name, const char* channel, double value, const WelchResult& w, const Measured& m) {
  const double off = w.difference / value, error = w.standard_error / std::abs(value);
  std::printf("  %-46s %s %-12.7g off by %+.3f %%, standard error %.3f %%, ", name.c_str(), channel, value, 100 * off,
              100 * error);
  if (error < 1e-5) {
    std::printf("z none ");
  } else {
    std::printf("z %+.2f", off / error);
  }
  std::printf("  (%.3g spp in %d, %.1f s)\n", m.spp, m.renders, m.seconds);
  std::fflush(stdout);
}

struct Tolerance {
  double d, rounding;
};

void check_faults(const std::string& name, const Subject& subject) {
  CHECK_MESSAGE(subject.faults().empty(), name, ": ", subject.faults());
}

void check_difference(const std::string& name, int channel, double value, const WelchResult& w, const Measured& m,
                      Tolerance tolerance) {
  print(name, kChannel[channel], value, w, m);
  CAPTURE(name);
  CAPTURE(std::string(kChannel[channel]));
  // A difference of the last bits of a float is none.
  const double exempt = std::max(tolerance.rounding, 1e-5 * std::abs(value));
  const bool within = std::abs(w.difference) <= kErrors * w.standard_error + exempt;
  CHECK_MESSAGE(within, name, " ", std::string(kChannel[channel]), ": ", value + w.difference, " instead of ", value, ", ", w.t,
                " standard errors");
  CHECK_MESSAGE(w.standard_error <= kCoarser * tolerance.d / resolution() * std::abs(value), name,
                ": not precise enough after ", m.seconds, " s and ", m.spp, " samples a pixel");
}

/// Until the image means have at most `share` of the variance that a comparison at d allows.
Measured measure_share(const std::string& name, const Contender& c, double share, const Agreement& how) {
  const double d = how.d.value_or(required_precision());
  Subject subject(c.scene, c.variant);
  const auto too_much = [&](const MeanImage& image) {
    double worst = 0;
    for (int k = 0; k < 3; ++k) {
      const Estimate e = image_mean(image, k);
      worst = std::max(worst, excess(e, d / resolution() * e.mean) / share);
    }
    return worst;
  };
  Measured measured = measure(subject, {.excess = too_much, .seconds = budget(how), .stream = stream_of(name + c.name)});
  check_faults(name + ", " + c.name, subject);
  std::printf("  %s, %s: %.3g spp, %.1f s\n", name.c_str(), c.name.c_str(), measured.spp, measured.seconds);
  std::fflush(stdout);
  return measured;
}

MeanImage zero(MeanImage like) {
  for (auto& channel : like.channels) {
    for (Estimate& e : channel) e = {0, 0, 1};
  }
  return like;
}

/// TYNDALL_ONLY=part_of_a_name picks one of the values that a test case compares, some of which take an hour each at night.
bool picked(const std::string& name) {
  const char* only = std::getenv("TYNDALL_ONLY");
  return only == nullptr || name.find(only) != std::string::npos;
}

}  // namespace

double required_precision() { return nightly() ? 0.003 : 0.01; }

double pairwise_precision(std::size_t contenders) {
  const auto n = static_cast<double>(contenders);
  return required_precision() * n / (2 * (n - 1));
}

Measured check_agrees(const std::string& name, const std::string& scene, const Expected& expected, const Agreement& how) {
  if (!picked(name)) return {};
  const double d = how.d.value_or(required_precision());
  Subject subject(scene, how.variant);
  const Measured m = measure(subject, {.excess =
                                           [&](const MeanImage& image) {
                                             double worst = 0;
                                             for (int k = 0; k < 3; ++k) {
                                               if (!expected[k]) continue;
                                               const double error = d / resolution() * std::abs(*expected[k]);
                                               worst = std::max(worst, excess(image_mean(image, k), error));
                                             }
                                             return worst;
                                           },
                                       .seconds = budget(how),
                                       .stream = stream_of(name)});
  for (int k = 0; k < 3; ++k) {
    if (!expected[k]) continue;
    const Estimate exact{*expected[k], 0, 1};
    check_difference(name, k, *expected[k], welch_test(image_mean(m.image, k), exact), m, {d, how.rounding});
  }
  check_faults(name, subject);
  return m;
}

void check_vanishes(const std::string& name, const std::string& scene, double bound, const Agreement& how) {
  if (!picked(name)) return;
  Subject subject(scene, how.variant);
  const Measured m =
      measure(subject, {.excess = [&](const MeanImage& image) { return excess(image_mean(image, 0), bound / kErrors); },
                        .seconds = budget(how),
                        .stream = stream_of(name)});
  const Estimate e = image_mean(m.image, 0);
  std::printf("  %-44s   %.3g +- %.3g, bound %.3g  (%.3g spp, %.1f s)\n", name.c_str(), e.mean, e.standard_error(), bound,
              m.spp, m.seconds);
  CHECK_MESSAGE(std::abs(e.mean) <= bound + kErrors * e.standard_error(), name);
  CHECK_MESSAGE(e.standard_error() <= kCoarser * bound / kErrors, name, ": not precise enough");
  check_faults(name, subject);
}

void check_same(const std::string& name, const std::vector<Contender>& contenders, const Agreement& how) {
  const double d = how.d.value_or(required_precision());
  std::vector<Measured> measured;
  for (const Contender& c : contenders) measured.push_back(measure_share(name, c, 0.5, how));

  const std::size_t n = contenders.size();
  const auto pairs = static_cast<double>(n * (n - 1) / 2);
  for (std::size_t j = 1; j < n; ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const std::string title = name + ": " + contenders[j].name + " - " + contenders[i].name;
      for (int k = 0; k < 3; ++k) {
        const Estimate a = image_mean(measured[j].image, k), b = image_mean(measured[i].image, k);
        check_difference(title, k, b.mean, welch_test(a, b), measured[j], {1.05 * d, 0});  // both errors are estimates
      }
      const auto blocks = block_test(block_means(measured[j].image, 8), block_means(measured[i].image, 8));
      const BlockDifference& w = worst(blocks);
      CHECK_MESSAGE(w.welch.p >= sidak(1e-3, pairs * double(blocks.size())), title, ": block ", w.x, ",", w.y, " differs by ",
                    w.welch.t, " standard errors");
    }
  }
}

void check_all_agree(const std::string& name, const std::vector<Contender>& contenders, const Agreement& how) {
  const double d = how.d.value_or(required_precision());
  PooledRenders renders(contenders, base_seed() * 10'000'000'000 + std::uint64_t(stream_of(name)) * 10'000);
  const auto too_much = [&](const MeanImage& difference) {
    double worst = 0;
    for (int k = 0; k < 3; ++k) {
      const double wanted_error = kCoarser * d / resolution() * renders.pooled_mean(k);
      worst = std::max(worst, excess(image_mean(difference, k), wanted_error));
    }
    return worst;
  };
  while (renders.next_round(too_much, budget(how))) {
  }
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const std::string title = name + ": " + contenders[i].name;
    check_faults(title, renders.subject(i));
    const MeanImage difference = renders.difference(i), none = zero(difference);
    for (int k = 0; k < 3; ++k) {
      check_difference(title, k, renders.pooled_mean(k), mean_test(difference, none, k), renders.effort(i), {1.05 * d, 0});
    }
    const auto tests = block_test(block_means(difference, 8), block_means(none, 8));
    const BlockDifference& w = worst(tests);
    CHECK_MESSAGE(w.welch.p >= sidak(1e-3, double(contenders.size()) * double(tests.size())), title, ": block ", w.x, ",", w.y,
                  " differs by ", w.welch.t, " standard errors");
  }
}

void check_all_agree(const std::string& name, const std::string& scene,
                     const std::vector<std::pair<std::string, Variant>>& variants, const Agreement& how) {
  std::vector<Contender> contenders;
  for (const auto& [title, variant] : variants) contenders.push_back({title, scene, variant});
  check_all_agree(name, contenders, how);
}

}  // namespace tyndall::test
