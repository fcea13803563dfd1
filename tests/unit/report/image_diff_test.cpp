#include "report/image_diff.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tyndall/error.h"
#include "unit/report/pictures.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

const ChannelDiff& channel(const ImageDiff& diff, const std::string& name) {
  return *std::find_if(diff.channels.begin(), diff.channels.end(), [&](const ChannelDiff& c) { return c.name == name; });
}

/// Two replicates of Gaussian noise about `mean` in each of R, G, B, with variances.
Image noisy(double mean, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0, 0.1);
  Image image = flat(32, 32, 0, 0, 0);
  for (const std::string name : {"R", "G", "B"}) {
    Channel& variance = image.add_channel("Variance." + name);
    for (std::size_t i = 0; i < variance.values.size(); ++i) {
      const double a = mean + normal(engine), b = mean + normal(engine);
      image.channels[name == "R" ? 0 : (name == "G" ? 1 : 2)].values[i] = static_cast<float>((a + b) / 2);
      variance.values[i] = static_cast<float>((a - b) * (a - b) / 4);
    }
  }
  return image;
}

bool says(const Judgement& judgement, const std::string& text) {
  return std::any_of(judgement.reasons.begin(), judgement.reasons.end(),
                     [&](const std::string& r) { return r.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("images of other chromaticities are told of, and compared all the same") {
  Image image = flat(4, 4, 1, 1, 1), reference = image;
  reference.chromaticities = Chromaticities{};  // Rec.709, as where nothing is said
  CHECK(compare_images(image, reference).primaries.empty());
  reference.chromaticities->red.x += 2e-5f;  // of a file that rounds
  CHECK(compare_images(image, reference).primaries.empty());
  reference.chromaticities->red = {0.708f, 0.292f};
  const ImageDiff diff = compare_images(image, reference);
  CHECK(diff.primaries ==
        "chromaticities of red, green, blue and white are 0.64 0.33, 0.3 0.6, 0.15 0.06, 0.3127 0.329, the reference's "
        "0.708 0.292, 0.3 0.6, 0.15 0.06, 0.3127 0.329");
  CHECK(judge(diff, {.exact = true}).same);
}

TEST_CASE("one channel by hand: means, bias and its error, the largest difference and where") {
  Image reference = picture(2, 2, [](int, int, int) { return 1.0; }, {"Z"}), image = reference;
  image.data = reference.data = {10, 20, 12, 22};
  image.channels[0].values = {1, 1.5f, 1, -1};
  const ImageDiff diff = compare_images(image, reference);
  const ChannelDiff& z = channel(diff, "Z");
  CHECK(close(z.mean, 0.625, 1e-5));
  CHECK(z.reference_mean == 1);
  CHECK(close(z.bias, -0.375, 1e-5));
  // Differences 0, 0.5, 0, -2: mean square 1.0625, variance 1.0625 - 0.140625, of the mean a third of it.
  CHECK(close(z.bias_error, std::sqrt(0.921875 / 3), 1e-5));
  CHECK(!z.error_from_variance);
  CHECK(z.largest == 2);
  CHECK(z.x == 11);
  CHECK(z.y == 21);
  CHECK(!z.equal);
  CHECK(!diff.flip_ldr);
  CHECK(!diff.test);
}

TEST_CASE("images without pixels are refused") {
  const Image nothing = flat(0, 0, 0, 0, 0), line = flat(5, 0, 0, 0, 0);
  CHECK_THROWS_AS(compare_images(nothing, nothing), Error);
  CHECK_THROWS_AS(compare_images(line, line), Error);
}

TEST_CASE("the error of the bias comes from the variances where both images have them") {
  const ImageDiff diff =
      compare_images(with_variance(flat(10, 10, 1, 1, 1), 0.03f), with_variance(flat(10, 10, 2, 2, 2), 0.01f));
  CHECK(channel(diff, "G").error_from_variance);
  CHECK(close(channel(diff, "G").bias_error, std::sqrt(0.04 * 100) / 100, 1e-5));
}

TEST_CASE("channels are grouped and put in order; one that an image lacks is named") {
  const auto zero = [](int, int, int) { return 0.0; };
  const Image image = picture(2, 2, zero, {"A", "Albedo.B", "Albedo.G", "Albedo.R", "B", "G", "R", "SampleCount", "Z"});
  const Image reference = picture(2, 2, zero, {"A", "Albedo.B", "Albedo.G", "Albedo.R", "B", "G", "N.X", "R", "SampleCount"});
  const ImageDiff diff = compare_images(image, reference);
  CHECK(diff.only_in_image == std::vector<std::string>{"Z"});
  CHECK(diff.only_in_reference == std::vector<std::string>{"N.X"});
  REQUIRE(diff.groups.size() == 4);
  CHECK(diff.groups[0].channels == std::vector<std::string>{"R", "G", "B"});
  CHECK(diff.groups[1].name == "A");
  CHECK(diff.groups[2].channels == std::vector<std::string>{"Albedo.R", "Albedo.G", "Albedo.B"});
  CHECK(diff.groups[3].name == "SampleCount");
  const Judgement judgement = judge(diff, {});
  CHECK(!judgement.same);
  CHECK(judgement.reasons.size() == 2);
  CHECK(says(judgement, "N.X is in the reference only"));

  const ImageDiff some = compare_images(image, reference, {.channels = {"RGB", "A"}});
  CHECK(some.channels.size() == 4);
  CHECK(judge(some, {}).same);
  CHECK_THROWS_AS(compare_images(image, reference, {.channels = {"Depth"}}), Error);
}

TEST_CASE("NaN and infinity always differ, in either image, and are counted and found") {
  const Image good = flat(4, 3, 1, 1, 1);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    Image image = good;
    image.channels[1].values[6] = image.channels[1].values[9] = bad;
    for (const bool in_reference : {false, true}) {
      const ImageDiff diff = in_reference ? compare_images(good, image) : compare_images(image, good);
      REQUIRE(diff.non_finite.size() == 1);
      CHECK(diff.non_finite[0].channel == "G");
      CHECK(diff.non_finite[0].in_reference == in_reference);
      CHECK(diff.non_finite[0].count == 2);
      CHECK(diff.non_finite[0].x == 2);
      CHECK(diff.non_finite[0].y == 1);
      CHECK(!diff.flip_hdr);
      CHECK(!judge(diff, {.max_error = 1e30}).same);
      CHECK(!judge(diff, {.max_flip = 1}).same);
    }
    CHECK(says(judge(compare_images(image, image), {.max_relmse = 1e30}),
               "2 values of G in the image not finite, first at (2, 1)"));
  }
}

TEST_CASE("a variance below 0 differs by itself, is found, and nothing is judged by it") {
  const Image good = noisy(1, 1);
  Image image = noisy(1, 2);
  CHECK(judge(compare_images(image, good), {}).same);
  for (Channel& c : image.channels) {
    if (c.name == "Variance.R") c.values[33] = -0.5f;
  }
  for (const bool in_reference : {false, true}) {
    const ImageDiff diff = in_reference ? compare_images(good, image) : compare_images(image, good);
    CHECK(!diff.test);
    CHECK(std::isfinite(channel(diff, "R").bias_error));
    CHECK(!channel(diff, "R").error_from_variance);
    for (const Criteria& criteria : {Criteria{}, Criteria{.test = true}, Criteria{.max_error = 1e30}}) {
      CHECK(says(judge(diff, criteria), std::string("1 value of Variance.R in the ") + (in_reference ? "reference" : "image") +
                                            " negative, first at (1, 1)"));
    }
  }
  CHECK(!judge(compare_images(image, good, {.channels = {"RGB"}}), {}).same);
  CHECK(judge(compare_images(image, good, {.channels = {"G"}}), {.max_error = 10}).same);
}

TEST_CASE("data windows that differ are a difference") {
  const Image a = flat(4, 4, 1, 1, 1);
  Image moved = a;
  moved.data = {1, 0, 5, 4};
  for (const Image& b : {flat(4, 5, 1, 1, 1), moved}) {
    const Judgement judgement = judge(compare_images(a, b), {.max_error = 1});
    CHECK(!judgement.same);
    CHECK(says(judgement, "4 x 4 pixels from (0, 0)"));
  }
}

TEST_CASE("criteria: each is met at its limit and refused beyond it; all must hold") {
  const Image reference = flat(8, 8, 1, 1, 1), image = flat(8, 8, 1.5, 1, 1);
  const ImageDiff diff = compare_images(image, reference);
  const double relmse = 0.25 / 1.01 / 3, flip = diff.flip_hdr->mean();
  CHECK(judge(diff, {.max_error = 0.5}).same);
  CHECK(says(judge(diff, {.max_error = 0.49}), "channel R is off by 0.5 at (0, 0)"));
  CHECK(judge(diff, {.max_relmse = 1.0001 * relmse}).same);
  CHECK(says(judge(diff, {.max_relmse = 0.9999 * relmse}), "relMSE of RGB"));
  CHECK(judge(diff, {.max_flip = flip}).same);
  CHECK(!judge(diff, {.max_flip = 0.999 * flip}).same);
  CHECK(!judge(diff, {.exact = true}).same);
  CHECK(!judge(diff, {.exact = true, .max_error = 1}).same);
  CHECK(judge(compare_images(image, image), {.exact = true, .max_error = 0, .max_relmse = 0, .max_flip = 0}).same);
  CHECK(judge(diff, {.max_error = 1, .max_relmse = 1}).criterion == "--max-error 1 --max-relmse 1");
  CHECK_THROWS_AS(judge(diff, {.test = true}), Error);
  CHECK_THROWS_AS(judge(compare_images(image, reference, {.flip = false}), {.max_flip = 1}), Error);
}

TEST_CASE("without a criterion: the test where there are variances, else equality") {
  const Judgement same = judge(compare_images(noisy(1, 1), noisy(1, 2)), {}),
                  off = judge(compare_images(noisy(1.03, 1), noisy(1, 2)), {});
  CHECK(same.same);
  CHECK(same.criterion == "--test");
  CHECK(!off.same);
  CHECK(says(off, "RGB by the image test differs"));
  CHECK(judge(compare_images(flat(4, 4, 1, 1, 1), flat(4, 4, 1, 1, 1)), {}).criterion == "--exact");
  CHECK(!judge(compare_images(noisy(1, 1), noisy(1, 2)), {.exact = true}).same);
}

TEST_CASE("statistics of a render are judged by equality only") {
  const Image a = with_variance(flat(4, 4, 1, 1, 1), 0.5f), b = with_variance(flat(4, 4, 1, 1, 1), 9);
  const ImageDiff diff = compare_images(a, b);
  CHECK(judge(diff, {.max_error = 0, .max_relmse = 0}).same);
  CHECK(!judge(diff, {.exact = true}).same);
}

TEST_CASE("the reference's noise: taken off, and judged without") {
  const Image a = noisy(1, 1), b = noisy(1, 2);
  const ImageDiff diff = compare_images(a, b, {.reference_noise = true});
  REQUIRE(diff.groups[0].without_noise);
  CHECK(close(diff.groups[0].without_noise->mse, diff.groups[0].errors.mse / 2, 0.1));
  const double between = 0.75 * diff.groups[0].errors.relmse;
  CHECK(judge(diff, {.max_relmse = between}).same);
  CHECK(!judge(compare_images(a, b), {.max_relmse = between}).same);
  CHECK_THROWS_AS(compare_images(a, flat(32, 32, 1, 1, 1), {.reference_noise = true}), Error);
}
