#include "report/image_test.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "report/cautious_blocks.h"
#include "support/relative.h"
#include "tyndall/error.h"

using namespace tyndall;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Noise {
  double sigma = 0.1;                           ///< of a pixel of two replicates
  std::function<double(int, int)> factor = {};  ///< on the pixel at x, y
};

/// Pixels of mean 1 with Gaussian noise, variance known from two replicates.
MeanImage noisy(int width, int height, const Noise& noise, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0, noise.sigma * std::sqrt(2.0));
  MeanImage image{width, height, {}};
  for (auto& channel : image.channels) {
    for (int i = 0; i < width * height; ++i) {
      const double mean = noise.factor ? noise.factor(i % width, i / width) : 1;
      const double a = mean + normal(engine), b = mean + normal(engine);
      channel.push_back({(a + b) / 2, (a - b) * (a - b) / 4, 1});
    }
  }
  return image;
}

/// A third of the pixels of column 8, a silhouette, are hit or miss: each replicate sees 0 or 1 with equal chance.
MeanImage silhouette(std::uint64_t seed) {
  MeanImage image = noisy(32, 32, {.sigma = 1e-4}, seed);
  std::mt19937_64 engine(~seed);
  for (int y = 0; y < 32; y += 3) {
    for (int k = 0; k < 3; ++k) {
      const double a = double(engine() & 1), b = double(engine() & 1);
      image.channels[k][static_cast<std::size_t>(y * 32 + 8)] = {(a + b) / 2, (a - b) * (a - b) / 4, 1};
    }
  }
  return image;
}

int alarms_of_silhouettes(bool cautious) {
  int alarms = 0;
  for (int i = 0; i < 200; ++i) {
    for (const CautiousBlock& b : cautious_block_test(silhouette(2 * i), silhouette(2 * i + 1), 8)) {
      alarms += (cautious ? b.difference.welch.p : b.plain_p) < 1e-6;
    }
  }
  return alarms;
}

}  // namespace

TEST_CASE("two renders of one picture are the same, and so is one with itself") {
  const MeanImage a = noisy(64, 48, {}, 1), b = noisy(64, 48, {}, 2);
  const ImageTest test = test_images(a, b);
  CHECK_MESSAGE(test.same, test.verdict);
  CHECK(test.blocks == 3 * 48);
  CHECK(test.alarms == 0);
  CHECK(test.block_level == test::relative(sidak(1e-3 / 3, 144)));
  CHECK(test_images(a, a).same);
}

TEST_CASE("each part finds what it is there for") {
  const MeanImage reference = noisy(128, 128, {}, 10);

  const ImageTest block =
      test_images(noisy(128, 128, {.factor = [](int x, int y) { return x / 8 == 5 && y / 8 == 3 ? 1.12 : 1; }}, 11), reference);
  CHECK(!block.same);
  CHECK(block.alarms == 3);
  CHECK(block.worst_block.x == 5);
  CHECK(block.worst_block.y == 3);

  // 0.8 %: seven standard errors of the mean of the picture, less than half of one of a block.
  const ImageTest mean = test_images(noisy(128, 128, {.factor = [](int, int) { return 1.008; }}, 12), reference);
  CHECK(!mean.same);
  CHECK(mean.alarms == 0);
  CHECK(mean.means[1].p < mean.mean_level);
  CHECK(mean.relative_bias[1] == test::relative(0.008).epsilon(0.4));
  CHECK(mean.relative_error[1] == test::relative(0.1 * std::sqrt(2.0) / 128).epsilon(0.05));

  // One block up, the next down, by 1.2 standard errors.
  const ImageTest many = test_images(
      noisy(128, 128, {.factor = [](int x, int y) { return 1 + 0.022 * ((x / 8 + y / 8) % 2 ? 1 : -1); }}, 13), reference);
  CHECK(!many.same);
  CHECK(many.means[0].p > many.mean_level);
  CHECK(many.uniformity_p[0] < many.uniformity_level);
}

TEST_CASE("a silhouette that is hit or miss: Welch's test alone raises alarms, the cautious one none") {
  CHECK(alarms_of_silhouettes(false) > 25);  // 52 of 9,600 blocks
  CHECK(alarms_of_silhouettes(true) == 0);
}

TEST_CASE("noise of a few pixels a block makes p-values that are not uniform, and no alarm") {
  const auto sparse = [](std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    MeanImage image{512, 512, {}};
    for (auto& channel : image.channels) {
      for (int i = 0; i < 512 * 512; ++i) {
        const double a = engine() % 100 == 0, b = engine() % 100 == 0;
        channel.push_back({(a + b) / 2, (a - b) * (a - b) / 4, 1});
      }
    }
    return image;
  };
  const ImageTest test = test_images(sparse(1), sparse(2));
  CHECK_MESSAGE(test.same, test.verdict);
}

TEST_CASE("fireflies raise no alarm") {
  int alarms = 0;
  for (int i = 0; i < 200; ++i) {
    std::array<MeanImage, 2> pair;
    for (int j = 0; j < 2; ++j) {
      pair[j] = noisy(32, 32, {}, 1000 + 2 * i + j);
      std::mt19937_64 engine(2000 + 2 * i + j);
      for (auto& channel : pair[j].channels) {
        for (Estimate& e : channel) {
          if (engine() % 500 == 0) e = {e.mean + 50, 2500, 1};  // one sample of one replicate
        }
      }
    }
    alarms += !test_images(pair[0], pair[1]).same;
  }
  CHECK(alarms <= 3);  // of 200 at 1e-3: more has a chance of 6e-5
}

TEST_CASE("noiseless parts: black in both says nothing, a difference is one") {
  MeanImage a = noisy(32, 32, {}, 1), b = noisy(32, 32, {}, 2);
  for (MeanImage* image : {&a, &b}) {
    for (auto& channel : image->channels) {
      for (int i = 0; i < 16 * 32; ++i) channel[static_cast<std::size_t>(i)] = {0, 0, 1};
    }
  }
  CHECK(test_images(a, b).same);
  CHECK(test_images(a, b).blocks == 3 * 8);

  MeanImage exact{16, 16, {}}, other{16, 16, {}};
  for (int k = 0; k < 3; ++k) {
    exact.channels[k].assign(256, {1, 0, kInfinite});
    other.channels[k].assign(256, {1 + 1e-7, 0, kInfinite});
  }
  CHECK(test_images(exact, other).same);
  other.channels[2][17].mean = 1.01;
  CHECK(!test_images(exact, other).same);
}

TEST_CASE("values that are no numbers differ, whichever side they are on") {
  const MeanImage good = noisy(16, 16, {}, 1);
  for (const double bad : {std::nan(""), kInfinite}) {
    MeanImage mean = good, variance = good;
    mean.channels[1][40].mean = bad;
    variance.channels[2][41].variance = bad;
    for (const MeanImage* image : {&mean, &variance}) {
      CHECK(!test_images(*image, good).same);
      CHECK(!test_images(good, *image).same);
      CHECK(!test_images(*image, *image).same);
      CHECK(test_images(*image, good).non_finite == 1);
    }
  }
}

TEST_CASE("what cannot be tested is refused; odd sizes can") {
  const MeanImage a = noisy(16, 16, {}, 1);
  CHECK_THROWS_AS(test_images(a, noisy(16, 15, {}, 2)), Error);
  CHECK_THROWS_AS(test_images(a, a, {.family_level = 0}), Error);
  CHECK_THROWS_AS(test_images(a, a, {.family_level = 1}), Error);
  CHECK_THROWS_AS(test_images(a, a, {.block_size = 0}), Error);
  CHECK(test_images(noisy(13, 9, {}, 1), noisy(13, 9, {}, 2)).blocks == 3 * 4);
  CHECK(test_images(noisy(1, 1, {}, 1), noisy(1, 1, {}, 2)).same);
}
