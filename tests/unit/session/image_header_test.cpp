#include "session/image_header.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall {
namespace {

TEST_CASE("the text of the options is as typed, and tells the nearest of settings apart") {
  RenderSettings s;
  s.splitting = 0.7f;
  CHECK(options_text(s).ends_with(" --splitting 0.7"));
  s.shadow_rays = 1;
  CHECK(options_text(s).ends_with(" --splitting 0.7 --shadow-rays 1"));
  for (const float splitting : {0.5f, 0.7f, 1e-3f, 0.1234567f}) {
    RenderSettings a, b;
    a.splitting = splitting;
    b.splitting = std::nextafter(splitting, 1.0f);
    CHECK(options_text(a) != options_text(b));
  }
}

}  // namespace
}  // namespace tyndall
