#include "report/error_picture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tyndall/error.h"
#include "unit/report/pictures.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

Rgb at(const Image& picture, int x) { return picture.rgb(x, 0); }

/// The colour of one pixel whose relative squared error is `error` over a black reference.
Rgb color_of(double error) {
  return at(
      error_picture(flat(1, 1, std::sqrt(0.01 * error), std::sqrt(0.01 * error), std::sqrt(0.01 * error)), flat(1, 1, 0, 0, 0)),
      0);
}

}  // namespace

TEST_CASE("black where there is no error worth showing, pale yellow at its largest, lighter all the way") {
  CHECK(is_black(color_of(0)));
  CHECK(is_black(color_of(0.9e-4)));
  CHECK(color_of(10.5) == color_of(1e6));
  CHECK(color_of(1e6).r > 0.9f);
  float before = 0;
  for (double e = 1.5e-4; e < 10; e *= 1.3) {
    const float now = luminance(color_of(e));
    CHECK(now > before);
    before = now;
  }
}

TEST_CASE("the documented colours") {
  const Rgb violet = color_of(std::pow(10, -2.75)), red = color_of(std::pow(10, -1.5)), orange = color_of(std::pow(10, -0.25));
  CHECK((violet.b > violet.r && violet.r > violet.g));
  CHECK((red.r > 2 * red.b && red.b > red.g));
  CHECK((orange.r > orange.g && orange.g > 5 * orange.b));
}

TEST_CASE("errors are averaged over channels and stand where they are") {
  const Image reference = flat(3, 1, 0, 0, 0);
  Image image = reference;
  image.channels[1].values[2] = static_cast<float>(std::sqrt(3 * 0.01 * 0.1));
  const Image picture = error_picture(image, reference);
  CHECK(is_black(at(picture, 0)));
  CHECK(is_black(at(picture, 1)));
  CHECK(close(at(picture, 2).r, color_of(0.1).r, 1e-4));
}

TEST_CASE("what is not finite is green, and what cannot be compared is refused") {
  Image image = flat(2, 1, 1, 1, 1);
  image.channels[0].values[1] = std::numeric_limits<float>::quiet_NaN();
  const Image picture = error_picture(image, flat(2, 1, 1, 1, 1));
  CHECK(is_black(at(picture, 0)));
  CHECK(at(picture, 1) == Rgb(0, 1, 0));
  CHECK_THROWS_AS(error_picture(image, flat(1, 2, 1, 1, 1)), Error);
  CHECK_THROWS_AS(error_picture(image, flat(2, 1, 1, 1, 1), {"Z"}), Error);
}
