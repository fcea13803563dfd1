#include "cli/picture_options.h"

#include <fmt/format.h>

#include "cli/option_values.h"

namespace tyndall::cli {
namespace {

/// Crops keep their share of the frame.
void set_resolution(const std::string& text, Scene& scene) {
  Film& film = scene.film;
  const auto size = integers(text, 'x');
  if (size.size() != 2 || size[0] < 1 || size[1] < 1 || size[0] > 65536 || size[1] > 65536) {
    refuse_value("--resolution", text, "WxH in pixels, such as 960x540");
  }
  const auto down = [](std::int64_t v, int from, int to) { return static_cast<int>(v * to / from); };
  const auto up = [](std::int64_t v, int from, int to) { return static_cast<int>((v * to + from - 1) / from); };
  const auto scaled = [&](const PixelBounds& crop) {
    return PixelBounds{down(crop.x0, film.width, size[0]), down(crop.y0, film.height, size[1]),
                       up(crop.x1, film.width, size[0]), up(crop.y1, film.height, size[1])};
  };
  film.crop = scaled(film.crop);
  if (scene.settings.crop) scene.settings.crop = scaled(*scene.settings.crop);
  film.width = size[0];
  film.height = size[1];
}

}  // namespace

void declare(CLI::App& command, PictureOptions& o) {
  command.add_option("--crop", o.crop, "pixels x0,x1,y0,y1 to render, ends excluded [the Film's]; --crop 0,480,0,270");
  command.add_option("--resolution", o.resolution, "frame size in pixels [the Film's]; --resolution 960x540");
  command
      .add_option("--max-depth", o.max_depth,
                  "bounces a path, at most, counted as pbrt's volpath does [the Integrator's, else 5]; --max-depth 16")
      ->check(CLI::Range(0, kMostBounces));
  command.add_flag("--sanitize", o.sanitize, "NaN and infinite voxels become 0 instead of an error");
}

void apply(const PictureOptions& o, Scene& scene) {
  if (o.max_depth) scene.settings.max_depth = *o.max_depth;
  if (!o.resolution.empty()) set_resolution(o.resolution, scene);
  if (!o.crop.empty()) {
    const auto c = integers(o.crop, ',');
    const auto is_range = [](int from, int to, int size) { return 0 <= from && from < to && to <= size; };
    const Film& film = scene.film;
    if (c.size() != 4 || !is_range(c[0], c[1], film.width) || !is_range(c[2], c[3], film.height))
      refuse_value("--crop", o.crop,
                   fmt::format("x0,x1,y0,y1 within {}x{}, x0 below x1 and y0 below y1", film.width, film.height));
    scene.settings.crop = PixelBounds{c[0], c[2], c[1], c[3]};
  }
}

}  // namespace tyndall::cli
