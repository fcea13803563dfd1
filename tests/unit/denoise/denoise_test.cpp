/// The denoiser on pictures whose truth and noise are known.
#include "tyndall/denoise.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "fake_render.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

using test::always;
using test::FakeRender;
using test::OfPixel;

float wave(int x, int y) { return 2 + std::sin(0.2f * static_cast<float>(x)) * std::cos(0.15f * static_cast<float>(y)); }
/// A texture whose contrast is a fifth of a sample's deviation.
float stripes(int x, int) { return x / 3 % 2 == 0 ? 0.9f : 0.7f; }

struct Errors {
  double before = 0, after = 0, stated = 0;
};

Errors errors_of(const Image& image, const OfPixel& truth) {
  Errors e;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const std::size_t i = image.data.index(x + image.data.x0, y + image.data.y0);
      const auto squared = [&](const char* channel) {
        const double d = static_cast<double>(image.find(channel)->values[i]) - static_cast<double>(truth(x, y));
        return d * d;
      };
      e.before += squared("noisy.G");
      e.after += squared("G");
      e.stated += image.find("Mse.G")->values[i];
    }
  }
  return e;
}

std::string refusal(const Image& image) {
  try {
    denoise(image, {}, "x.exr");
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::scene);
    return e.what();
  }
  return "denoised";
}

}  // namespace

TEST_CASE("noise goes, and what is left is as large as stated") {
  const FakeRender render{.width = 96, .height = 72};
  Image image = render.image();
  render.add_rgb(image, "", wave, always(1));
  const Denoised result = denoise(image);
  const Errors e = errors_of(result.image, wave);
  CHECK(e.before / e.after > 8);
  CHECK(e.stated / e.after > 0.5);
  CHECK(e.stated / e.after < 2);
  CHECK(result.report.relmse < 0.2 * result.report.noisy_relmse);
  CHECK(result.report.missing.size() == 5);
  CHECK(result.image.find("noisy.R")->values == image.find("R")->values);
}

TEST_CASE("a texture far below the noise comes through by its feature") {
  const FakeRender render{.width = 96, .height = 72};
  const auto error_with = [&](bool feature) {
    Image image = render.image();
    const OfPixel truth = [](int x, int y) { return stripes(x, y) * wave(x, y); };
    render.add_rgb(image, "", truth, always(1));
    if (feature) render.add_rgb(image, "Albedo.", stripes, always(0.01f));
    return errors_of(denoise(image).image, truth).after;
  };
  CHECK(error_with(true) < 0.5 * error_with(false));
}

TEST_CASE("each component is filtered by its own noise, and they add up") {
  // Light through one component is noisy and smooth, through the other free of noise and sharp.
  const FakeRender render{.width = 96, .height = 72};
  const OfPixel sharp = [](int x, int y) { return (x / 2 + y / 2) % 2 == 0 ? 1.0f : 0.0f; };
  Image image = render.image();
  render.add_rgb(image, "SurfaceDirect.", sharp, always(0.02f));
  render.add_rgb(image, "SurfaceIndirect.", wave, always(1));
  for (const char* none : {"Emission.", "VolumeDirect.", "VolumeIndirect."}) render.add_rgb(image, none, always(0), always(0));
  for (const std::string suffix : {"R", "G", "B"}) {
    for (const std::string replicate : {"", "Replicate."}) {
      std::vector<float> sum = image.find(replicate + "SurfaceDirect." + suffix)->values;
      const auto& other = image.find(replicate + "SurfaceIndirect." + suffix)->values;
      std::transform(sum.begin(), sum.end(), other.begin(), sum.begin(), std::plus<>());
      image.add_channel(replicate + suffix).values = sum;
    }
  }
  const Denoised result = denoise(image, {.components = true});
  const Errors e = errors_of(result.image, [&](int x, int y) { return sharp(x, y) + wave(x, y); });
  CHECK(e.before / e.after > 8);
  CHECK(e.stated / e.after > 0.5);
  CHECK(e.stated / e.after < 2);
  const auto value = [&](const char* channel) { return result.image.find(channel)->values[100]; };
  CHECK(value("SurfaceDirect.G") + value("SurfaceIndirect.G") == doctest::Approx(value("G")));
}

// From seed to seed stated / true scatters by 0.28 in its logarithm, around 1.1 to 1.4: bounds are three of that away. What is
// bright has a hundred times the squared error of what is dark.
TEST_CASE("errors are stated for the channel that has them, and for the dark beside the bright") {
  const FakeRender render{.width = 96, .height = 72};
  const OfPixel light = [](int x, int) { return x < 48 ? 20.0f : 2.0f; };
  Image image = render.image();
  for (const char* channel : {"R", "G", "B"}) {
    const float noise = channel[0] == 'B' ? 0.01f : 1.0f;
    render.add(image, channel, light, [&](int x, int y) { return noise * light(x, y); });
  }
  const Image result = denoise(image).image;
  for (const char* channel : {"R", "B"}) {
    for (const bool dark : {false, true}) {
      double after = 0, stated = 0;
      for (int y = 0; y < 72; ++y) {
        for (int x = dark ? 48 : 0; x < (dark ? 96 : 48); ++x) {
          const std::size_t i = image.data.index(x, y);
          after += std::pow(double{result.find(channel)->values[i]} - double{light(x, y)}, 2);
          stated += result.find("Mse." + std::string(channel))->values[i];
        }
      }
      INFO(std::string(channel) << std::string(dark ? " dark" : " bright") << " stated / true " << stated / after);
      CHECK(stated / after > 0.45);
      CHECK(stated / after < 2.8);
    }
  }
}

TEST_CASE("without noise, and with ever less of it, the picture stays") {
  const FakeRender render;
  const OfPixel edges = [](int x, int y) { return x * 7 % 11 + (y * 5 % 7 == 0 ? 100.0f : 0.0f); };
  for (const float deviation : {0.0f, 1e-3f}) {
    Image image = render.image();
    render.add_rgb(image, "", edges, always(deviation));
    const Errors e = errors_of(denoise(image).image, edges);
    CHECK(e.after <= 1.05 * e.before + 1e-9);
  }
}

TEST_CASE("a firefly in one half does not spread, and black stays black") {
  const FakeRender render{.width = 96, .height = 80};
  Image image = render.image();
  const OfPixel half_black = [](int x, int) { return x < 48 ? 0.0f : 1.0f; };
  render.add_rgb(image, "", half_black, [&](int x, int y) { return 0.5f * half_black(x, y); });
  const Image plain = denoise(image).image;
  const std::size_t at = image.data.index(70, 40);
  for (const char* suffix : {"R", "G", "B"}) {
    for (Channel& channel : image.channels) {
      if (channel.name == suffix) channel.values[at] += 5e4f;  // 1e5 in the even half
      if (channel.name == "Replicate." + std::string(suffix)) channel.values[at] += 1e5f;
    }
  }
  const Image with = denoise(image).image;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 96; ++x) {
      const std::size_t i = image.data.index(x, y);
      const float change = std::abs(with.find("G")->values[i] - plain.find("G")->values[i]);
      REQUIRE(change < 0.2f);
      if (x < 40) REQUIRE(std::abs(with.find("G")->values[i]) < 1e-3f);
    }
  }
}

// 304 pixels are of 6, which either half finds with a chance of 0.3 and then as 20: where one alone does, it passes for a
// firefly. The share that is confirmed is known to 0.04, its square, and so the error, to 27 %.
TEST_CASE("what is taken out for a firefly is a stated error as often as the other half confirms such") {
  const FakeRender render{.width = 190, .height = 160};
  for (const bool there : {true, false}) {
    Image image = render.image();
    render.add_rgb(image, "", always(1), always(0.2f));
    Rng rng(4);
    std::vector<std::size_t> found_once;
    for (std::size_t i = 0; i < 304; ++i) {
      const std::size_t at = image.data.index(static_cast<int>(5 + 10 * (i % 19)), static_cast<int>(5 + 10 * (i / 19)));
      const bool even = rng.uniform() < 0.3f, odd = rng.uniform() < 0.3f && (there || !even);
      for (const char* suffix : {"R", "G", "B"}) {
        for (Channel& channel : image.channels) {
          if (channel.name == suffix) channel.values[at] += 10.0f * static_cast<float>(even + odd);
          if (channel.name == "Replicate." + std::string(suffix)) channel.values[at] += even ? 20.0f : 0.0f;
        }
      }
      if (even != odd) found_once.push_back(at);
    }
    const Image result = denoise(image).image;
    double after = 0, stated = 0;
    for (const std::size_t i : found_once) {
      after += std::pow(double{result.find("G")->values[i]} - (there ? 7 : 1), 2);
      stated += result.find("Mse.G")->values[i];
    }
    INFO("light " << there << ", stated / true " << stated / after);
    const double mean = stated / static_cast<double>(found_once.size());
    if (there) {
      CHECK(stated / after > 0.5);
      CHECK(stated / after < 2);
    } else {
      CHECK(mean < 0.1);  // of 20^2 / 4 as rendered
    }
  }
}

// Nine of ten samples are black: what is rare must not be taken for fireflies. 64x64 blocks hold 4,096 x 16 samples, so that
// one block's mean is known to 1.2 %.
TEST_CASE("rare light keeps its energy, block by block") {
  const FakeRender render{.width = 128, .height = 128};
  Image image = render.image();
  Rng rng(9);
  std::vector<float> all(image.data.size()), even(image.data.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int s = 0; s < 16; ++s) {
      const float value = rng.uniform() < 0.1f ? 10.0f : 0.0f;
      all[i] += value / 16;
      if (s % 2 == 0) even[i] += value / 8;
    }
  }
  for (const char* suffix : {"R", "G", "B"}) {
    image.add_channel(suffix).values = all;
    image.add_channel("Replicate." + std::string(suffix)).values = even;
  }
  const Image result = denoise(image).image;
  const Errors e = errors_of(result, always(1));
  CHECK(e.before > 20 * e.after);
  for (int block = 0; block < 4; ++block) {
    double before = 0, after = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const std::size_t i = image.data.index(block % 2 * 64 + x, block / 2 * 64 + y);
        before += image.find("G")->values[i];
        after += result.find("G")->values[i];
      }
    }
    CHECK(after / before == doctest::Approx(1).epsilon(0.024));
  }
}

TEST_CASE("the same bits for any number of threads and any data window") {
  const FakeRender render{.width = 70, .height = 53, .samples = 5};
  Image image = render.image();
  render.add_rgb(image, "", wave, always(1));
  render.add_rgb(image, "Transmittance.", always(0.5f), always(0.1f));
  const Image one = denoise(image, {.threads = 1}).image;
  for (const int threads : {2, 3}) {
    const Image other = denoise(image, {.threads = threads}).image;
    for (std::size_t c = 0; c < one.channels.size(); ++c) CHECK(one.channels[c].values == other.channels[c].values);
  }
  image.data = {100, 7, 170, 60};
  image.display = {0, 0, 200, 100};
  CHECK(denoise(image).image.find("R")->values == one.find("R")->values);
}

TEST_CASE("pictures of any size and brightness are denoised") {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{2, 50}, std::pair{49, 3}, std::pair{50, 50}}) {
    const FakeRender render{.width = width, .height = height, .samples = 2};
    Image image = render.image();
    render.add_rgb(image, "", always(1e5f), always(3e4f));
    const Image result = denoise(image).image;
    for (const Channel& channel : result.channels)
      CHECK(std::all_of(channel.values.begin(), channel.values.end(), [](float v) { return std::isfinite(v); }));
  }
}

TEST_CASE("halves are told apart by their counts, pixel by pixel") {
  // Merged: some pixels have 3 even samples of 5, others 8 of 16, one none.
  const FakeRender few{.width = 48, .height = 40, .samples = 5}, many{.width = 48, .height = 40, .samples = 16};
  Image image = few.image(), other = many.image();
  few.add_rgb(image, "", wave, always(1));
  many.add_rgb(other, "", wave, always(1));
  std::vector<float> counts(image.data.size()), even(image.data.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const bool right = i % 48 >= 24;
    counts[i] = right ? 16 : 5;
    even[i] = right ? 8 : 3;
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      if (right) image.channels[c].values[i] = other.channels[c].values[i];
    }
  }
  counts[0] = even[0] = 0;
  for (Channel& channel : image.channels) channel.values[0] = 0;
  image.add_channel("SampleCount").values = counts;
  image.add_channel("Replicate.SampleCount").values = even;
  const Errors e = errors_of(denoise(image).image, wave);
  CHECK(e.before / e.after > 4.5);  // 5.0 +- 0.1, by three seeds
}

TEST_CASE("images without replicates are refused with what to do") {
  const FakeRender render;
  Image image = render.image();
  image.add_channel("R"), image.add_channel("G"), image.add_channel("B");
  CHECK(refusal(image).find("x.exr: holds no replicates") == 0);
  CHECK(refusal(image).find("--aov Denoise") != std::string::npos);
  Image one = FakeRender{.samples = 1}.image();
  FakeRender{.samples = 1}.add_rgb(one, "", wave, always(1));
  CHECK(refusal(one).find("one sample a pixel") != std::string::npos);
  Image twice = render.image();
  render.add_rgb(twice, "", wave, always(1));
  CHECK(refusal(denoise(twice).image).find("denoised already") != std::string::npos);
}

TEST_CASE("light groups: each comes close to its own truth, and together they are the filtered picture") {
  const FakeRender render{.width = 64, .height = 48};
  Image image = render.image();
  const OfPixel left = [](int x, int) { return x < 32 ? 1.5f : 0.25f; },
                rest = [&](int x, int y) { return wave(x, y) - left(x, y); };
  render.add_rgb(image, "", wave, always(1));
  render.add_rgb(image, "LightGroup.left.", left, always(0.6f));
  render.add_rgb(image, "LightGroup.default.", rest, always(0.6f));
  render.add_rgb(image, "LightGroup.dark.", always(0), always(0));
  const Image clean = denoise(image).image;
  double before = 0, after = 0;
  for (std::size_t i = 0; i < clean.find("R")->values.size(); ++i) {
    const double truth = i % 64 < 32 ? 1.5 : 0.25;
    before += std::pow(image.find("LightGroup.left.R")->values[i] - truth, 2);
    after += std::pow(clean.find("LightGroup.left.R")->values[i] - truth, 2);
    const double sum = double{clean.find("LightGroup.left.R")->values[i]} + clean.find("LightGroup.default.R")->values[i] +
                       clean.find("LightGroup.dark.R")->values[i];
    CHECK(sum == doctest::Approx(clean.find("R")->values[i]).epsilon(3e-7));
    CHECK(clean.find("LightGroup.dark.R")->values[i] == 0);
  }
  CHECK(before / after > 2);
  CHECK(clean.find("Replicate.LightGroup.left.R")->values == image.find("Replicate.LightGroup.left.R")->values);
  // Without replicates they stay.
  std::erase_if(image.channels, [](const Channel& c) { return c.name.starts_with("Replicate.LightGroup."); });
  CHECK(denoise(image).image.find("LightGroup.left.R")->values == image.find("LightGroup.left.R")->values);
}

}  // namespace tyndall
