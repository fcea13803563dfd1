#include "report/block_test.h"

#include <doctest/doctest.h>

#include <random>

#include "support/relative.h"
#include "tyndall/error.h"

using namespace tyndall;

namespace {

/// A picture of a gradient with noise of `sigma` a pixel; one 8x8 block is off by the factor `fault`.
Image noisy_picture(int size, double sigma, double fault, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Image image;
  image.data = image.display = {0, 0, size, size};
  for (const char* name : {"R", "G", "B"}) {
    Channel& channel = image.add_channel(name);
    for (int i = 0; i < size * size; ++i) {
      const int x = i % size, y = i / size;
      const bool faulty = x / 8 == 2 && y / 8 == 1;
      channel.values[i] = static_cast<float>((1 + 0.02 * x) * (faulty ? fault : 1) + sigma * normal(engine));
    }
  }
  return image;
}

MeanImage measure(int renders, double sigma, double fault, std::uint64_t seed) {
  MeanImageBuilder builder;
  for (int i = 0; i < renders; ++i) builder.add(noisy_picture(32, sigma, fault, seed + i));
  return builder.result();
}

}  // namespace

TEST_CASE("block means keep the mean and divide the variance") {
  const MeanImage pixels = measure(4, 0.3, 1, 10);
  const MeanImage blocks = block_means(pixels, 8);
  CHECK(blocks.width == 4);
  CHECK(blocks.height == 4);
  for (int k = 0; k < 3; ++k) {
    const Estimate of_pixels = image_mean(pixels, k), of_blocks = image_mean(blocks, k);
    CHECK(of_pixels.mean == doctest::Approx(of_blocks.mean));
    CHECK(of_pixels.variance == test::relative(of_blocks.variance));
    CHECK(of_pixels.dof == doctest::Approx(3 * 1024).epsilon(0.15));
    CHECK(of_pixels.standard_error() == test::relative(0.3 / std::sqrt(4 * 1024.0)).epsilon(0.05));
  }
  CHECK(block_means(pixels, 5).width == 7);
}

// Of n pixels that are all the same a sum has n times the variance of independent ones.
TEST_CASE("what pixels share is in the variances of blocks and of the picture, once") {
  MeanImage pixels = measure(4, 0.3, 1, 10);
  const MeanImage apart = block_means(pixels, 8);
  pixels.sharing = 16;
  const MeanImage shared = block_means(pixels, 8);
  CHECK(shared.at(1, 2, 0).variance == test::relative(16 * apart.at(1, 2, 0).variance));
  CHECK(image_mean(shared, 1).variance == test::relative(16 * image_mean(apart, 1).variance));
  CHECK(image_mean(pixels, 1).variance == test::relative(16 * image_mean(apart, 1).variance));
  CHECK(block_means(pixels, 2).at(0, 0, 0).variance ==
        test::relative(4 * block_means(measure(4, 0.3, 1, 10), 2).at(0, 0, 0).variance));

  Image image = noisy_picture(16, 0.1, 1, 1);
  CHECK(sharing_of(image) == 1);
  image.attributes["tyndall/sharing"] = 16;
  CHECK(sharing_of(image) == 16);
}

TEST_CASE("two renders of one picture agree; a block off by a standard deviation of a pixel is found, and named") {
  const MeanImage reference = block_means(measure(4, 0.1, 1, 100), 8);
  const double level = sidak(1e-3, 48);
  CHECK(count_below(block_test(block_means(measure(4, 0.1, 1, 200), 8), reference), level) == 0);

  const auto differences = block_test(block_means(measure(4, 0.1, 1.06, 300), 8), reference);
  CHECK(differences.size() == 48);
  CHECK(count_below(differences, level) == 3);
  CHECK(worst(differences).x == 2);
  CHECK(worst(differences).y == 1);
  CHECK(worst(differences).welch.difference == doctest::Approx(0.06 * 1.39).epsilon(0.3));
}

TEST_CASE("the mean test sees a bias of the whole picture") {
  const MeanImage a = measure(4, 0.1, 1, 1), b = measure(4, 0.1, 1, 5);
  CHECK(mean_test(a, b, 0).p > 1e-4);
  MeanImage biased = b;
  for (Estimate& e : biased.channels[1]) e.mean *= 1.01;
  CHECK(mean_test(a, biased, 1).p < 1e-4);
}

TEST_CASE("noiseless pictures agree but for rounding") {
  const MeanImage a = measure(2, 0, 1, 1);
  MeanImage rounded = a, off = a;
  for (Estimate& e : rounded.channels[0]) e.mean *= 1 + 1e-7;
  for (Estimate& e : off.channels[0]) e.mean *= 1.001;
  CHECK(count_below(block_test(a, rounded), 1e-4) == 0);
  CHECK(count_below(block_test(a, off), 1e-2) == 1024);
}

TEST_CASE("errors of a picture come from its own channels, and what is missing is said") {
  Image image = noisy_picture(16, 0.1, 1, 1);
  CHECK_THROWS_AS(mean_image(image, 1), Error);
  for (const char* name : {"Variance.R", "Variance.G", "Variance.B"}) {
    for (float& v : image.add_channel(name).values) v = 0.01f;
  }
  CHECK(mean_image(image, 1).at(3, 4, 2).variance == doctest::Approx(0.01));
  CHECK(mean_image(image, 1).at(3, 4, 2).dof == 1);

  MeanImageBuilder builder;
  builder.add(image);
  CHECK_THROWS_AS(builder.add(noisy_picture(8, 0.1, 1, 1)), Error);
}
