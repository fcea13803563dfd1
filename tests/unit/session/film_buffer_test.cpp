#include "session/film_buffer.h"

#include <doctest/doctest.h>

#include <array>

#include "math/rng.h"
#include "support/relative.h"
#include "tyndall/deep_image.h"
#include "tyndall/error.h"

using namespace tyndall;

namespace {

PathRecord grey(float L) {
  PathRecord record;
  record.surface_direct = Rgb(L);
  return record;
}

}  // namespace

TEST_CASE("the mean of the samples, split into its parts, over a crop") {
  Film film;
  film.width = 4;
  film.height = 3;
  FilmBuffer buffer(film, {1, 1, 3, 2}, {parse_aovs({"SurfaceDirect", "Emission", "P", "Z", "SampleCount"})});
  PathRecord a = grey(2), b = grey(4);
  a.emission = {1, 0, 0};
  a.hit_surface = true;
  a.p = {1, 2, 3};
  a.z = 5;
  buffer.add({2, 1, 0}, a, 1);
  buffer.add({2, 1, 1}, b, 1);
  buffer.add({1, 1, 0}, b, 1);
  buffer.add({1, 1, 1}, b, 1);
  const Image image = buffer.image(2);

  CHECK(image.data == PixelBounds{1, 1, 3, 2});
  CHECK(image.display == PixelBounds{0, 0, 4, 3});
  CHECK(image.find("R")->values[1] == doctest::Approx(3.5));
  CHECK(image.find("G")->values[1] == doctest::Approx(3));
  CHECK(image.find("SurfaceDirect.R")->values[1] == doctest::Approx(3));
  CHECK(image.find("Emission.R")->values[1] == doctest::Approx(0.5));
  CHECK(image.find("P.Z")->values[1] == 3);  // over the samples that hit something
  CHECK(image.find("Z")->values[1] == 5);
  CHECK(image.find("Z")->values[0] == 0);
  CHECK(image.find("SampleCount")->values[0] == 2);
  CHECK(image.find("SurfaceCount")->values == std::vector<float>{0, 1});
  CHECK(image.find("VolumeCount") == nullptr);
}

TEST_CASE("depths are means over what was hit, however small a sample's share") {
  FilmBuffer buffer(Film(), {0, 0, 1, 1}, {parse_aovs({"P", "Z"})});
  PathRecord record = grey(1);
  record.hit_surface = true;
  record.p = {1, 2, 3};
  record.z = 5;
  buffer.add({0, 0, 0, 0.125f}, record, 1);
  const Image image = buffer.image(1);
  CHECK(image.find("Z")->values[0] == 5);
  CHECK(image.find("P.Y")->values[0] == 2);
}

TEST_CASE("replicates are the means over the even samples, of what was asked for") {
  Film film;
  film.width = 2;
  film.height = 1;
  FilmBuffer buffer(film, {0, 0, 2, 1}, {parse_aovs({"Replicate", "SurfaceDirect", "N", "Z", "Variance", "SampleCount"})});
  for (int s = 0; s < 5; ++s) {
    PathRecord record = grey(static_cast<float>(s * s));
    record.emission = Rgb(1);
    record.n = {0, 0, static_cast<float>(s)};
    record.hit_surface = s >= 3;
    record.z = static_cast<float>(s);
    buffer.add({0, 0, s}, record, 1);
  }
  const Image image = buffer.image(5);
  const auto value = [&](const char* channel) { return image.find(channel)->values[0]; };
  CHECK(value("R") == doctest::Approx(7));                       // (0 + 1 + 4 + 9 + 16) / 5 + 1
  CHECK(value("Replicate.R") == doctest::Approx(20 / 3.0 + 1));  // (0 + 4 + 16) / 3 + 1
  CHECK(value("Replicate.SurfaceDirect.B") == doctest::Approx(20 / 3.0));
  CHECK(value("SurfaceDirect.B") == doctest::Approx(6));
  CHECK(value("Replicate.N.Z") == doctest::Approx(2));
  CHECK(value("Z") == 3.5f);
  CHECK(value("SurfaceCount") == 2);
  CHECK(value("Replicate.Z") == 4);
  CHECK(value("Replicate.SurfaceCount") == 1);
  CHECK(value("Replicate.SampleCount") == 3);
  CHECK(image.find("Replicate.Z")->values[1] == 0);
  CHECK(image.find("Replicate.Variance.R") == nullptr);
  CHECK(image.find("Replicate.A") == nullptr);
  CHECK(FilmBuffer(film, {0, 0, 2, 1}, {parse_aovs({"Z"})}).image(2).find("Replicate.R") == nullptr);
}

TEST_CASE("variance of the pixel mean from the two replicates is right on average") {
  // Independent samples of variance 1/12: with n of them the mean has 1/(12 n). 4000 pixels give it to
  // sqrt(2/4000) = 2.2 % (the square of a normal has relative variance 2); 4 of these are allowed. Odd n too.
  Film film;
  film.width = 80;
  film.height = 50;
  for (const int n : {2, 5, 16}) {
    FilmBuffer buffer(film, {0, 0, 80, 50}, {parse_aovs({"Variance"})});
    Rng rng(n);
    for (int y = 0; y < 50; ++y) {
      for (int x = 0; x < 80; ++x) {
        for (int s = 0; s < n; ++s) buffer.add({x, y, s}, grey(rng.uniform()), 1);
      }
    }
    const Image image = buffer.image(n);
    double sum = 0;
    for (const float v : image.find("Variance.G")->values) sum += v;
    CHECK(sum / 4000 == test::relative(1.0 / (12 * n)).epsilon(0.09));
  }
}

TEST_CASE("an unknown AOV is named with the known ones") {
  CHECK_THROWS_WITH_AS(parse_aovs({"Depth"}), doctest::Contains("Albedo, N, P, Z"), Error);
}

TEST_CASE("light groups are means of halves like all light, and what rounding leaves goes to the brightest") {
  Film film;
  film.width = 2;
  film.height = 1;
  FilmBuffer buffer(film, {0, 0, 2, 1}, {parse_aovs({"Variance", "Replicate"}), {"key", "default"}});
  const std::vector<Rgb> even{Rgb(1), Rgb(4)}, odd{Rgb(3), Rgb(0.25f)};
  const float more = 5 * (1 + 1e-5f);  // than the groups
  buffer.add({1, 0, 0}, grey(more), 0.5f);
  buffer.add_groups({1, 0, 0}, Rgb(more), even, 0.5f);
  buffer.add({1, 0, 1}, grey(3.25f), 1);
  buffer.add_groups({1, 0, 1}, Rgb(3.25f), odd, 1);
  const Image image = buffer.image(2);
  const auto at = [&](const std::string& channel) { return image.find(channel)->values[1]; };
  CHECK(at("LightGroup.key.R") == 1.75f);
  CHECK(at("LightGroup.default.G") == doctest::Approx(1.125 + 0.25 * (double{more} - 5)).epsilon(1e-7));
  CHECK(at("R") == doctest::Approx(double{at("LightGroup.key.R")} + at("LightGroup.default.R")).epsilon(1e-7));
  CHECK(at("Replicate.LightGroup.key.B") == 0.5f);
  CHECK(at("Variance.LightGroup.key.R") == doctest::Approx(2.5 * 2.5 / 4));
  CHECK(image.find("LightGroup.key.R")->values[0] == 0);
  CHECK_FALSE(image.find("Variance.LightGroup.key.A"));

  // A defect is no rounding, and shows.
  FilmBuffer other(film, {0, 0, 2, 1}, {{}, {"key", "default"}});
  other.add_groups({0, 0, 0}, Rgb(6), even, 1);
  CHECK(other.image(1).find("LightGroup.default.R")->values[0] == 4);
}

TEST_CASE("sums of light groups go through slices") {
  Film film;
  film.width = film.height = 1;
  FilmBuffer buffer(film, {0, 0, 1, 1}, {{}, {"key", "sky"}}), again(film, {0, 0, 1, 1}, {{}, {"key", "sky"}});
  const std::vector<Rgb> light{Rgb(1), Rgb(2)};
  buffer.add_groups({0, 0, 0}, Rgb(3), light, 1);
  Image image = buffer.image(1);
  buffer.store_sums(image);
  REQUIRE(again.has_sums(image));
  again.add_sums(image);
  CHECK(again.image(1).find("LightGroup.sky.B")->values[0] == 2);
  CHECK_FALSE(FilmBuffer(film, {0, 0, 1, 1}, {{}, {"key"}}).has_sums(image));
}

TEST_CASE("samples count for their share, in every mean and in what is not weighted by the filter") {
  Film film;
  film.width = film.height = 1;
  FilmBuffer buffer(film, {0, 0, 1, 1}, {parse_aovs({"Z", "Replicate", "SampleCount"})});
  PathRecord near = grey(1), far = grey(4);
  near.hit_surface = far.hit_surface = true;
  near.z = 2, far.z = 5;
  near.alpha = far.alpha = 1;
  for (const int s : {0, 1}) buffer.add({0, 0, s}, near, 1);
  for (const int s : {2, 3}) buffer.add({0, 0, s, 3}, far, 0.5f);
  const std::array paths{4};
  const Image image = buffer.image(8, paths);
  const auto value = [&](const char* name) { return image.find(name)->values[0]; };
  CHECK(value("R") == doctest::Approx((2 * 1 + 6 * 4 * 0.5) / 8));
  CHECK(value("Replicate.R") == value("R"));
  CHECK(value("A") == doctest::Approx((2 + 6 * 0.5) / 8));
  CHECK(value("Z") == doctest::Approx((2 * 2 + 6 * 5) / 8.0));
  CHECK(value("SurfaceCount") == 8);
  CHECK(value("SampleCount") == 4);
  CHECK(value("SampleWeight") == 8);
  CHECK(value("Replicate.SampleCount") == 2);
  CHECK(value("Replicate.SampleWeight") == 4);
  CHECK(buffer.image(8).find("SampleWeight") == nullptr);
}

TEST_CASE("opacity that noise makes negative in one depth is taken from those before it, so that all of it stays") {
  const DepthBins bins(1, 5, 4);
  for (const std::array<float, 3>& opacity :
       {std::array{0.3f, -0.1f, 0.4f}, std::array{0.3f, 0.4f, -0.1f}, std::array{-0.1f, 0.3f, 0.4f}}) {
    FilmBuffer buffer(Film(), {0, 0, 1, 1}, {{}, {}, DeepLayout{bins, 1}});
    std::vector<DeepSample::Part> parts;
    for (int i = 0; i < 3; ++i) parts.push_back({bins.media_key(i + 1), Rgb(0.2f), opacity[static_cast<std::size_t>(i)], 0, 0});
    buffer.add_deep({0, 0, 0}, parts, 1);
    const auto deep = buffer.deep_image(1);
    REQUIRE(deep);
    CHECK(deep->samples.size() == 3);
    const Image flat = flatten(*deep);
    CHECK(flat.find("A")->values[0] == doctest::Approx(0.6));
    CHECK(flat.find("R")->values[0] == doctest::Approx(0.6));
  }
}
