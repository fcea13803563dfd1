#include "session/unit_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// A box in double precision: scaling by a power of two scales it without rounding.
struct Box {
  double lo[3] = {kNone, kNone, kNone}, hi[3] = {-kNone, -kNone, -kNone};

  bool empty() const { return !(lo[0] <= hi[0]); }
  void expand(const Transform::Matrix& m, double x, double y, double z) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double v = m[i][0] * x + m[i][1] * y + m[i][2] * z + m[i][3];
      lo[i] = std::min(lo[i], v);
      hi[i] = std::max(hi[i], v);
    }
  }
  void expand(const Transform::Matrix& m, const Box& b) {
    if (b.empty()) return;
    for (int i = 0; i < 8; ++i) expand(m, i & 1 ? b.hi[0] : b.lo[0], i & 2 ? b.hi[1] : b.lo[1], i & 4 ? b.hi[2] : b.lo[2]);
  }
  double center(int i) const { return 0.5 * (lo[i] + hi[i]); }
  double half_extent() const { return 0.5 * std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]}); }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
};

struct ObjectBox {
  Box operator()(const TriangleMesh& s) const { return of(s.positions); }
  Box operator()(const BilinearMesh& s) const { return of(s.positions); }
  Box operator()(const Sphere& s) const { return round(s.radius, -s.radius, s.radius); }
  Box operator()(const Disk& s) const { return round(s.radius, s.height, s.height); }
  Box operator()(const Cylinder& s) const { return round(s.radius, s.z_min, s.z_max); }

 private:
  static Box of(const std::vector<Vec3>& points) {
    Box box;
    const Transform::Matrix identity = Transform().matrix();
    for (const Vec3& p : points) box.expand(identity, p.x, p.y, p.z);
    return box;
  }
  static Box round(double radius, double low, double high) {
    Box box;
    const Transform::Matrix identity = Transform().matrix();
    box.expand(identity, -radius, -radius, low);
    box.expand(identity, radius, radius, high);
    return box;
  }
};

Box box_of(const std::vector<Shape>& shapes) {
  Box box;
  for (const Shape& shape : shapes) box.expand(shape.to_world.matrix(), std::visit(ObjectBox{}, shape.kind));
  return box;
}

/// All shapes; without any, what else has a place.
Box box_of(const Scene& scene) {
  Box box = box_of(scene.shapes);
  std::vector<Box> objects;
  for (const Object& object : scene.objects) objects.push_back(box_of(object.shapes));
  for (const Instance& instance : scene.instances)
    if (instance.object < objects.size()) box.expand(instance.to_world.matrix(), objects[instance.object]);
  if (!box.empty() && box.half_extent() > 0) return box;
  box.expand(scene.camera.to_world.matrix(), 0, 0, 0);
  for (const Light& light : scene.lights) {
    if (const auto* point = std::get_if<PointLight>(&light.kind))
      box.expand(Transform().matrix(), point->position.x, point->position.y, point->position.z);
    if (const auto* spot = std::get_if<SpotLight>(&light.kind)) box.expand(spot->to_world.matrix(), 0, 0, 0);
    if (const auto* goniometric = std::get_if<GoniometricLight>(&light.kind))
      box.expand(goniometric->to_world.matrix(), 0, 0, 0);
    if (const auto* projection = std::get_if<ProjectionLight>(&light.kind)) box.expand(projection->to_world.matrix(), 0, 0, 0);
  }
  return box;
}

/// Changes the units of everything with a place or a size.
class Units {
 public:
  /// One length here is 2^exponent of the user's; `to_unit` takes the user's world here.
  Units(int exponent, const Transform& to_unit) : exponent_(exponent), to_unit_(to_unit) {}

  void change(Scene& scene) const {
    const double s = std::ldexp(1.0, -exponent_);
    const Transform shrink = Transform::scale(s, s, s), grow = shrink.inverse();
    change(scene.camera.to_world);
    for (Texture& texture : scene.textures) change(texture);
    for (Material& material : scene.materials)
      material.displacement_scale = std::ldexp(material.displacement_scale, -exponent_);
    for (Medium& medium : scene.media) change(medium);
    for (Light& light : scene.lights) change(light);
    for (Shape& shape : scene.shapes) {
      change(shape.to_world);
      change_emission(shape);
    }
    for (Object& object : scene.objects) {
      for (Shape& shape : object.shapes) {
        shape.to_world = shrink * shape.to_world;
        change_emission(shape);
      }
    }
    for (Instance& instance : scene.instances) instance.to_world = to_unit_ * instance.to_world * grow;
  }

 private:
  void change(Transform& to_world) const { to_world = to_unit_ * to_world; }
  void change(Texture& texture) const {
    const auto mapping = [&](TextureMapping& m) { m.to_texture = m.to_texture * to_unit_.inverse(); };
    if (auto* image = std::get_if<ImageTexture>(&texture.kind)) mapping(image->mapping);
    if (auto* board = std::get_if<CheckerboardTexture>(&texture.kind)) mapping(board->mapping);
    if (auto* dots = std::get_if<DotsTexture>(&texture.kind)) mapping(dots->mapping);
    if (auto* bilerp = std::get_if<BilerpTexture>(&texture.kind)) mapping(bilerp->mapping);
    if (auto* noise = std::get_if<NoiseTexture>(&texture.kind)) noise->to_texture = noise->to_texture * to_unit_.inverse();
  }
  void change(Medium& medium) const {
    change(medium.to_world);
    for (Rgb* sigma : {&medium.optics.sigma_a, &medium.optics.sigma_s}) *sigma = scaled(*sigma, exponent_);
    if (auto* grid = std::get_if<RgbGridMedium>(&medium.kind)) grid->scale = std::ldexp(grid->scale, exponent_);
  }
  void change(Light& light) const {
    if (auto* point = std::get_if<PointLight>(&light.kind)) {
      point->position = to_unit_.point(point->position);
      point->I = scaled(point->I, -2 * exponent_);
    }
    const auto change_oriented = [this](auto* oriented) {
      if (!oriented) return;
      change(oriented->to_world);
      oriented->I = scaled(oriented->I, -2 * exponent_);
    };
    change_oriented(std::get_if<SpotLight>(&light.kind));
    change_oriented(std::get_if<GoniometricLight>(&light.kind));
    change_oriented(std::get_if<ProjectionLight>(&light.kind));
    if (auto* infinite = std::get_if<InfiniteLight>(&light.kind); infinite && infinite->portal)
      for (Vec3& corner : *infinite->portal) corner = to_unit_.point(corner);
  }
  void change_emission(Shape& shape) const {
    if (shape.emission && shape.emission->power) shape.emission->power = std::ldexp(*shape.emission->power, -2 * exponent_);
  }
  static Rgb scaled(Rgb c, int exponent) {
    return {std::ldexp(c.r, exponent), std::ldexp(c.g, exponent), std::ldexp(c.b, exponent)};
  }

  int exponent_;
  Transform to_unit_;
};

}  // namespace

UnitScene in_unit_size(Scene scene) {
  constexpr double kFar = 8;  // half extents: nearer, a move would gain less than three bits
  const Box box = box_of(scene);
  UnitScene result{std::move(scene), {}, 1};
  if (box.empty()) return result;
  const double size = box.half_extent();
  double farthest = 0;
  for (int i = 0; i < 3; ++i) farthest = std::max(farthest, std::abs(box.center(i)));
  if (!(size > 0) || !std::isfinite(size) || !std::isfinite(farthest)) return result;

  const bool move = farthest > kFar * size;
  const Transform to_origin = move ? Transform::translate(-box.center(0), -box.center(1), -box.center(2)) : Transform();
  int exponent = 0;
  std::frexp(size, &exponent);
  const double shrink = std::ldexp(1.0, -exponent);
  const Transform to_unit = Transform::scale(shrink, shrink, shrink) * to_origin;
  Units(exponent, to_unit).change(result.scene);
  result.to_user = to_unit.inverse();
  result.unit = std::ldexp(1.0, exponent);
  return result;
}

}  // namespace tyndall
