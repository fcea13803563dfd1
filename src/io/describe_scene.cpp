#include <cstdio>
#include <limits>
#include <map>
#include <variant>

#include "io/describe_text.h"

namespace tyndall {
namespace {

// Index of a variant's alternative to its name in the scene language.
constexpr const char* kTextureKinds[] = {"constant", "scale",  "mix",          "imagemap", "checkerboard",
                                         "dots",     "bilerp", "directionmix", "noise"};
constexpr const char* kMaterialKinds[] = {
    "diffuse",       "conductor",       "dielectric", "thindielectric", "diffusetransmission",
    "coateddiffuse", "coatedconductor", "mix",        "interface"};
constexpr const char* kMediumKinds[] = {"homogeneous", "uniformgrid", "rgbgrid", "cloud", "vdb"};
constexpr const char* kLightKinds[] = {"point", "spot", "distant", "infinite", "goniometric", "projection"};
constexpr const char* kCameraKinds[] = {"perspective", "orthographic", "spherical, equal-area", "spherical, equirectangular",
                                        "realistic"};
constexpr const char* kShapeKinds[] = {"trianglemesh", "bilinearmesh", "sphere", "disk", "cylinder"};

/// "3: 2 point, 1 spot" of anything that has a variant `kind`.
template <class Items, std::size_t N>
std::string count_text(const Items& items, const char* const (&names)[N]) {
  static_assert(N == std::variant_size_v<decltype(Items::value_type::kind)>);
  std::map<std::size_t, std::size_t> counts;
  for (const auto& item : items) ++counts[item.kind.index()];
  std::string text = std::to_string(items.size());
  const char* separator = ": ";
  for (const auto& [kind, count] : counts) {
    text += separator + std::to_string(count) + " " + names[kind];
    separator = ", ";
  }
  return text;
}

struct ObjectBounds {
  Bounds3 operator()(const TriangleMesh& s) const { return of(s.positions); }
  Bounds3 operator()(const BilinearMesh& s) const { return of(s.positions); }
  Bounds3 operator()(const Sphere& s) const {
    return {{-s.radius, -s.radius, std::max(-s.radius, s.z_min)}, {s.radius, s.radius, std::min(s.radius, s.z_max)}};
  }
  Bounds3 operator()(const Disk& s) const { return {{-s.radius, -s.radius, s.height}, {s.radius, s.radius, s.height}}; }
  Bounds3 operator()(const Cylinder& s) const { return {{-s.radius, -s.radius, s.z_min}, {s.radius, s.radius, s.z_max}}; }

 private:
  static Bounds3 of(const std::vector<Vec3>& points) {
    Bounds3 bounds;
    for (Vec3 p : points) bounds.expand(p);
    return bounds;
  }
};

/// Shapes of the scene or of one object, summed up.
struct Contents {
  std::size_t triangles = 0, patches = 0, emissive = 0;
  Bounds3 bounds;
};

Contents contents_of(const std::vector<Shape>& shapes) {
  Contents sum;
  for (const Shape& shape : shapes) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape.kind)) sum.triangles += mesh->indices.size() / 3;
    if (const auto* mesh = std::get_if<BilinearMesh>(&shape.kind)) sum.patches += mesh->indices.size() / 4;
    sum.emissive += shape.emission.has_value();
    const Bounds3 bounds = std::visit(ObjectBounds{}, shape.kind);
    if (!bounds.empty()) sum.bounds.expand(shape.to_world.bounds(bounds));
  }
  return sum;
}

void add_geometry(const Scene& scene, Description& result) {
  Contents whole = contents_of(scene.shapes);
  std::vector<Contents> objects;
  for (const Object& object : scene.objects) objects.push_back(contents_of(object.shapes));
  std::size_t instanced = 0;
  for (const Instance& instance : scene.instances) {
    const Contents& object = objects[instance.object];
    instanced += object.triangles;
    whole.emissive += object.emissive;
    if (!object.bounds.empty()) whole.bounds.expand(instance.to_world.bounds(object.bounds));
  }
  const auto add = [&](const char* name, const std::string& value) { result.properties.push_back({"geometry", name, value}); };
  add("shapes", count_text(scene.shapes, kShapeKinds));
  add("triangles", std::to_string(whole.triangles));
  if (whole.patches > 0) add("bilinear patches", std::to_string(whole.patches));
  if (!scene.instances.empty()) {
    add("objects", std::to_string(scene.objects.size()));
    add("instances", std::to_string(scene.instances.size()) + " with " + std::to_string(instanced) + " triangles");
  }
  add("bounds", bounds_text(whole.bounds));
  result.properties.push_back({"lights", "emissive shapes", std::to_string(whole.emissive)});
}

void add_camera_and_film(const Scene& scene, Description& result) {
  const Camera& camera = scene.camera;
  const bool perspective = camera.kind == Camera::Kind::perspective;
  const Vec3 eye = camera.to_world.point({});
  result.properties.push_back({"camera", "kind", kCameraKinds[static_cast<int>(camera.kind)]});
  result.properties.push_back({"camera", "position", number_text(eye.x) + " " + number_text(eye.y) + " " + number_text(eye.z)});
  if (perspective) result.properties.push_back({"camera", "fov", number_text(camera.fov_degrees) + " degrees"});
  result.properties.push_back({"film", "size", std::to_string(scene.film.width) + " x " + std::to_string(scene.film.height)});
  const PixelBounds crop = scene.settings.crop.value_or(scene.film.crop);
  if (crop != PixelBounds{0, 0, scene.film.width, scene.film.height})
    result.properties.push_back({"film", "crop", crop_text(crop)});
  if (!scene.film.filename.empty()) result.properties.push_back({"film", "file", scene.film.filename});
}

void add_settings(const RenderSettings& settings, Description& result) {
  const auto add = [&](const std::string& name, const std::string& value) {
    result.properties.push_back({"settings", name, value});
  };
  const auto add_limit = [&](const std::string& name, const std::optional<double>& value) {
    if (value) add(name, number_text(*value));
  };
  if (settings.spp <= kMostSamples) add("spp", std::to_string(settings.spp));
  add_limit("time", settings.time);
  add_limit("error", settings.error);
  add_limit("error-max", settings.error_max);
  add("max-depth", std::to_string(settings.max_depth));
  add("seed", std::to_string(settings.seed));
  for (const std::string& aov : settings.aovs) add("aov", aov);
  for (const StrategyAxis& axis : strategy_axes()) add(std::string(axis.option), std::string(axis.get(settings)));
}

}  // namespace

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string bounds_text(const Bounds3& b) {
  if (b.empty()) return "empty";
  const auto point = [](Vec3 p) { return "(" + number_text(p.x) + " " + number_text(p.y) + " " + number_text(p.z) + ")"; };
  return point(b.min) + " to " + point(b.max);
}

Description describe_scene(const std::string& path) {
  const SceneFile file = read_scene(path);
  const Scene& scene = file.scene;
  Description result{path, "pbrt-v4 scene", {}};
  add_camera_and_film(scene, result);
  add_settings(scene.settings, result);
  add_geometry(scene, result);
  result.properties.push_back({"lights", "lights", count_text(scene.lights, kLightKinds)});
  result.properties.push_back({"materials", "materials", count_text(scene.materials, kMaterialKinds)});
  result.properties.push_back({"textures", "textures", count_text(scene.textures, kTextureKinds)});
  result.properties.push_back({"media", "media", count_text(scene.media, kMediumKinds)});
  for (const Medium& medium : scene.media)
    if (const auto* vdb = std::get_if<VdbMedium>(&medium.kind)) result.properties.push_back({medium.name, "file", vdb->path});
  result.properties.push_back({"reading", "warnings", std::to_string(file.warnings.size())});
  return result;
}

}  // namespace tyndall
