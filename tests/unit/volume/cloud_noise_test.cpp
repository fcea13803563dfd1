#include "volume/cloud_noise.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "math/perlin_noise.h"
#include "math/rng.h"
#include "support/test_media.h"
#include "volume/tracking.h"

using namespace tyndall;

namespace {

/// As the book has it, each noise by itself [PBR book 4th ed., sec. 11.4.4].
float density_by_book(const CloudMedium& cloud, Vec3 p) {
  Vec3 pp = cloud.frequency * p;
  if (cloud.wispiness > 0) {
    float vo = 0.05f * cloud.wispiness, vl = 10;
    for (int i = 0; i < 2; ++i) {
      const Vec3 q = vl * pp;
      const float n = perlin_noise(q);
      pp += vo * Vec3{(perlin_noise(q + Vec3{0.01f, 0, 0}) - n) / 0.01f, (perlin_noise(q + Vec3{0, 0.01f, 0}) - n) / 0.01f,
                      (perlin_noise(q + Vec3{0, 0, 0.01f}) - n) / 0.01f};
      vo *= 0.5f;
      vl *= 1.99f;
    }
  }
  float d = 0, o = 0.5f, l = 1;
  for (int i = 0; i < 5; ++i) {
    d += o * perlin_noise(l * pp);
    o *= 0.5f;
    l *= 1.99f;
  }
  const auto unit = [](float x) { return std::max(0.0f, std::min(x, 1.0f)); };
  return unit(unit((1 - p.y) * 4.5f * cloud.density * d) + 2 * std::max(0.0f, 0.5f - p.y));
}

}  // namespace

TEST_CASE("a cloud's density is that of the book, to the bit") {
  Rng rng(5);
  int partial = 0;
  for (int i = 0; i < 20'000; ++i) {
    CloudMedium cloud;
    cloud.density = 0.1f + 2 * rng.uniform();
    cloud.wispiness = i % 4 == 0 ? 0 : 3 * rng.uniform();
    cloud.frequency = 0.5f + 10 * rng.uniform();
    const Vec3 p{4 * rng.uniform() - 2, 2.5f * rng.uniform() - 0.5f, 4 * rng.uniform() - 2};
    const float density = cloud_density(cloud, p);
    REQUIRE(density == density_by_book(cloud, p));
    partial += density > 0 && density < 1 ? 1 : 0;
  }
  CHECK(partial > 3'000);
}

TEST_CASE("look-ups of procedural clouds are counted apart, alone and among other media") {
  const ParticipatingMedium cloud = test::cloud({{}, Rgb{20}}), fog = test::homogeneous({{}, Rgb{1}});
  const ParticipatingMedium smoke =
      test::grid({8, -2, 2}, {{}, Rgb{20}}, [](int i) { return 0.1f * static_cast<float>(i % 7); });
  const auto counted = [](std::vector<const ParticipatingMedium*> media) {
    TrackingStats stats;
    Rng rng(6);
    for (int i = 0; i < 100; ++i) {
      const Ray ray({-3, 0.75f, 0.1f * static_cast<float>(i % 10)}, {1, 0, 0});
      free_flight(media, ray, 0, 6, Rgb{1}, rng.uniform(), rng, stats);
      for (const auto strategy :
           {TransmittanceStrategy::raymarch, TransmittanceStrategy::ratio, TransmittanceStrategy::residual})
        transmittance({strategy}, media, ray, 0, 6, rng, stats);
    }
    CHECK(stats.lookups > 1000);
    return stats;
  };
  const TrackingStats alone = counted({&cloud}), beside = counted({&fog, &cloud, &smoke});
  CHECK(alone.noise_lookups == alone.lookups);
  CHECK(counted({&smoke}).noise_lookups == 0);
  CHECK(beside.noise_lookups > 0);
  CHECK(beside.noise_lookups < beside.lookups);
}
