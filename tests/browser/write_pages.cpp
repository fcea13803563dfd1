// write_pages FOLDER [WIDTH HEIGHT]: two compare pages, one of them with denoised variants, and a regress page from made-up
// results, each beside its JSON, for the tests that open them in a browser. Names are hostile where a scene could make them so.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>

#include "report/page.h"

using namespace tyndall;
using nlohmann::ordered_json;

namespace {

constexpr const char* kHostile = "</script><b>&\"'";

struct Size {
  int width = 160, height = 90;

  /// Of pictures, which are crops of a frame.
  PixelBounds data() const { return {7, 3, 7 + width, 3 + height}; }
};

/// A ball in front of a bright haze. Pixel 0, 0 is (0.25, 0.5, 2), exact in half floats.
Rgb clean_color(const Size& size, int x, int y) {
  if (x == 0 && y == 0) return {0.25f, 0.5f, 2};
  const float u = (x + 0.5f) / size.width, v = (y + 0.5f) / size.height, aspect = static_cast<float>(size.width) / size.height;
  const float ball = std::hypot((u - 0.6f) * aspect, v - 0.55f) / 0.27f;
  const float haze = 2.5f * std::exp(-30 * ((u - 0.22f) * (u - 0.22f) * aspect * aspect + (v - 0.3f) * (v - 0.3f)));
  const Rgb fog = Rgb{0.05f, 0.08f, 0.13f} + haze * Rgb{1.0f, 0.62f, 0.3f};
  if (ball >= 1) return fog + (v > 0.82f ? Rgb{0.12f, 0.1f, 0.09f} : Rgb{});
  const float z = std::sqrt(1 - ball * ball),
              light = std::max(0.0f, 0.75f * z - 0.9f * (u - 0.6f) * aspect - 0.8f * (v - 0.55f));
  return Rgb{0.02f, 0.03f, 0.05f} + light * Rgb{0.7f, 0.45f, 0.35f};
}

Image picture(const Size& size, float noise, unsigned seed) {
  std::mt19937 engine(seed);
  std::gamma_distribution<float> gamma(1 / std::max(noise * noise, 1e-6f), std::max(noise * noise, 1e-6f));  // mean 1
  Image image;
  image.data = image.display = size.data();
  for (const char* name : {"R", "G", "B"}) image.add_channel(name);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Rgb color = clean_color(size, x, y) * (noise > 0 ? gamma(engine) : 1);
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
      for (int k = 0; k < 3; ++k) image.channels[static_cast<std::size_t>(k)].values[i] = color[k];
    }
  return image;
}

struct Strategy {
  std::string name, options;
  double error, efficiency, slope;
  int samples;
};

const std::array<Strategy, 5> kStrategies{{{"tree-binary", "--lights tree-binary", 0.0312, 1, -1.02, 212},
                                           {"tree", "--lights tree --splitting 0.5", 0.00914, 3.41234567890123, -1.06, 148},
                                           {"power", "--lights power", 0.174, 0.179, -0.99, 305},
                                           {"uniform", "--lights uniform", 0.42, 0.0743, -0.81, 311},
                                           {kHostile, "--lights '</script><!-- <script>'", 0.0251, 1.24, -1.01, 187}}};

ordered_json interval(double value) { return {{"relative", value}, {"low", value * 0.9}, {"high", value * 1.12}}; }

ordered_json variant(const Strategy& s) {
  ordered_json points = ordered_json::array();
  for (double part = 1.0 / 64; part <= 1; part *= 2) {
    const double relmse = s.error * std::pow(part, s.slope);
    points.push_back({{"seconds", 10.02 * part},
                      {"samples", std::max(1, static_cast<int>(s.samples * part))},
                      {"mse", relmse / 3},
                      {"relmse", relmse},
                      {"relmse_low", relmse * 0.8},
                      {"relmse_high", relmse * 1.3}});
  }
  const bool biased = s.slope > -0.9;
  return {{"name", s.name},
          {"options", s.options},
          {"build_seconds", 0.0123},
          {"samples", s.samples},
          {"seconds", 10.02},
          {"mse", s.error / 3},
          {"relmse", s.error},
          {"relmse_trimmed", s.error * 0.8},
          {"mape", std::sqrt(s.error)},
          {"smape", std::sqrt(s.error) * 0.9},
          {"slope", s.slope},
          {"slope_low", s.slope - 0.06},
          {"slope_high", s.slope + 0.05},
          {"slope_note", biased ? "flatter than -1: a sign of bias" : ""},
          {"efficiency", interval(s.efficiency)},
          {"efficiency_trimmed",
           biased ? ordered_json{{"relative", nullptr}, {"low", nullptr}, {"high", nullptr}} : interval(s.efficiency * 0.97)},
          {"work",
           {{"paths", 0.31},
            {"media", 0.2},
            {"vertex_lights", 0.17},
            {"segment_lights", 0.12},
            {"shadow_rays", 0.1},
            {"sharing", 0.08},
            {"guiding", 0.02}}},
          {"error_parts",
           {{"Emission", 0.02},
            {"SurfaceDirect", 0.2},
            {"SurfaceIndirect", 0.4},
            {"VolumeDirect", 0.03},
            {"VolumeIndirect", 0.35}}},
          {"mean_rgb", {0.2123, 0.1871, 0.1502}},
          {"image", "variant.exr"},
          {"health", {{"non_finite", biased ? 3 : 0}, {"majorant_violations", 0}, {"caps_hit", 0}, {"parity_errors", 0}}},
          {"checkpoints", points}};
}

ordered_json machine() { return {{"cpu", "Example CPU 9000"}, {"threads", 2}, {"memory_gib", 24}, {"system", "Linux 6.1"}}; }

ordered_json compare_results(const Size& size) {
  ordered_json variants = ordered_json::array();
  for (const Strategy& s : kStrategies) variants.push_back(variant(s));
  variants[1]["least_samples"] = 32;
  variants[1]["most_samples"] = 352;
  return {
      {"version", "0.2.0"},
      {"scene", "plume_hall.pbrt"},
      {"reference",
       {{"source", "rendered"},
        {"file", "reference.exr"},
        {"samples", 2048},
        {"seed", 123},
        {"seconds", 98.1},
        {"relmse", 0.0009},
        {"noise_subtracted", true}}},
      {"machine", machine()},
      {"settings",
       {{"budget", "10 s"},
        {"seeds", {1, 2, 3, 4, 5}},
        {"width", size.width},
        {"height", size.height},
        {"eps", 0.01},
        {"options", "--max-depth 8"},
        {"command", "tyndall compare plume_hall.pbrt --variants lights --time 10 --max-depth 8 -o report"}}},
      {"warnings", {"uniform: the error falls more slowly than 1/time; it may be biased", std::string("a name: ") + kHostile}},
      {"variants", variants}};
}

/// Of the first two variants, each followed by itself denoised, from two samples on.
ordered_json denoised_results(ordered_json results) {
  ordered_json variants = ordered_json::array();
  for (std::size_t i = 0; i < 2; ++i) {
    ordered_json v = results["variants"][i], denoised = v;
    denoised["name"] = v["name"].get<std::string>() + " denoised";
    denoised["as_rendered"] = v["name"];
    denoised["checkpoints"].erase(0);
    for (ordered_json& point : denoised["checkpoints"]) {
      for (const char* error : {"mse", "relmse", "relmse_low", "relmse_high"}) point[error] = point[error].get<double>() * 0.3;
      point["seconds"] = point["seconds"].get<double>() + 0.2;
    }
    variants.push_back(std::move(v));
    variants.push_back(std::move(denoised));
  }
  results["variants"] = std::move(variants);
  return results;
}

ordered_json layer_test(const std::string& what, bool same) {
  return {{"what", what},
          {"same", same},
          {"verdict", same ? "same: no alarm in 64 blocks" : "differs: 5 alarms in 64 blocks, the mean of G by 2.1 %"},
          {"alarms", same ? 0 : 5},
          {"blocks", 64},
          {"worst_p", same ? 0.0213 : 3.2e-9},
          {"mean_difference", {0.0004, same ? -0.0002 : 0.0211, 0.0001}},
          {"uniformity_p", same ? 0.41 : 0.002}};
}

ordered_json regress_results() {
  const std::array<std::array<std::string, 2>, 7> cases{{{"area_light", "pass"},
                                                         {"cloud", "pass"},
                                                         {"fog", "fail"},
                                                         {"glass_in_smoke", "crash"},
                                                         {kHostile, "fail"},
                                                         {"street", "new"},
                                                         {"furnace", "pass"}}};
  ordered_json list = ordered_json::array();
  double seconds = 1.4;
  for (const auto& [name, status] : cases) {
    const bool failed = status == "fail", crashed = status == "crash";
    ordered_json tests = ordered_json::array();
    if (!crashed)
      tests = {layer_test("RGB", !failed), layer_test("Albedo", true), {{"what", "bytes"}, {"same", true}, {"verdict", ""}}};
    list.push_back({{"name", name},
                    {"status", status},
                    {"seconds", seconds *= 1.17},
                    {"samples", crashed ? ordered_json(nullptr) : ordered_json(64)},
                    {"message", failed    ? "RGB differs from the reference"
                                : crashed ? "the render was ended by signal 11"
                                          : ""},
                    {"tests", tests}});
  }
  return {{"version", "0.2.0"}, {"suite", "tests/regression/suite"},
          {"seed", 7},          {"machine", machine()},
          {"seconds", 130.2},   {"passed", 4},
          {"failed", 3},        {"cases", list}};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) {
    std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
    std::exit(1);
  }
}

/// Blocks of 8 x 8 pixels with 32 to 352 samples.
Image sample_counts(const Size& size) {
  Image image;
  image.data = image.display = size.data();
  std::vector<float>& counts = image.add_channel("Y").values;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      counts[image.data.index(image.data.x0 + x, image.data.y0 + y)] = static_cast<float>(32 * (1 + (x / 8 + y / 8) % 11));
  return image;
}

std::vector<PagePicture> compare_pictures(const Size& size) {
  std::vector<PagePicture> pictures{{"", "reference", picture(size, 0, 0)}};
  unsigned seed = 1;
  for (const Strategy& s : kStrategies)
    pictures.push_back({"", s.name, picture(size, static_cast<float>(std::sqrt(s.error)), seed++)});
  pictures.back().image.channels[0].values[5] = std::numeric_limits<float>::quiet_NaN();
  pictures.push_back({"", "tree samples", sample_counts(size), PagePicture::Kind::samples});
  return pictures;
}

std::vector<PagePicture> denoised_pictures(const Size& size, const ordered_json& results) {
  std::vector<PagePicture> pictures{{"", "reference", picture(size, 0, 0)}};
  for (const auto& v : results["variants"])
    pictures.push_back({"", v["name"], picture(size, v.contains("as_rendered") ? 0.02f : 0.15f, 1)});
  return pictures;
}

std::vector<PagePicture> regress_pictures(const ordered_json& results) {
  std::vector<PagePicture> pictures;
  for (const auto& item : results["cases"]) {
    if (item["status"] == "crash") continue;
    const Size size{64, 64};
    pictures.push_back({item["name"], "reference", picture(size, 0.02f, 1)});
    pictures.push_back({item["name"], "render", picture(size, 0.15f, 2)});
  }
  return pictures;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 4) {
    std::fputs("usage: write_pages FOLDER [WIDTH HEIGHT]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  Size size;
  if (argc == 4) size = {std::atoi(argv[2]), std::atoi(argv[3])};
  const ordered_json compare = compare_results(size), denoised = denoised_results(compare), regress = regress_results();
  write(folder + "/compare.json", compare.dump());
  write(folder + "/compare.html", compare_page(compare, compare_pictures(size)));
  write(folder + "/denoised.json", denoised.dump());
  write(folder + "/denoised.html", compare_page(denoised, denoised_pictures(size, denoised)));
  write(folder + "/regress.json", regress.dump());
  write(folder + "/regress.html", regress_page(regress, regress_pictures(regress)));
}
