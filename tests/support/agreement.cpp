#include "support/agreement.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "report/block_test.h"
#include "support/sanitized.h"

namespace tyndall::test {
namespace {

constexpr double kErrors = 4;       // standard errors that a difference may have
constexpr double kResolution = 6.5;  // standard errors in d
constexpr std::array<const char*, 3> kChannel{"R", "G", "B"};

double budget(const Agreement& how) { return nightly() ? 40 * how.seconds : how.seconds; }

/// Factor by which the variance of a mean is above that of the wanted standard error.
double excess(const Estimate& e, double wanted_error) {
  return e.variance == 0 ? 0 : e.variance / (wanted_error * wanted_error);
}

void print(const std::string& name, const char* channel, double value, const WelchResult& w, const Measured& m) {
  const double off = w.difference / value, error = w.standard_error / std::abs(value);
  std::printf("  %-46s %s %-12.7g off by %+.3f %%, standard error %.3f %%, ", name.c_str(), channel, value, 100 * off, 100 * error);
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
  CHECK_MESSAGE(w.standard_error <= kCoarser * tolerance.d / kResolution * std::abs(value), name, ": not precise enough after ", m.seconds,
                " s and ", m.spp, " samples a pixel");
}

/// Until the image means have at most `share` of the variance that a comparison at d allows.
Measured measure_share(const std::string& name, const Contender& c, double share, const Agreement& how) {
  const double d = how.d.value_or(required_precision());
  Subject subject(c.scene, c.variant);
  const auto too_much = [&](const MeanImage& image) {
    double worst = 0;
    for (int k = 0; k < 3; ++k) {
      const Estimate e = image_mean(image, k);
      worst = std::max(worst, excess(e, d / kResolution * e.mean) / share);
    }
    return worst;
  };
  Measured measured = measure(subject, {.excess = too_much, .seconds = budget(how), .stream = stream_of(name + c.name)});
  check_faults(name + ", " + c.name, subject);
  std::printf("  %s, %s: %.3g spp, %.1f s\n", name.c_str(), c.name.c_str(), measured.spp, measured.seconds);
  std::fflush(stdout);
  return measured;
}

/// a + factor b, pixel by pixel.
Image combined(Image a, float factor, const Image& b) {
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    for (std::size_t i = 0; i < a.channels[k].values.size(); ++i) a.channels[k].values[i] += factor * b.channels[k].values[i];
  }
  return a;
}

MeanImage zero(MeanImage like) {
  for (auto& channel : like.channels) {
    for (Estimate& e : channel) e = {0, 0, 1};
  }
  return like;
}

/// Contenders rendered with the same seeds.
class PairedRenders {
 public:
  static constexpr int kSpp = 8, kFewest = 8, kMost = 2048;

  explicit PairedRenders(const std::vector<Contender>& contenders) : images_(contenders.size()), differences_(contenders.size()) {
    for (const Contender& c : contenders) subjects_.emplace_back(c.scene, c.variant);
    for (std::size_t j = 0; j < contenders.size(); ++j) differences_[j].resize(j);
  }

  void add(std::uint64_t seed) {
    std::vector<Image> images;
    for (std::size_t j = 0; j < subjects_.size(); ++j) {
      images.push_back(subjects_[j].render(kSpp, seed));
      images_[j].add(images[j]);
      for (std::size_t i = 0; i < j; ++i) differences_[j][i].add(combined(images[j], -1, images[i]));
    }
  }
  int count() const { return images_[0].count(); }
  const Subject& subject(std::size_t i) const { return subjects_[i]; }
  MeanImage image(std::size_t i) const { return images_[i].result(); }
  MeanImage difference_of(std::size_t j, std::size_t i) const { return differences_[j][i].result(); }

  bool known_to(double d) const {
    const MeanImage reference = image(0);
    for (std::size_t j = 1; j < subjects_.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const MeanImage pair = difference_of(j, i);
        for (int k = 0; k < 3; ++k) {
          if (excess(image_mean(pair, k), d / kResolution * image_mean(reference, k).mean) > 1) return false;
        }
      }
    }
    return true;
  }

 private:
  std::vector<Subject> subjects_;
  std::vector<MeanImageBuilder> images_;
  std::vector<std::vector<MeanImageBuilder>> differences_;  ///< [j][i]: j - i
};

/// Many variants rendered with the same seeds, round by round, each held against the mean of the others in its rounds. One
/// that is known well enough drops out; the first two stay to the end, so that there is always something to be held against.
class PooledRenders {
 public:
  static constexpr int kSpp = 8, kFewest = 8, kMost = 2048;
  static constexpr std::size_t kStay = 2;

  PooledRenders(const std::string& scene, const std::vector<std::pair<std::string, Variant>>& variants, std::uint64_t seed) : seed_(seed) {
    for (const auto& [title, variant] : variants) variants_.push_back({Subject(scene, variant)});
  }

  /// False: each is known so well that an error of d stands out, or has had its `seconds`, or there have been enough.
  bool next_round(double d, double seconds) {
    bool any = rounds_ < kFewest;
    for (VariantOfMany& v : variants_) {
      v.known = rounds_ >= kFewest && known_to(v, kCoarser * d);
      any = any || (!v.known && v.seconds < seconds);
    }
    if (!any || rounds_ >= kMost * (nightly() ? 16 : 1)) return false;
    render_round();
    return true;
  }

  const Subject& subject(std::size_t i) const { return variants_[i].subject; }
  /// From the mean of the others.
  MeanImage difference(std::size_t i) const { return variants_[i].difference.result(); }
  double pooled_mean(int channel) const { return image_mean(pool_.result(), channel).mean; }
  Measured effort(std::size_t i) const {
    Measured m;
    m.renders = variants_[i].difference.count();
    m.spp = double(m.renders) * kSpp;
    m.seconds = variants_[i].seconds;
    return m;
  }

 private:
  struct VariantOfMany {
    Subject subject;
    MeanImageBuilder difference{};
    bool known = false;
    double seconds = 0;
  };

  bool known_to(const VariantOfMany& v, double d) const {
    const MeanImage difference = v.difference.result();
    for (int k = 0; k < 3; ++k) {
      if (excess(image_mean(difference, k), d / kResolution * pooled_mean(k)) > 1) return false;
    }
    return true;
  }

  void render_round() {
    std::vector<std::pair<VariantOfMany*, Image>> images;
    for (std::size_t i = 0; i < variants_.size(); ++i) {
      VariantOfMany& v = variants_[i];
      if (v.known && i >= kStay) continue;
      const double start = processor_seconds();
      images.emplace_back(&v, v.subject.render(kSpp, seed_));
      v.seconds += processor_seconds() - start;
    }
    ++seed_;
    ++rounds_;
    Image sum = images[0].second;
    for (std::size_t i = 1; i < images.size(); ++i) sum = combined(std::move(sum), 1, images[i].second);
    const auto n = static_cast<float>(images.size());
    pool_.add(combined(sum, 1 / n - 1, sum));
    // x_i less the mean of the others: (n x_i - sum) / (n - 1).
    for (auto& [v, image] : images) {
      Image difference = combined(combined(image, n / (n - 1) - 1, image), -1 / (n - 1), sum);
      v->difference.add(difference);
    }
  }

  std::vector<VariantOfMany> variants_;
  MeanImageBuilder pool_;
  std::uint64_t seed_;
  int rounds_ = 0;
};

}  // namespace

namespace {

/// TYNDALL_ONLY=part_of_a_name picks one of the values that a test case compares, some of which take an hour each at night.
bool picked(const std::string& name) {
  const char* only = std::getenv("TYNDALL_ONLY");
  return only == nullptr || name.find(only) != std::string::npos;
}

}  // namespace

double required_precision() { return nightly() ? 0.003 : 0.01; }

Measured check_agrees(const std::string& name, const std::string& scene, const Expected& expected, const Agreement& how) {
  if (!picked(name)) return {};
  const double d = how.d.value_or(required_precision());
  Subject subject(scene, how.variant);
  const Measured m = measure(subject, {.excess = [&](const MeanImage& image) {
                                         double worst = 0;
                                         for (int k = 0; k < 3; ++k) {
                                           if (!expected[k]) continue;
                                           const double error = d / kResolution * std::abs(*expected[k]);
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
  const Measured m = measure(
      subject, {.excess = [&](const MeanImage& image) { return excess(image_mean(image, 0), bound / kErrors); },
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
      CHECK_MESSAGE(w.welch.p >= sidak(1e-3, pairs * double(blocks.size())), title, ": block ", w.x, ",", w.y,
                    " differs by ", w.welch.t, " standard errors");
    }
  }
}

void check_same_paired(const std::string& name, const std::vector<Contender>& contenders, const Agreement& how) {
  const double d = how.d.value_or(required_precision());
  PairedRenders renders(contenders);
  std::uint64_t seed = base_seed() * 10'000'000'000 + std::uint64_t(stream_of(name)) * 10'000;
  do {
    renders.add(seed++);
  } while (renders.count() < PairedRenders::kFewest ||
           (renders.count() < PairedRenders::kMost * (nightly() ? 16 : 1) && !renders.known_to(kCoarser * d)));

  const std::size_t n = contenders.size();
  const auto pairs = static_cast<double>(n * (n - 1) / 2);
  Measured effort;
  effort.renders = renders.count();
  effort.spp = double(renders.count()) * PairedRenders::kSpp;
  for (std::size_t j = 0; j < n; ++j) {
    check_faults(name + ", " + contenders[j].name, renders.subject(j));
    for (std::size_t i = 0; i < j; ++i) {
      const std::string title = name + ": " + contenders[j].name + " - " + contenders[i].name;
      const MeanImage difference = renders.difference_of(j, i), none = zero(difference), reference = renders.image(i);
      for (int k = 0; k < 3; ++k) {
        check_difference(title, k, image_mean(reference, k).mean, mean_test(difference, none, k), effort, {1.05 * d, 0});
      }
      const auto blocks = block_test(block_means(difference, 8), block_means(none, 8));
      const BlockDifference& w = worst(blocks);
      CHECK_MESSAGE(w.welch.p >= sidak(1e-3, pairs * double(blocks.size())), title, ": block ", w.x, ",", w.y,
                    " differs by ", w.welch.t, " standard errors");
    }
  }
}

void check_all_agree(const std::string& name, const std::string& scene,
                     const std::vector<std::pair<std::string, Variant>>& variants, const Agreement& how) {
  const double d = how.d.value_or(required_precision());
  PooledRenders renders(scene, variants, base_seed() * 10'000'000'000 + std::uint64_t(stream_of(name)) * 10'000);
  while (renders.next_round(d, budget(how))) {
  }
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const std::string title = name + ": " + variants[i].first;
    check_faults(title, renders.subject(i));
    const MeanImage difference = renders.difference(i), none = zero(difference);
    for (int k = 0; k < 3; ++k) {
      check_difference(title, k, renders.pooled_mean(k), mean_test(difference, none, k), renders.effort(i), {1.05 * d, 0});
    }
    const auto tests = block_test(block_means(difference, 8), block_means(none, 8));
    const BlockDifference& w = worst(tests);
    CHECK_MESSAGE(w.welch.p >= sidak(1e-3, double(variants.size()) * double(tests.size())), title, ": block ", w.x, ",", w.y,
                  " differs by ", w.welch.t, " standard errors");
  }
}

}  // namespace tyndall::test
