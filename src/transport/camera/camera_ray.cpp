#include "transport/camera/camera_ray.h"

#include <algorithm>
#include <cmath>

#include "light/equal_area.h"
#include "math/frame.h"
#include "math/warp.h"
#include "transport/camera/lens_system.h"

namespace tyndall {
namespace {

/// As OpenEXR keeps matrices: for row vectors, the translation in the last row.
std::array<float, 16> to_floats(const Transform::Matrix& m) {
  std::array<float, 16> out{};
  for (int i = 0; i < 16; ++i) out[i] = static_cast<float>(m[i % 4][i / 4]);
  return out;
}

/// x0 x1 y0 y1: the shorter side spans [-1, 1] unless the scene says otherwise.
std::array<float, 4> screen_window(const Camera& camera, const Film& film) {
  if (camera.screen_window) return *camera.screen_window;
  const float aspect = camera.frame_aspect_ratio.value_or(static_cast<float>(film.width) / static_cast<float>(film.height));
  if (aspect > 1) return {-aspect, aspect, -1, 1};
  return {-1, 1, -1 / aspect, 1 / aspect};
}

/// Of a place on the frame, in [0,1]^2 or a little beyond; the mappings' z is the camera's y, their y its z (pbrt).
Vec3 spherical_direction(Camera::Kind kind, Vec2 uv) {
  if (kind == Camera::Kind::spherical_equal_area) {
    const Vec3 w = equal_area_square_to_sphere(equal_area_wrapped(uv));
    return {w.x, w.z, w.y};
  }
  const float theta = kPi * uv.y, phi = 2 * kPi * uv.x;
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, const Film& film)
    : to_world_(camera.to_world),
      to_camera_(camera.to_world.inverse().matrix()),
      kind_(camera.kind),
      width_(static_cast<float>(film.width)),
      height_(static_cast<float>(film.height)),
      lens_radius_(camera.lens_radius),
      focal_distance_(camera.focal_distance),
      axis_(normalize(camera.to_world.vector({0, 0, 1}))) {
  if (camera.lenses) look_through(*camera.lenses);
  const auto window = lenses_ ? seen_by_film() : screen_window(camera, film);
  const float scale = lenses_ || kind_ == Camera::Kind::orthographic ? 1.0f : std::tan(camera.fov_degrees * (kPi / 360.0f));
  x0_ = window[0] * scale;
  x1_ = window[1] * scale;
  y0_ = window[2] * scale;
  y1_ = window[3] * scale;
}

void CameraRays::look_through(const Lenses& lenses) {
  lenses_ = std::make_shared<const LensSystem>(lenses);
  const float across = lenses.film_diagonal / std::hypot(width_, height_);
  film_size_ = {across * width_, across * height_};
}

/// The slopes of what the film's edges see, by the thick lens that the lenses are near their axis.
std::array<float, 4> CameraRays::seen_by_film() const {
  const float s = static_cast<float>(0.5 / lenses_->image_distance());
  return {-film_size_.x * s, film_size_.x * s, -film_size_.y * s, film_size_.y * s};
}

std::optional<CameraRays::Sample> CameraRays::sample(Vec2 p, Vec2 lens) const {
  if (!lenses_) return Sample{ray(p, lens), 1};
  // The picture on the film is upside down.
  const Vec2 film{film_size_.x * (0.5f - p.x / width_), film_size_.y * (p.y / height_ - 0.5f)};
  const auto through = lenses_->sample(film, lens);
  if (!through) return std::nullopt;
  const Vec3 o = to_world_.point(to_vec3(through->ray.o)), d = to_world_.vector(to_vec3(through->ray.d));
  return Sample{{o, normalize(d)}, static_cast<float>(through->weight)};
}

Ray CameraRays::ray(Vec2 p, Vec2 lens) const {
  if (is_spherical()) return {center(), normalize(to_world_.vector(spherical_direction(kind_, {p.x / width_, p.y / height_})))};
  const float x = x0_ + (x1_ - x0_) * (p.x / width_);
  const float y = y1_ + (y0_ - y1_) * (p.y / height_);
  const bool orthographic = kind_ == Camera::Kind::orthographic;
  Vec3 o = orthographic ? Vec3{x, y, 0} : Vec3{0, 0, 0};
  Vec3 d = orthographic ? Vec3{0, 0, 1} : normalize(Vec3{x, y, 1});
  if (lens_radius_ > 0) {
    const Vec2 q = lens_radius_ * square_to_concentric_disk(lens);
    const Vec3 focus = o + d * (focal_distance_ / d.z);
    o += Vec3{q.x, q.y, 0};
    d = normalize(focus - o);
  }
  return {to_world_.point(o), normalize(to_world_.vector(d))};
}

std::optional<CameraRays::Image> CameraRays::blurred_image_of(Vec3d p) const {
  // In double, and from where rays start: far from the origin the last bit of a float may be more than a pixel.
  const Vec3d d = p - Vec3d(center());
  const Transform::Matrix& m = to_camera_;
  const auto row = [&](int r) { return m[r][0] * d.x + m[r][1] * d.y + m[r][2] * d.z; };
  const bool orthographic = kind_ == Camera::Kind::orthographic;
  const double z = row(2), depth = orthographic ? 1 : z;
  if (!(z > 0)) return std::nullopt;
  const double x = (row(0) / depth - x0_) / (x1_ - x0_), y = (row(1) / depth - y1_) / (y0_ - y1_);
  // All rays through a place on the screen meet at the focal distance.
  const double from_focus = orthographic ? z / focal_distance_ - 1 : 1 / double{focal_distance_} - 1 / z;
  const double by = lens_radius_ > 0 ? lens_radius_ * from_focus : 0;
  return Image{{x * width_, y * height_}, {by / (x1_ - x0_) * width_, by / (y0_ - y1_) * height_}};
}

std::optional<Point2> CameraRays::image_of(Vec3d p) const {
  const auto image = blurred_image_of(p);
  return image ? std::optional(image->at) : std::nullopt;
}

Point2 CameraRays::on_screen(Point2 p) const {
  return {x0_ + (double{x1_} - x0_) * (p.x / width_), y1_ + (double{y0_} - y1_) * (p.y / height_)};
}

/// Of a vector (w = 0) or a point (w = 1) of camera space.
Vec3d CameraRays::in_world(Vec3d v, double w) const {
  const Transform::Matrix& m = to_world_.matrix();
  const auto row = [&](int r) { return m[r][0] * v.x + m[r][1] * v.y + m[r][2] * v.z; };
  return {row(0) + w * m[0][3], row(1) + w * m[1][3], row(2) + w * m[2][3]};
}

/// Camera space.
Vec3d CameraRays::focus_on(Point2 screen) const {
  const double far = focal_distance_, slope = kind_ == Camera::Kind::orthographic ? 1 : far;
  return {screen.x * slope, screen.y * slope, far};
}

Vec3d CameraRays::focus_of(Point2 film) const { return in_world(focus_on(on_screen(film)), 1); }

Ray CameraRays::ray_through(Point2 film, Point2 lens) const {
  const Point2 screen = on_screen(film);
  const bool orthographic = kind_ == Camera::Kind::orthographic;
  Vec3d o = orthographic ? Vec3d{screen.x, screen.y, 0} : Vec3d{};
  Vec3d along = orthographic ? Vec3d{0, 0, 1} : Vec3d{screen.x, screen.y, 1};
  if (lens_radius_ > 0) {
    o = o + Vec3d{lens_radius_ * lens.x, lens_radius_ * lens.y, 0};
    along = focus_on(screen) - o;
  }
  return {to_vec3(in_world(o, 1)), to_vec3(normalize(in_world(along, 0)))};
}

ShapeView CameraRays::view() const {
  const bool along = kind_ == Camera::Kind::orthographic;
  return {Vec3d(along ? to_world_.vector({0, 0, 1}) : center()), along};
}

Vec3 CameraRays::eye_of(Vec3 p) const {
  return kind_ == Camera::Kind::orthographic ? p - axis_ * std::max(depth(p), 0.0f) : center();
}

std::optional<Vec2> CameraRays::film_position(Vec3 p) const {
  const auto at = image_of(Vec3d(p));
  return at ? std::optional(Vec2{static_cast<float>(at->x), static_cast<float>(at->y)}) : std::nullopt;
}

/// Steps of a pixel at the point `to_p` from the center, without regard to the plane there.
std::array<Vec3, 2> CameraRays::steps_across(Vec3 to_p) const {
  const float sx = (x1_ - x0_) / width_, sy = (y0_ - y1_) / height_;
  if (kind_ == Camera::Kind::orthographic) return {to_world_.vector({sx, 0, 0}), to_world_.vector({0, sy, 0})};
  if (is_spherical()) {
    const Frame frame = Frame::around(normalize(to_p));
    const float step = length(to_p) * std::sqrt(4 * kPi / (width_ * height_));
    return {frame.x * step, frame.y * step};
  }
  // In camera space, whose unit of length need not be the world's.
  const float depth = dot(to_p, axis_) / length(to_world_.vector({0, 0, 1}));
  if (film_position(center() + to_p)) return {to_world_.vector({sx * depth, 0, 0}), to_world_.vector({0, sy * depth, 0})};
  const Frame frame = Frame::around(normalize(to_p));
  const float distance = length(to_p);
  return {frame.x * (sx * distance), frame.y * (sy * distance)};
}

std::array<Vec3, 2> CameraRays::pixel_steps(Vec3 p, Vec3 n) const {
  const bool orthographic = kind_ == Camera::Kind::orthographic;
  const Vec3 to_p = orthographic ? axis_ : p - center();
  std::array<Vec3, 2> steps = steps_across(p - center());
  for (Vec3& step : steps) {
    // The neighbouring ray leaves along to_p + step, or beside it: it meets the plane of p where n . (x - p) = 0.
    const Vec3 neighbour = orthographic ? to_p : to_p + step;
    const Vec3 on_plane = step - neighbour * (dot(n, step) / dot(n, neighbour));
    if (is_finite(on_plane)) step = on_plane;
  }
  return steps;
}

float CameraRays::film_rounding() const {
  constexpr float kSomeBits = 0x1p-20f;
  const float pixels_a_unit = std::max(width_ / std::abs(x1_ - x0_), height_ / std::abs(y1_ - y0_));
  if (kind_ != Camera::Kind::orthographic) return kSomeBits * std::max({width_, height_, pixels_a_unit});
  // Rays start on the screen, whose places are rounded in the world.
  const Vec3 c = center(), step = to_world_.vector({1 / pixels_a_unit, 0, 0});
  const float size = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  return kSomeBits * (std::max(width_, height_) + size / length(step));
}

std::array<float, 16> CameraRays::world_to_camera() const { return to_floats(to_camera_); }

std::array<float, 16> CameraRays::world_to_ndc() const {
  // Rows of the projection: x and y to [0,1] over the frame (y downward), z kept, w = z in perspective.
  const double sx = 1.0 / (x1_ - x0_), sy = 1.0 / (y0_ - y1_);
  Transform::Matrix projection{};
  const int divide = kind_ == Camera::Kind::orthographic ? 3 : 2;  // the column that holds the offset: constant, or times z
  projection[0] = {sx, 0, 0, 0};
  projection[1] = {0, sy, 0, 0};
  projection[0][divide] = -x0_ * sx;
  projection[1][divide] = -y1_ * sy;
  projection[2] = {0, 0, 1, 0};
  projection[3][divide] = 1;

  const Transform::Matrix& view = to_camera_;
  Transform::Matrix product{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      for (int k = 0; k < 4; ++k) product[r][c] += projection[r][k] * view[k][c];
    }
  }
  return to_floats(product);
}

}  // namespace tyndall
