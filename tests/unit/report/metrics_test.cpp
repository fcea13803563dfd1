#include "report/metrics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tyndall/error.h"
#include "unit/report/pictures.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("every error by hand: one pixel off by 1 from a reference of 2, another off by 0.5 from black") {
  Image reference = flat(2, 1, 2, 2, 2), image = reference;
  reference.channels[1].values[1] = 0;
  image.channels[0].values[0] = 3;
  image.channels[1].values[1] = -0.5f;
  const ErrorMetrics e = measure_error(image, reference);
  CHECK(close(e.mse, (1 + 0.25) / 6, 1e-5));
  CHECK(close(e.relmse, (1 / 4.01 + 0.25 / 0.01) / 6, 1e-5));
  CHECK(e.relmse_trimmed == e.relmse);  // a thousandth of two pixels is none
  CHECK(close(e.mape, (1 / 2.01 + 0.5 / 0.01) / 6, 1e-5));
  CHECK(close(e.smape, (2 / 5.01 + 1 / 0.51) / 6, 1e-5));
}

TEST_CASE("no error between equal images, in any order of channels") {
  const auto ramp = [](int x, int y, int k) { return 0.1 * x + y + 0.01 * k; };
  const Image a = picture(5, 4, ramp);
  Image b = a;
  std::swap(b.channels[0], b.channels[2]);
  const ErrorMetrics e = measure_error(a, b);
  CHECK(e.mse == 0);
  CHECK(e.relmse == 0);
  CHECK(e.mape == 0);
  CHECK(e.smape == 0);
}

TEST_CASE("the trimmed error leaves out the worst pixel of a thousand, whichever channel it is bad in") {
  const Image reference = flat(50, 40, 1, 1, 1);
  Image image = flat(50, 40, 1.1, 1, 1);
  image.channels[2].values[777] = 1e4f;
  image.channels[1].values[1234] = -1e3f;
  const ErrorMetrics e = measure_error(image, reference);
  CHECK(e.relmse > 1e4);
  CHECK(close(e.relmse_trimmed, 0.01 / 1.01 / 3, 1e-4));
}

TEST_CASE("channels other than R, G, B") {
  const Image a = picture(3, 3, [](int, int, int) { return 1.0; }, {"Z"}),
              b = picture(3, 3, [](int, int, int) { return 3.0; }, {"Z"});
  CHECK(measure_error(a, b, {"Z"}).mse == 4);
  CHECK_THROWS_AS(measure_error(a, b), Error);
  CHECK_THROWS_AS(measure_error(a, flat(3, 4, 0, 0, 0), {"Z"}), Error);
}

TEST_CASE("the reference's own noise is taken off") {
  constexpr double kNoise = 0.2, kReferenceNoise = 0.1;
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  const Image image = picture(200, 200, [&](int, int, int) { return 1 + kNoise * normal(engine); });
  const Image reference = with_variance(picture(200, 200, [&](int, int, int) { return 1 + kReferenceNoise * normal(engine); }),
                                        kReferenceNoise * kReferenceNoise);
  CHECK(close(measure_error(image, reference).mse, 0.05, 0.02));
  const ErrorMetrics e = measure_error_without_noise(image, reference);
  CHECK(close(e.mse, 0.04, 0.02));
  CHECK(close(e.relmse, 0.04, 0.06));  // the reference's noise in the denominator remains
  CHECK(e.relmse_trimmed < e.relmse);
  CHECK(e.relmse_trimmed > 0.9 * e.relmse);
  CHECK_THROWS_AS(measure_error_without_noise(reference, image), Error);
}

TEST_CASE("errors that a picture states are held against the true ones") {
  constexpr double kNoise = 0.2, kReferenceNoise = 0.1;
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  Image image = picture(200, 200, [&](int, int, int) { return 1 + kNoise * normal(engine); });
  const Image reference = with_variance(picture(200, 200, [&](int, int, int) { return 1 + kReferenceNoise * normal(engine); }),
                                        kReferenceNoise * kReferenceNoise);
  CHECK(!measure_error_without_noise(image, reference).stated);
  const auto states = [&](float mse) {
    Image stating = image;
    for (const char* name : {"Mse.R", "Mse.G", "Mse.B"})
      for (float& v : stating.add_channel(name).values) v = mse;
    return measure_error_without_noise(stating, reference);
  };
  // 120,000 values: shares are known to 0.001.
  const ErrorMetrics right = states(0.04f), low = states(0.01f);
  CHECK(close(right.relmse / right.stated->relmse, 1, 0.02));
  CHECK(close(right.relmse_trimmed / right.stated->relmse_trimmed, 1, 0.02));
  CHECK(close(right.stated->within_two, std::erf(2 / std::sqrt(2.0)), 0.005));
  CHECK(close(low.relmse / low.stated->relmse, 4, 0.02));
  CHECK(close(low.stated->within_two, std::erf(2 * std::sqrt(0.02 / 0.05) / std::sqrt(2.0)), 0.005));
  // A value that is known without noise says nothing, one that is wrong without saying so does.
  Image flat_image = flat(10, 1, 1, 1, 1);
  flat_image.channels[0].values[3] = 2;
  for (const char* name : {"Mse.R", "Mse.G", "Mse.B"}) flat_image.add_channel(name);
  CHECK(stated_errors(flat_image, with_variance(flat(10, 1, 1, 1, 1), 0))->within_two == 0);
}

TEST_CASE("relMSE as estimated from an image's own variances") {
  CHECK(close(relmse_by_variances(with_variance(flat(4, 4, 1, 1, 1), 0.02f)), 0.02 / 0.99,
              1e-5));  // of the square, 0.02 is noise
  CHECK(close(relmse_by_variances(with_variance(flat(4, 4, 0, 0, 0), 0.0202f)), 2.02, 1e-5));
  CHECK_THROWS_AS(relmse_by_variances(flat(4, 4, 1, 1, 1)), Error);
}

TEST_CASE("values that are not finite make errors that are not finite") {
  const Image reference = flat(40, 40, 1, 1, 1);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Image image = reference;
    image.channels[1].values[5] = bad;
    const ErrorMetrics e = measure_error(image, reference);
    CHECK(!std::isfinite(e.mse));
    CHECK(!std::isfinite(e.relmse));
    CHECK(!std::isfinite(e.relmse_trimmed));
    CHECK(!std::isfinite(e.mape));
    CHECK(!std::isfinite(e.smape));
  }
}
