#include "light/profile_emitter.h"

#include <doctest/doctest.h>

#include <numeric>

#include "light/importance.h"
#include "light/lights.h"
#include "math/warp.h"
#include "segment_cases.h"
#include "support/chi_squared.h"

namespace tyndall {
namespace {

TexelImage picture(int width, int height, const std::function<Rgb(int, int)>& texel) {
  std::vector<Rgb> texels;
  for (int i = 0; i < width * height; ++i) texels.push_back(texel(i % width, i / width));
  return {width, height, std::move(texels)};
}

/// Of candela by vertical and horizontal angle in degrees.
PhotometricWeb web(std::vector<float> vertical, std::vector<float> horizontal, const std::function<double(double, double)>& I) {
  PhotometricWeb w{std::move(vertical), std::move(horizontal), {}};
  for (const float h : w.horizontal_degrees)
    for (const float v : w.vertical_degrees) w.candela.push_back(float(I(v, h)));
  return w;
}

std::vector<float> steps(float from, float to, float step) {
  std::vector<float> all;
  for (float v = from; v <= to + 0.001f; v += step) all.push_back(v);
  return all;
}

double cosine(double degrees) { return std::max(std::cos(degrees * kPi / 180), 0.0); }

struct Named {
  const char* name;
  IntensityProfile profile;
};

/// Of every kind: lit everywhere and in part, lopsided, narrow.
std::vector<Named> profiles() {
  std::vector<Named> all;
  const auto add = [&](const char* name, auto kind) { all.push_back({name, IntensityProfile(std::move(kind))}); };
  add("even map", GoniometricMap(picture(4, 4, [](int, int) { return Rgb(2); })));
  add("one texel", GoniometricMap(picture(8, 8, [](int x, int y) { return x == 6 && y == 2 ? Rgb(3, 6, 0) : Rgb(); })));
  add("lobes", GoniometricMap(picture(32, 32, [](int x, int y) { return Rgb(float(x * x) + (y > 20 ? 0 : 5)); })));
  add("image", ProjectedImage(picture(12, 8, [](int x, int y) { return Rgb(x > 3 ? 1.0f : 0.0f, 0.5f, float(y)); }), 40));
  add("corner of an image",
      ProjectedImage(picture(8, 12, [](int x, int y) { return Rgb(x == 0 && y == 11 ? 1.0f : 0.0f); }), 120));
  add("cosine", PhotometricTable(web(steps(0, 90, 5), {0}, [](double v, double) { return 683 * cosine(v); })));
  add("street",
      PhotometricTable(web(steps(0, 85, 5), steps(0, 180, 15), [](double v, double h) { return h < 60 ? 0 : v * h; })));
  add("quadrants",
      PhotometricTable(web(steps(0, 180, 10), steps(0, 90, 30), [](double v, double h) { return 10 + v + 3 * h; })));
  add("upward", PhotometricTable(web(steps(90, 180, 15), steps(90, 270, 30), [](double v, double h) { return v - 80 + h; })));
  return all;
}

TEST_CASE("the flux of a profile is the integral of its intensity") {
  for (const auto& [name, profile] : profiles()) {
    CAPTURE(name);
    double sum[3] = {};
    constexpr int kRows = 600, kColumns = 1200;
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j < kColumns; ++j) {
        const Vec3 w = square_to_uniform_sphere({(float(i) + 0.5f) / kRows, (float(j) + 0.5f) / kColumns});
        const Rgb I = profile.at(w);
        for (int c = 0; c < 3; ++c) sum[c] += I[c] * 4 * kPi / (double(kRows) * kColumns);
      }
    for (int c = 0; c < 3; ++c) CHECK(profile.flux()[c] == doctest::Approx(sum[c]).epsilon(5e-3));
  }
}

TEST_CASE("under any transform the bounds hold all that is lit, and narrow profiles have narrow ones") {
  Rng rng(6);
  std::size_t lit = 0, dark = 0;
  for (const auto& [name, profile] : profiles())
    for (int k = 0; k < 4; ++k) {
      CAPTURE(name);
      CAPTURE(k);
      Transform t = Transform::translate(1, -2, 3) * Transform::rotate(123, 3, 1, 2);
      if (k == 1) t = t * Transform::scale(-2, 2, 2);
      if (k == 2) t = t * Transform::scale(1, 3, 0.2);
      if (k == 3) t = t * Transform::scale(1e-12, 1e-12, 1e-12);
      const ProfileEmitter light(t, {{2, 1, 0.5f}, std::nullopt}, profile);
      const ClusterBounds cluster = ClusterBounds::from(light.bounds());
      CHECK(light.bounds().box.min == light.position());
      for (int i = 0; i < 4000; ++i) {
        const Vec3 w =
            i % 2 ? test::random_direction(rng) : normalize(light.beam().axis + test::random_in_cube(rng, rng.uniform()));
        const Vec3 p = light.position() + w * std::exp(4 * rng.uniform() - 2);
        const auto a = light.arrival(p);
        const double important = importance(cluster, false, PointQuery{p, {}});
        dark += important == 0;
        if (!a || is_black(a->L)) continue;
        ++lit;
        REQUIRE(important > 0);
        if (!light.beam().full()) REQUIRE(angle_between(light.beam().axis, -a->wi) <= light.beam().theta);
      }
    }
  CHECK(lit > 30'000);
  CHECK(dark > 10'000);
}

// [LM-63] of 100 cd all around: 100/683 W/sr; cosine of I_0: pi I_0; a table of the cosine every 22.5 degrees, linear in
// between: 0.986948 of that.
TEST_CASE("photometric tables have the flux of closed forms") {
  const auto flux = [](PhotometricWeb w) { return double(IntensityProfile(PhotometricTable(w)).flux().g) * 683; };
  const auto even = [](double, double) { return 100; };
  const auto cosine_of = [](double v, double) { return 100 * cosine(v); };
  CHECK(flux(web(steps(0, 180, 90), {0}, even)) == doctest::Approx(400 * kPi).epsilon(1e-5));
  CHECK(flux(web(steps(0, 180, 10), steps(0, 360, 45), even)) == doctest::Approx(400 * kPi).epsilon(1e-5));
  CHECK(flux(web(steps(0, 90, 5), {0}, cosine_of)) == doctest::Approx(100 * kPi * 0.999365).epsilon(1e-5));
  CHECK(flux(web(steps(0, 90, 22.5f), steps(0, 90, 45), cosine_of)) == doctest::Approx(100 * kPi * 0.986948).epsilon(1e-5));
  CHECK(flux(web(steps(0, 90, 90), {0}, cosine_of)) == doctest::Approx(100 * kPi * 0.726760).epsilon(1e-5));
}

TEST_CASE("photometric tables: down is -y, horizontal angles turn from +x to +z, and symmetry goes around") {
  const auto direction = [](double v, double h) {
    const double theta = v * kPi / 180, phi = h * kPi / 180;
    return Vec3{float(std::sin(theta) * std::cos(phi)), float(-std::cos(theta)), float(std::sin(theta) * std::sin(phi))};
  };
  const auto I = [](double v, double h) { return 683 * (v + h); };
  const auto at = [&](const PhotometricTable& t, double v, double h) { return t.at(direction(v, h)).r; };
  const PhotometricTable quarter(web(steps(0, 90, 10), steps(0, 90, 30), I)), half(web(steps(0, 90, 10), steps(0, 180, 30), I)),
      other_half(web(steps(0, 90, 10), steps(90, 270, 30), I)), full(web(steps(0, 90, 10), steps(0, 360, 30), I)),
      open(web(steps(0, 90, 10), steps(0, 330, 30), I));
  CHECK(at(quarter, 35, 20) == doctest::Approx(55));
  CHECK(at(quarter, 35, 160) == doctest::Approx(55));
  CHECK(at(quarter, 35, 200) == doctest::Approx(55));
  CHECK(at(quarter, 35, 340) == doctest::Approx(55));
  CHECK(at(half, 35, 160) == doctest::Approx(195));
  CHECK(at(half, 35, 200) == doctest::Approx(195));
  CHECK(at(other_half, 35, 200) == doctest::Approx(235));
  CHECK(at(other_half, 35, 340) == doctest::Approx(235));
  CHECK(at(other_half, 35, 20) == doctest::Approx(195));
  CHECK(at(full, 35, 200) == doctest::Approx(235));
  CHECK(at(full, 35, 345) == doctest::Approx(35 + 165));  // halfway from 330 to what stands at 0
  CHECK(at(open, 35, 345) == doctest::Approx(35 + 165));
  CHECK(at(full, 91, 20) == 0);
  CHECK(at(full, 89.9, 0) == doctest::Approx(89.9));
}

TEST_CASE("power scales a profile to what it emits, and a dark one stays dark") {
  for (const auto& [name, profile] : profiles()) {
    CAPTURE(name);
    const ProfileEmitter light({}, {Rgb(0.5f), 16.0f}, profile);
    CHECK(luminance(light.power()) == doctest::Approx(8));
  }
  const IntensityProfile black(GoniometricMap(picture(2, 2, [](int, int) { return Rgb(); })));
  CHECK(is_black(ProfileEmitter({}, {Rgb(1), 16.0f}, black).power()));
}

/// Draws of a selector follow its pmf, which sums to 1 but for what cannot contribute.
template <typename Query>
void check_choice(const Lights& lights, const Query& q) {
  const LightSelector& selector = lights.selector(lights.selectors()[0].strategy);
  std::vector<double> pmf(lights.size() + 1), counts(lights.size() + 1);
  for (LightId i = 0; i < lights.size(); ++i) pmf[i] = selector.pmf(q, i);
  const double sum = std::accumulate(pmf.begin(), pmf.end(), 0.0);
  REQUIRE(sum < 1 + 1e-5);
  pmf.back() = std::max(0.0, 1 - sum);
  constexpr int kDraws = 200'000;
  Rng rng(4);
  for (int i = 0; i < kDraws; ++i) {
    const auto s = selector.select(q, rng.uniform_wide());
    if (s) REQUIRE(std::abs(s->pmf - pmf[s->light]) <= 1e-5 * s->pmf);
    counts[s ? s->light : lights.size()] += 1;
  }
  CHECK(test::count_p_value(counts, pmf, kDraws) > 1e-6);
}

TEST_CASE(
    "among 10,000 goniometric and projection lights the tree chooses as it states, and none that gives light is left out") {
  const std::string folder = TYNDALL_SOURCE_DIR "/tests/regression/pbrt/";
  Scene scene;
  Rng rng(12);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 p = test::random_in_cube(rng, 10), axis = test::random_direction(rng);
    const Transform t = Transform::translate(p.x, p.y, p.z) * Transform::rotate(360 * rng.uniform(), axis.x, axis.y, axis.z);
    const Rgb I(std::exp(6 * rng.uniform()));
    if (i % 2) {
      scene.lights.push_back({GoniometricLight{t, I, folder + "gonio32.exr", std::nullopt}, {}});
    } else {
      scene.lights.push_back({ProjectionLight{t, I, folder + "f12x8.exr", 50, std::nullopt}, {}});
    }
  }
  const Lights lights = build_lights(scene, {}, {{-10, -10, -10}, {10, 10, 10}});
  CHECK(double(lights.memory_bytes()) / 10'000 < 400);
  const LightSelector& selector = lights.selector(lights.selectors()[0].strategy);
  for (const PointQuery& q :
       {PointQuery{{1, 2, 3}, {}}, PointQuery{{-4, 9, 0}, normalize(Vec3{1, 2, -1})}, PointQuery{{30, 0, 0}, {-1, 0, 0}}}) {
    check_choice(lights, q);
    std::size_t unlit = 0;
    for (LightId id = 0; id < lights.size(); ++id) {
      const auto s = lights.sample(id, q.p, {0.5f, 0.5f});
      const bool gives = s && (length(q.n) == 0 || dot(q.n, s->wi) > 0);
      if (gives) REQUIRE(selector.pmf(q, id) > 0);
      unlit += selector.pmf(q, id) == 0;
    }
    CHECK(unlit > 2'000);  // of projectors that point elsewhere
  }
  SegmentQuery segment{.o = {-12, 1, 2}, .d = normalize(Vec3{3, 0.2f, -0.1f}), .t0 = 0, .t1 = 20};
  segment.profile = test::homogeneous_profile(0, 20, 0.1f, 10, 0.5f);
  check_choice(lights, segment);
}

}  // namespace
}  // namespace tyndall
