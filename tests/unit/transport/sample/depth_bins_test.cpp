#include "transport/sample/depth_bins.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "math/rng.h"
#include "session/world_parts.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"

using namespace tyndall;

TEST_CASE("each depth is in the bin whose edges hold it, also at the edges") {
  for (const DepthBins& bins : {DepthBins(0.3f, 7.1f, 16), DepthBins(0, 1e-3f, 3), DepthBins(5, 5000, 256)}) {
    CHECK(bins.edge(0) == 0);
    CHECK(bins.edge(1) == bins.near());
    CHECK(bins.edge(bins.count() + 1) == bins.far());
    CHECK(std::isinf(bins.edge(bins.count() + 2)));
    const auto check = [&](float z) {
      const int bin = bins.bin_of(z);
      CHECK(bin >= 0);
      CHECK(bin <= bins.count() + 1);
      CHECK(z >= bins.edge(bin));
      CHECK(z < bins.edge(bin + 1));
    };
    for (int bin = 1; bin <= bins.count() + 1; ++bin) {
      check(bins.edge(bin));
      check(std::nextafter(bins.edge(bin), 0.0f));
      check(std::nextafter(bins.edge(bin), 1e30f));
    }
    Rng rng(1);
    for (int i = 0; i < 1000; ++i) check(1.5f * rng.uniform() * bins.far());
  }
}

TEST_CASE("keys go with depth: media of a bin, then its surfaces") {
  const DepthBins bins(1, 9, 4);
  std::uint32_t before = 0;
  for (const float z : {0.0f, 0.4f, 0.9f, 1.0f, 1.2f, 2.9f, 3.1f, 8.9f, 9.0f, 50.0f, kInfinity}) {
    CAPTURE(z);
    const std::uint32_t key = bins.surface_key(z), media = bins.media_key(bins.bin_of(z));
    CHECK(key > before);
    CHECK(media < key);
    CHECK(media >= bins.media_key(0));
    CHECK(DepthBins::bin_of_key(key) == bins.bin_of(z));
    CHECK(DepthBins::bin_of_key(media) == bins.bin_of(z));
    CHECK(DepthBins::is_media_key(media));
    CHECK_FALSE(DepthBins::is_media_key(key));
    CHECK(std::isnormal(std::bit_cast<float>(key)));
    CHECK(std::isnormal(std::bit_cast<float>(media)));
    before = key;
  }
  CHECK(bins.surface_key(5.0f) == bins.surface_key(5.01f));
  CHECK(bins.surface_key(5.0f) != bins.surface_key(5.5f));
}

TEST_CASE("bins are about the media, in front of the camera") {
  const auto bins_of = [](const std::string& camera, const std::string& media) {
    const World world = test::world_of(camera + media, {});
    const DepthBins bins(world.parts().built, 8);
    return DepthBins(bins.near() * world.parts().unit, bins.far() * world.parts().unit, 8);
  };
  const auto view = [](float z) { return test::view({.eye = {0, 0, z}, .look = {0, 0, 10}, .fov_degrees = 40}); };
  const std::string smoke = test::homogeneous("m", {.sigma_s = Rgb(1)});
  const std::string box = smoke + test::medium_box("m", "", {{-1, -1, -1}, {1, 1, 2}});
  const DepthBins before = bins_of(view(-4), box);
  CHECK(before.near() == doctest::Approx(3));
  CHECK(before.far() == doctest::Approx(6));
  const DepthBins within = bins_of(view(0.5f), box);
  CHECK(within.near() == 0);
  CHECK(within.far() == doctest::Approx(1.5));
  // No media: everything is before them.
  const DepthBins none = bins_of(view(-4), "Shape \"sphere\"\n");
  CHECK(none.bin_of(3) == 0);
  CHECK(none.bin_of(1e6f) == 0);
  CHECK(none.bin_of(kInfinity) == none.count() + 1);
  // Fog without bounds is told apart as far as there are shapes.
  const std::string fog = test::view({.eye = {0, 0, -4},
                                      .look = {0, 0, 10},
                                      .fov_degrees = 40,
                                      .before_camera = test::homogeneous("fog", {.sigma_s = Rgb(0.1f)}),
                                      .medium = "fog"});
  const DepthBins foggy = bins_of(fog, test::block("Translate 0 0 6\nShape \"sphere\" \"float radius\" 2\n"));
  CHECK(foggy.near() == 0);
  CHECK(foggy.far() == doctest::Approx(12));
}
