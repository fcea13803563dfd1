#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "io/camera_sensor.h"
#include "io/color.h"
#include "io/pbrt_suggest.h"
#include "io/pbrt_view.h"

namespace tyndall::pbrt {
namespace {

constexpr int kMaxResolution = 1 << 20;  // a row or column; more is a mistake

int read_resolution(ParamList& params, std::string_view name, int otherwise) {
  const int value = params.integer(name, otherwise);
  if (value < 1 || value > kMaxResolution)
    throw params.error(name, std::string(name) + " must be from 1 to " + std::to_string(kMaxResolution));
  return value;
}

/// "pixelbounds" x0 x1 y0 y1 in pixels; "cropwindow" the same as fractions, and the stronger of the two.
PixelBounds read_crop(ParamList& params, int width, int height) {
  PixelBounds crop{0, 0, width, height};
  const auto limit = [](int v, int top) { return std::clamp(v, 0, top); };
  if (const auto p = params.integers("pixelbounds"); !p.empty()) {
    if (p.size() != 4) throw params.error("pixelbounds", "pixelbounds takes four integers: x0 x1 y0 y1");
    crop = {limit(p[0], width), limit(p[2], height), limit(p[1], width), limit(p[3], height)};
    if (crop != PixelBounds{p[0], p[2], p[1], p[3]})
      params.reports().warn(params.where("pixelbounds"), "pixelbounds reach beyond the picture; they are cut to it");
  }
  if (const auto c = params.numbers("cropwindow"); !c.empty()) {
    if (c.size() != 4) throw params.error("cropwindow", "cropwindow takes four numbers from 0 to 1: x0 x1 y0 y1");
    const auto pixel = [](float fraction, int size) {
      return static_cast<int>(std::ceil(static_cast<float>(size) * std::clamp(fraction, 0.0f, 1.0f)));
    };
    crop = {pixel(std::min(c[0], c[1]), width), pixel(std::min(c[2], c[3]), height), pixel(std::max(c[0], c[1]), width),
            pixel(std::max(c[2], c[3]), height)};
  }
  const char* name = params.find("cropwindow", {ParamType::number}) ? "cropwindow" : "pixelbounds";
  if (crop.width() < 1 || crop.height() < 1) throw params.error(name, std::string(name) + " leaves no pixel; widen it");
  return crop;
}

float read_iso(ParamList& params) {
  const float iso = params.number("iso", 100);
  if (!(iso > 0)) throw params.error("iso", "iso must be above 0");
  return iso;
}

/// Sensor and white balance become part of the way from Rec.709 to the film's colours.
std::array<float, 9> read_sensor(ParamList& params, const ColorSpace& film_space) {
  const std::string sensor = params.string("sensor", "cie1931");
  const float kelvin = params.number("whitebalance", 0);
  constexpr float kColdest = 1000, kHottest = 100000;
  if (kelvin != 0 && !(kelvin >= kColdest && kelvin <= kHottest))
    throw params.error("whitebalance", "whitebalance must be 0, for none, or from 1000 to 100000 kelvin");
  if (sensor == "cie1931" && kelvin == 0) return film_space.from_rec709;
  Matrix3 film_from_rec709;
  std::copy(film_space.from_rec709.begin(), film_space.from_rec709.end(), film_from_rec709.begin());
  const Xyz white = inverse(film_from_rec709 * rec709_from_xyz()) * Xyz{1, 1, 1};
  const double sum = white.x + white.y + white.z;
  const auto to_xyz = sensor_xyz_from_rec709(sensor, kelvin, {white.x / sum, white.y / sum});
  if (!to_xyz)
    throw params.error("sensor", "sensor \"" + printable(sensor) + "\" is unknown; " + suggestion(sensor, sensor_names()));
  return to_float(film_from_rec709 * rec709_from_xyz() * *to_xyz);
}

}  // namespace

void read_film(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of film, \"rgb\" or \"gbuffer\"").text);
  ParamList params = read_param_list(state, in, "film \"" + printable(type) + "\"", where);
  if (type == "spectral") throw params.error("film \"spectral\" is not supported by Tyndall, which renders RGB; use \"rgb\"");
  if (type != "rgb" && type != "gbuffer")
    throw params.error("film \"" + printable(type) + "\" is unknown; " + suggestion(type, {"rgb", "gbuffer"}));
  Film film;
  film.gbuffer = type == "gbuffer";
  if (film.gbuffer && params.choice("coordinatesystem", "camera", {"camera", "world"}) == "world")
    params.reports().warn(params.where("coordinatesystem"),
                          "parameter \"coordinatesystem\" is ignored: positions and normals are written as --aov defines them");
  film.width = read_resolution(params, "xresolution", 1280);
  film.height = read_resolution(params, "yresolution", 720);
  film.crop = read_crop(params, film.width, film.height);
  film.filename = params.string("filename", "");
  film.max_component = params.number("maxcomponentvalue", kInfinity);
  if (!(film.max_component > 0)) throw params.error("maxcomponentvalue", "maxcomponentvalue must be above 0");
  if (params.find("maxcomponentvalue", {ParamType::number}))
    params.reports().warn(params.where("maxcomponentvalue"),
                          "\"maxcomponentvalue\" limits samples' colours in Rec.709; pbrt-v4 limits what its sensor makes of a "
                          "few wavelengths, and comes out darker");
  params.boolean("savefp16", true);  // pictures are always written as float
  const float diagonal = params.number("diagonal", 35);
  if (!(diagonal >= 1e-3f && diagonal <= 1e6f)) throw params.error("diagonal", "diagonal must be from 0.001 to 1e6 mm");
  state.film_diagonal = diagonal / 1000;
  state.iso = read_iso(params);
  film.from_rec709 = read_sensor(params, *state.graphics.color_space);
  params.finish();
  film.chromaticities = state.graphics.color_space->chromaticities;
  state.scene.film = std::move(film);
}

void read_pixel_filter(State& state, Tokenizer& in, const Location& where) {
  using Kind = PixelFilter::Kind;
  const std::string type(in.expect_string("a kind of filter, as \"gaussian\"").text);
  ParamList params = read_param_list(state, in, "filter \"" + printable(type) + "\"", where);
  struct Row {
    std::string_view name;
    Kind kind;
    float radius;
  };
  constexpr Row kRows[] = {{"box", Kind::box, 0.5f},
                           {"triangle", Kind::triangle, 2},
                           {"gaussian", Kind::gaussian, 1.5f},
                           {"mitchell", Kind::mitchell, 2},
                           {"sinc", Kind::sinc, 4}};
  const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& r) { return r.name == type; });
  if (row == std::end(kRows))
    throw params.error("filter \"" + printable(type) + "\" is unknown; " +
                       suggestion(type, {"box", "triangle", "gaussian", "mitchell", "sinc"}));
  PixelFilter filter;
  filter.kind = row->kind;
  filter.radius = {params.number("xradius", row->radius), params.number("yradius", row->radius)};
  if (!(filter.radius.x > 0 && filter.radius.y > 0)) throw params.error("xradius", "xradius and yradius must be above 0");
  if (filter.kind == Kind::gaussian) filter.sigma = params.number("sigma", 0.5f);
  if (filter.kind == Kind::mitchell) filter.b = params.number("B", 1 / 3.f), filter.c = params.number("C", 1 / 3.f);
  if (filter.kind == Kind::sinc) filter.tau = params.number("tau", 3);
  if (!(filter.sigma > 0)) throw params.error("sigma", "sigma must be above 0");
  if (!(filter.tau > 0)) throw params.error("tau", "tau must be above 0");
  params.finish();
  state.scene.filter = filter;
}

}  // namespace tyndall::pbrt
