#include "report/merge.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "math/rng.h"
#include "report/slice.h"
#include "support/measure.h"
#include "support/relative.h"
#include "support/scene_text.h"
#include "support/scratch.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// A made-up render: `samples` samples of `seed` over `crop` of an 8 x 6 frame, with random values.
Image made_slice(std::uint64_t seed, int samples, PixelBounds crop = {0, 0, 8, 6}) {
  Image image;
  image.data = crop;
  image.display = {0, 0, 8, 6};
  Rng rng(seed);
  for (const char* name : {"R", "G", "B", "A", "Variance.R", "Z", "SurfaceCount"}) {
    const bool count = std::string(name) == "SurfaceCount";
    for (float& v : image.add_channel(name).values) {
      v = count ? std::floor(rng.uniform() * (static_cast<float>(samples) + 1)) : rng.uniform();
    }
  }
  image.attributes["tyndall/sceneHash"] = "0123456789abcdef";
  image.attributes["tyndall/seed"] = std::to_string(seed);
  image.attributes["tyndall/samples"] = samples;
  image.attributes["tyndall/options"] = "--lights power";
  image.attributes["software"] = "Tyndall";
  return image;
}

/// Files in a scratch folder, merged.
class Files {
 public:
  std::string write(const std::string& name, const Image& image) {
    write_exr(image, scratch_ / name);
    return scratch_ / name;
  }
  Image merge(const std::vector<std::string>& names, const MergeSettings& settings = {}) const {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back(scratch_ / name);
    return merge_slices(paths, settings).image;
  }
  std::string refusal(const std::vector<std::string>& names) const {
    try {
      merge(names);
    } catch (const Error& e) {
      CHECK(e.failure() == Failure::scene);
      return e.what();
    }
    return "merged";
  }
  std::string bytes(const Image& image) { return read_bytes(write("bytes.exr", image)); }

 private:
  Scratch scratch_;
};

float value(const Image& image, const std::string& channel, int x, int y) {
  const Channel* c = image.find(channel);
  REQUIRE(c != nullptr);
  return c->values[static_cast<std::size_t>(y - image.data.y0) * static_cast<std::size_t>(image.width()) +
                   static_cast<std::size_t>(x - image.data.x0)];
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
#define CHECK_SAYS(text, part) CHECK_MESSAGE(contains(text, part), text)

}  // namespace

TEST_CASE("each channel by its own rule, pixel by pixel") {
  Files files;
  const PixelBounds half{2, 0, 6, 6};
  const Image a = made_slice(1, 3), b = made_slice(2, 5, half);
  files.write("a.exr", a);
  files.write("b.exr", b);
  const Image m = files.merge({"a.exr", "b.exr"});
  CHECK(m.data == a.data);
  CHECK(m.display == a.display);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      const bool both = x >= half.x0 && x < half.x1;
      const double n = both ? 5 : 0, total = 3 + n;
      const auto of = [&](const char* name) { return both ? value(b, name, x, y) : 0.0; };
      for (const char* mean : {"R", "A"}) {
        CHECK(value(m, mean, x, y) == doctest::Approx((3.0 * value(a, mean, x, y) + n * of(mean)) / total));
      }
      const double hits = value(a, "SurfaceCount", x, y) + of("SurfaceCount");
      const double z = value(a, "Z", x, y) * value(a, "SurfaceCount", x, y) + of("Z") * of("SurfaceCount");
      CHECK(value(m, "SurfaceCount", x, y) == hits);
      CHECK(value(m, "Z", x, y) == doctest::Approx(hits > 0 ? z / hits : 0));
      CHECK(value(m, "Variance.R", x, y) ==
            test::relative((9 * value(a, "Variance.R", x, y) + n * n * of("Variance.R")) / (total * total)));
      CHECK(value(m, "Dof.R", x, y) == doctest::Approx(total * total / (9 + n * n)));
      CHECK(value(m, "SampleCount", x, y) == total);
    }
  }
  CHECK(m.attributes.at("tyndall/samples") == Attribute("3..8"));
  CHECK(m.attributes.at("tyndall/seed") == Attribute("1, 2"));
  CHECK(m.attributes.at("tyndall/slices") == Attribute("seed 1 samples 3 crop 0,8,0,6; seed 2 samples 5 crop 2,6,0,6"));
  CHECK(m.attributes.at("tyndall/options") == Attribute("--lights power"));
  CHECK(m.attributes.at("software") == Attribute("Tyndall"));
  CHECK(m.find("Dof.G") == nullptr);
}

TEST_CASE("adaptive renders are merged by what they weigh, not by their samples; other renders by these") {
  Files files;
  Image adaptive = made_slice(1, 3);
  const Image plain = made_slice(2, 5);
  adaptive.attributes["tyndall/samples"] = "2..64";
  Rng rng(3);
  for (float& count : adaptive.add_channel("SampleCount").values) count = 2 + std::floor(62 * rng.uniform());
  for (float& weight : adaptive.add_channel("SampleWeight").values) weight = 16;
  files.write("a.exr", adaptive);
  files.write("b.exr", plain);
  const Image m = files.merge({"a.exr", "b.exr"});
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      const auto of = [&](const char* name) { return std::pair{value(adaptive, name, x, y), value(plain, name, x, y)}; };
      const auto [a, b] = of("R");
      const auto [va, vb] = of("Variance.R");
      CHECK(value(m, "R", x, y) == doctest::Approx((16 * a + 5 * b) / 21));
      CHECK(value(m, "Variance.R", x, y) == test::relative((256 * va + 25 * vb) / (21 * 21)));
      CHECK(value(m, "SampleCount", x, y) == value(adaptive, "SampleCount", x, y) + 5);
      CHECK(value(m, "SampleWeight", x, y) == 21);
    }
  }
  files.write("m.exr", m);
  files.write("c.exr", made_slice(4, 7));
  const Image again = files.merge({"m.exr", "c.exr"});
  CHECK(value(again, "R", 3, 2) == doctest::Approx((21 * value(m, "R", 3, 2) + 7 * value(made_slice(4, 7), "R", 3, 2)) / 28));
  CHECK(files.merge({"b.exr", "c.exr"}).find("SampleWeight") == nullptr);
}

TEST_CASE("attributes: kept where equal, listed or summed where they differ") {
  Files files;
  Image a = made_slice(7, 4), b = made_slice(3, 4), c = made_slice(5, 8);
  b.attributes["tyndall/options"] = "--lights tree";
  b.attributes["tyndall/scene"] = "there.pbrt";
  double seconds = 1;
  for (Image* image : {&a, &b, &c}) {
    image->attributes["tyndall/renderTime"] = seconds++;
    image->attributes["tyndall/date"] = "2026-01-0" + std::to_string(static_cast<int>(seconds));
  }
  files.write("a.exr", a), files.write("b.exr", b), files.write("c.exr", c);
  files.write("ab.exr", files.merge({"a.exr", "b.exr"}));
  for (const Image& m : {files.merge({"ab.exr", "c.exr"}), files.merge({"a.exr", "c.exr", "b.exr"})}) {
    CHECK(m.attributes.at("tyndall/samples") == Attribute(16));
    CHECK(m.attributes.at("tyndall/seed") == Attribute("3, 5, 7"));
    CHECK(m.attributes.at("tyndall/options") == Attribute("--lights power | --lights tree"));
    CHECK(m.attributes.at("tyndall/renderTime") == Attribute(6.0));
    CHECK(m.attributes.at("tyndall/date") == Attribute("2026-01-04"));
    CHECK_FALSE(m.attributes.contains("tyndall/scene"));
  }
}

TEST_CASE("any order gives the same bytes") {
  Files files;
  const auto with_blue = [](Image image, float blue) {
    for (Channel& c : image.channels) {
      if (c.name == "B") std::fill(c.values.begin(), c.values.end(), blue);
    }
    return image;
  };
  // The first two cancel, but what is added between them is lost: a sum that depends on the order shows it.
  files.write("a.exr", with_blue(made_slice(1, 4), 0x1p70f)), files.write("b.exr", with_blue(made_slice(2, 8), -0x1p69f));
  files.write("c.exr", made_slice(3, 64, {0, 0, 5, 5})), files.write("d.exr", made_slice(3, 2, {5, 0, 8, 6}));
  std::vector<std::string> names{"a.exr", "b.exr", "c.exr", "d.exr"};
  const std::string bytes = files.bytes(files.merge(names));
  int different = 0;
  while (std::next_permutation(names.begin(), names.end())) different += files.bytes(files.merge(names)) == bytes ? 0 : 1;
  CHECK(different == 0);
}

TEST_CASE("merging what is merged gives what merging all does") {
  Files files;
  files.write("a.exr", made_slice(1, 3)), files.write("b.exr", made_slice(2, 5, {1, 2, 8, 6}));
  files.write("c.exr", made_slice(3, 64, {0, 0, 5, 5})), files.write("d.exr", made_slice(3, 2, {5, 0, 8, 6}));
  const Image all = files.merge({"a.exr", "b.exr", "c.exr", "d.exr"});
  files.write("ab.exr", files.merge({"a.exr", "b.exr"}));
  files.write("cd.exr", files.merge({"c.exr", "d.exr"}, {.fill_black = true}));
  files.write("cda.exr", files.merge({"cd.exr", "a.exr"}));
  for (const Image& m : {files.merge({"ab.exr", "cd.exr"}), files.merge({"b.exr", "cda.exr"})}) {
    CHECK(m.attributes == all.attributes);
    REQUIRE(m.channels.size() == all.channels.size());
    double worst = 0;
    for (const Channel& c : all.channels) {
      const Channel* other = m.find(c.name);
      REQUIRE(other != nullptr);
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        worst = std::max(worst, std::abs(double{c.values[i]} - other->values[i]) / std::max(1e-3, double{c.values[i]}));
      }
    }
    CHECK(worst < 4e-7);  // a few roundings to float
  }
}

TEST_CASE("pixels that no slice holds are an error that says where, or black") {
  Files files;
  files.write("a.exr", made_slice(1, 2, {0, 0, 3, 6}));
  files.write("b.exr", made_slice(1, 2, {5, 0, 8, 4}));
  CHECK_SAYS(files.refusal({"a.exr", "b.exr"}), "leave 18 pixels within 3,8,0,6 empty");
  CHECK_SAYS(files.refusal({"a.exr", "b.exr"}), "--fill-black");
  const Image m = files.merge({"a.exr", "b.exr"}, {.fill_black = true});
  CHECK(m.data == PixelBounds{0, 0, 8, 6});
  CHECK(value(m, "R", 4, 2) == 0);
  CHECK(value(m, "SampleCount", 4, 2) == 0);
  CHECK(value(m, "SampleCount", 5, 3) == 2);
  CHECK(m.attributes.at("tyndall/samples") == Attribute("0..2"));
  files.write("m.exr", m);
  files.write("rest.exr", made_slice(1, 2, {3, 0, 5, 6}));
  CHECK_SAYS(files.refusal({"m.exr", "rest.exr"}), "leave 6 pixels within 5,8,4,6 empty");
}

TEST_CASE("what does not go together is refused with what is wrong and where") {
  Files files;
  const auto altered = [&](const std::string& name, const auto& alter, std::uint64_t seed = 2) {
    Image image = made_slice(seed, 2);
    alter(image);
    files.write(name, image);
    return files.refusal({"a.exr", name});
  };
  files.write("a.exr", made_slice(1, 2));

  const std::string hash = altered("b.exr", [](Image& i) { i.attributes["tyndall/sceneHash"] = "fedcba9876543210"; });
  CHECK_SAYS(hash, "b.exr: scene hash fedcba9876543210 differs from 0123456789abcdef of");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.display = {0, 0, 9, 6}; }), "frame is 9x6, that of");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.display = {0, 0, 7, 6}; }), "outside its frame");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.channels[0].name = "N.X"; }), "a.exr has R; only");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.attributes.erase("tyndall/sceneHash"); }), "has no attribute tyndall/sceneHash");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.attributes.erase("tyndall/seed"); }), "has no attribute tyndall/seed");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.attributes["tyndall/samples"] = "two"; }), "tyndall/samples is not what");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.attributes["tyndall/seed"] = "seven"; }), "are damaged");
  for (const char* text :
       {"", ";", "seed 1", "seed 1 samples 0 crop 0,8,0,6", "seed 1 samples 2 crop 0,8,0,6 more",
        "seed 1 samples 2 crop 8,8,0,6", "seed 1 samples 2 crop 0,9,0,6", "seed 1 samples 2 crop -2147483648,2147483647,0,6",
        "seed 1 samples 99999999999 crop 0,8,0,6", "seed 1 samples 2 crop 0.8.0.6"}) {
    CHECK_SAYS(altered("b.exr", [&](Image& i) { i.attributes["tyndall/slices"] = text; }), "attribute tyndall/slices is ");
  }
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.attributes["tyndall/slices"] = "seed 2 samples 2 crop 0,8,0,6"; }),
             "without SampleCount");
  CHECK_SAYS(altered("b.exr", [](Image& i) { i.attributes["tyndall/samples"] = 1; }), "1 sample a pixel");

  // The same samples twice, found through what is merged as well.
  CHECK_SAYS(altered(
                 "b.exr", [](Image&) {}, 1),
             "seed 1 is in ");
  CHECK_SAYS(files.refusal({"a.exr", "a.exr"}), "a.exr: is given twice");
  CHECK_SAYS(files.refusal({"a.exr", "./a.exr"}), "both hold pixels 0,8,0,6");
  files.write("c.exr", made_slice(3, 2, {4, 4, 8, 6})), files.write("d.exr", made_slice(3, 2, {0, 0, 5, 5}));
  files.write("ac.exr", files.merge({"a.exr", "c.exr"}));
  CHECK_SAYS(files.refusal({"d.exr", "ac.exr"}), "seed 3 is in");
  CHECK_SAYS(files.refusal({"d.exr", "ac.exr"}), "both hold pixels 4,5,4,5");

  Image uncounted = made_slice(1, 2);
  uncounted.channels.back().name = "Other";
  files.write("u.exr", uncounted);
  CHECK_SAYS(files.refusal({"u.exr"}), "has Z but not SurfaceCount");
  CHECK_SAYS(files.refusal({"missing.exr"}), "missing.exr: file not found");
}

TEST_CASE("mattes are merged by their ids, whatever their ranks, and then cut to six") {
  const std::vector<std::vector<MatteCoverage>> of_a{
      {{1u << 30, 0.6f}, {2u << 28, 0.3f}}, {{7u << 26, 0.2f}, {9u << 26, 0.19f}, {11u << 26, 0.18f}, {13u << 26, 0.17f}}};
  const std::vector<std::vector<MatteCoverage>> of_b{
      {{2u << 28, 0.9f}}, {{15u << 26, 0.25f}, {13u << 26, 0.24f}, {17u << 26, 0.02f}, {19u << 26, 0.01f}}};
  const auto made = [](std::uint64_t seed, int samples, const auto& covers, const std::string& manifest) {
    Image image = made_slice(seed, samples);
    MatteWriter writer(image, "CryptoObject");
    for (std::size_t pixel = 0; pixel < 2; ++pixel) writer.set(pixel, covers[pixel]);
    image.attributes[manifest_attribute("CryptoObject")] = manifest;
    return image;
  };
  Files files;
  files.write("a.exr", made(1, 2, of_a, "{}")), files.write("b.exr", made(2, 6, of_b, "{}"));
  const Image merged = files.merge({"a.exr", "b.exr"});
  const MatteReader mattes(merged, "CryptoObject");
  const auto first = mattes.at(0), second = mattes.at(1);
  REQUIRE(first.size() == 2);
  CHECK(first[0].id == 2u << 28);
  CHECK(first[0].coverage == doctest::Approx((2 * 0.3 + 6 * 0.9) / 8));
  CHECK(first[1].id == 1u << 30);
  CHECK(first[1].coverage == doctest::Approx(2 * 0.6 / 8));
  REQUIRE(second.size() == kMatteRanks);
  CHECK(second[0].id == 13u << 26);
  CHECK(second[0].coverage == doctest::Approx((2 * 0.17 + 6 * 0.24) / 8));
  CHECK(second[1].id == 15u << 26);
  CHECK(second[5].id == 17u << 26);
  CHECK(mattes.at(2).empty());
  CHECK(merged.attribute<std::string>(manifest_attribute("CryptoObject")));
  CHECK(files.bytes(merged) == files.bytes(files.merge({"b.exr", "a.exr"})));

  files.write("other.exr", made(3, 2, of_a, "{\"x\":\"3f800000\"}"));
  CHECK(contains(files.refusal({"a.exr", "other.exr"}), "other.exr: its CryptoObject has other names than in "));
  files.write("none.exr", made_slice(4, 2));
  CHECK(contains(files.refusal({"a.exr", "none.exr"}), "CryptoObject00.A"));
}

TEST_CASE("crops of one seed, merged, are the whole picture bit for bit; two seeds are the mean of their samples") {
  const std::string text = view({.eye = {0, 0.3f, -3}, .look = {}, .fov_degrees = 40, .resolution = 20, .max_depth = 3}) +
                           point_light({1, 2, -2}, 9) + block("Shape \"sphere\" \"float radius\" 0.5\n") +
                           homogeneous("m", {.sigma_a = Rgb(0.2f), .sigma_s = Rgb(0.7f)}) +
                           medium_box("m", "", {{-1, -1, -1}, {1, 1, 1}});
  Scene scene = read_scene_text(text, "test.pbrt").scene;
  std::vector<std::string> aovs;
  for (const std::string_view name : aov_names()) aovs.emplace_back(name);
  const auto render_crop = [&](PixelBounds crop, std::uint64_t seed) {
    scene.film.crop = crop;
    return Subject(scene, {}).render(6, seed, aovs);
  };
  Files files;
  const Image whole = render_crop({0, 0, 20, 20}, 1), other = render_crop({0, 0, 20, 20}, 2);
  files.write("left.exr", render_crop({0, 0, 9, 20}, 1)), files.write("right.exr", render_crop({9, 0, 20, 20}, 1));
  files.write("whole.exr", whole), files.write("other.exr", other);

  const Image joined = files.merge({"right.exr", "left.exr"});
  CHECK(joined.attributes.at("tyndall/sceneHash") == whole.attributes.at("tyndall/sceneHash"));
  CHECK(joined.attributes.at("worldToNDC") == whole.attributes.at("worldToNDC"));
  for (const Channel& c : whole.channels) CHECK_MESSAGE(joined.find(c.name)->values == c.values, c.name);

  const Image both = files.merge({"whole.exr", "other.exr"});
  const std::vector<std::pair<std::string, std::string>> counted{{"R", "SampleCount"},
                                                                 {"Z", "SurfaceCount"},
                                                                 {"Zvol", "VolumeCount"},
                                                                 {"Replicate.R", "Replicate.SampleCount"},
                                                                 {"Replicate.Z", "Replicate.SurfaceCount"},
                                                                 {"Replicate.Zvol", "Replicate.VolumeCount"}};
  for (const auto& [name, count] : counted) {
    double worst = 0;
    for (std::size_t i = 0; i < 400; ++i) {
      const double n = whole.find(count)->values[i], m = other.find(count)->values[i];
      const double mean = n + m > 0 ? (n * whole.find(name)->values[i] + m * other.find(name)->values[i]) / (n + m) : 0;
      worst = std::max(worst, std::abs(both.find(name)->values[i] - mean));
    }
    CHECK(worst < 1e-6);
  }
}
