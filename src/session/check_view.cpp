#include "session/scene_check.h"
#include "session/value_check.h"

namespace tyndall {
namespace {

void check_lens(const ValueCheck& check, const Camera& camera) {
  check.not_negative("lens_radius", camera.lens_radius);
  check.positive("focal_distance", camera.focal_distance);
}

void check_screen(const ValueCheck& check, const Camera& camera) {
  if (camera.frame_aspect_ratio) check.positive("frame_aspect_ratio", *camera.frame_aspect_ratio);
  if (!camera.screen_window) return;
  const auto& window = *camera.screen_window;
  check.all_finite("a screen_window", window);
  check.require(window[0] != window[1] && window[2] != window[3],
                "has an empty screen_window; x0 and x1, y0 and y1 must differ");
}

void check_camera(const ValueCheck& check, const Camera& camera) {
  using Kind = Camera::Kind;
  if (camera.kind == Kind::realistic) check.require(camera.lenses.has_value(), "is realistic without lenses; give it some");
  const bool perspective = camera.kind == Kind::perspective;
  const float fov = camera.fov_degrees;
  if (perspective) check.number("fov_degrees", fov, fov > 0 && fov < 180, "degrees above 0 and below 180");
  if (!perspective && camera.kind != Kind::orthographic) return;
  check_lens(check, camera);
  check_screen(check, camera);
}

void check_film(const ValueCheck& check, const Film& film) {
  constexpr int kLargest = 1 << 20;  // a row or column; more is a mistake
  const auto fits = [](int size) { return size >= 1 && size <= kLargest; };
  check.require(fits(film.width) && fits(film.height), "has " + std::to_string(film.width) + " x " +
                                                           std::to_string(film.height) + " pixels; give each side 1 to " +
                                                           std::to_string(kLargest));
  check.positive("imaging_ratio", film.imaging_ratio);
  check.require(film.max_component > 0, "has a max_component that is not above 0; infinity is for none");
  check.all_finite("from_rec709", film.from_rec709);
}

void check_filter(const ValueCheck& check, const PixelFilter& filter) {
  using Kind = PixelFilter::Kind;
  check.positive("radius.x", filter.radius.x);
  check.positive("radius.y", filter.radius.y);
  if (filter.kind == Kind::gaussian) check.positive("sigma", filter.sigma);
  if (filter.kind == Kind::sinc) check.positive("tau", filter.tau);
  if (filter.kind != Kind::mitchell) return;
  check.finite("b", filter.b);
  check.finite("c", filter.c);
}

}  // namespace

void check_view(const Scene& scene) {
  const Location file{scene.source};
  check_camera({file, "the camera"}, scene.camera);
  check_film({file, "the film"}, scene.film);
  check_filter({file, "the pixel filter"}, scene.filter);
}

}  // namespace tyndall
