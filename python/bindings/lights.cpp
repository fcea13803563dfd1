#include "lights.h"

#include <map>

namespace tyndall::python {
namespace {

py::object optional(const std::optional<float>& value) { return py::cast(value); }

py::object from_portal(const std::optional<std::array<Vec3, 4>>& portal) {
  if (!portal) return py::none();
  py::list corners;
  for (const Vec3 p : *portal) corners.append(from_vec3(p));
  return py::tuple(corners);
}

std::optional<std::array<Vec3, 4>> to_portal(py::handle value) {
  if (value.is_none()) return std::nullopt;
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = to_vec3(value[py::int_(i)]);
  return corners;
}

/// Of each kind its fields by name, which are the arguments of its Python class.
struct FieldsOf {
  py::dict operator()(const PointLight& l) const {
    return py::dict("position"_a = from_vec3(l.position), "I"_a = from_rgb(l.I));
  }
  py::dict operator()(const SpotLight& l) const {
    return py::dict("to_world"_a = from_transform(l.to_world), "I"_a = from_rgb(l.I), "cone_angle"_a = l.cone_angle_degrees,
                    "falloff_start"_a = l.falloff_start_degrees);
  }
  py::dict operator()(const DistantLight& l) const {
    return py::dict("direction"_a = from_vec3(l.direction), "E"_a = from_rgb(l.E));
  }
  py::dict operator()(const InfiniteLight& l) const {
    return py::dict("to_world"_a = from_transform(l.to_world), "L"_a = from_rgb(l.L), "path"_a = from_name(l.path),
                    "to_rec709"_a = py::tuple(py::cast(l.to_rec709)), "illuminance"_a = optional(l.illuminance),
                    "portal"_a = from_portal(l.portal));
  }
  py::dict operator()(const GoniometricLight& l) const {
    return py::dict("to_world"_a = from_transform(l.to_world), "I"_a = from_rgb(l.I), "path"_a = from_name(l.path),
                    "power"_a = optional(l.power));
  }
  py::dict operator()(const ProjectionLight& l) const {
    return py::dict("to_world"_a = from_transform(l.to_world), "I"_a = from_rgb(l.I), "path"_a = from_name(l.path),
                    "fov"_a = l.fov_degrees, "power"_a = optional(l.power));
  }
};

constexpr const char* kNames[] = {"PointLight",    "SpotLight",        "DistantLight",
                                  "InfiniteLight", "GoniometricLight", "ProjectionLight"};

decltype(Light::kind) kind_of(const std::string& name, py::handle l) {
  if (name == "PointLight") return PointLight{to_vec3(l.attr("position")), to_rgb(l.attr("I"))};
  if (name == "SpotLight")
    return SpotLight{to_transform(l.attr("to_world")), to_rgb(l.attr("I")), get<float>(l, "cone_angle"),
                     get<float>(l, "falloff_start")};
  if (name == "DistantLight") return DistantLight{to_vec3(l.attr("direction")), to_rgb(l.attr("E"))};
  if (name == "InfiniteLight")
    return InfiniteLight{to_transform(l.attr("to_world")),
                         to_rgb(l.attr("L")),
                         to_name(l.attr("path"), "path"),
                         get<std::array<float, 9>>(l, "to_rec709"),
                         get<std::optional<float>>(l, "illuminance"),
                         to_portal(l.attr("portal"))};
  if (name == "GoniometricLight")
    return GoniometricLight{to_transform(l.attr("to_world")), to_rgb(l.attr("I")), to_name(l.attr("path"), "path"),
                            get<std::optional<float>>(l, "power")};
  if (name == "ProjectionLight")
    return ProjectionLight{to_transform(l.attr("to_world")), to_rgb(l.attr("I")), to_name(l.attr("path"), "path"),
                           get<float>(l, "fov"), get<std::optional<float>>(l, "power")};
  throw py::type_error(name +
                       " is no light; give a tyndall.PointLight, SpotLight, DistantLight, InfiniteLight, "
                       "GoniometricLight or ProjectionLight");
}

constexpr std::pair<const char*, Camera::Kind> kCameras[] = {
    {"perspective", Camera::Kind::perspective},
    {"orthographic", Camera::Kind::orthographic},
    {"spherical_equal_area", Camera::Kind::spherical_equal_area},
    {"spherical_equirectangular", Camera::Kind::spherical_equirectangular},
    {"realistic", Camera::Kind::realistic},
};

Camera::Kind camera_kind(const std::string& name) {
  std::string known;
  for (const auto& [text, kind] : kCameras) {
    if (name == text) return kind;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw py::value_error("no camera is \"" + name + "\"; choose from " + known);
}

const char* camera_name(Camera::Kind wanted) {
  for (const auto& [text, kind] : kCameras)
    if (kind == wanted) return text;
  return "";
}

}  // namespace

Light to_light(py::handle light) {
  const auto name = get<std::string>(py::type::of(light), "__name__");
  Light result{kind_of(name, light), {}, {}};
  result.where = to_location(light.attr("where"));
  result.group = to_name(light.attr("group"), "group");
  return result;
}

py::object from_light(const Light& light) {
  py::dict fields = std::visit(FieldsOf{}, light.kind);
  fields["group"] = from_name(light.group);
  fields["where"] = from_location(light.where);
  return python_class("tyndall.lights", kNames[light.kind.index()])(**fields);
}

void set_camera(Camera& camera, py::handle value) {
  const Camera::Kind kind = camera_kind(get<std::string>(value, "kind"));
  if (kind == Camera::Kind::realistic && !camera.lenses)
    throw py::value_error("a realistic camera has lenses, which come from a scene file");
  camera.kind = kind;
  camera.to_world = to_transform(value.attr("to_world"));
  camera.fov_degrees = get<float>(value, "fov");
  camera.lens_radius = get<float>(value, "lens_radius");
  camera.focal_distance = get<float>(value, "focal_distance");
  camera.screen_window = get<std::optional<std::array<float, 4>>>(value, "screen_window");
  camera.frame_aspect_ratio = get<std::optional<float>>(value, "frame_aspect_ratio");
}

py::object from_camera(const Camera& c) {
  return python_class("tyndall.camera", "Camera")(
      "kind"_a = camera_name(c.kind), "to_world"_a = from_transform(c.to_world), "fov"_a = c.fov_degrees,
      "lens_radius"_a = c.lens_radius, "focal_distance"_a = c.focal_distance, "screen_window"_a = py::cast(c.screen_window),
      "frame_aspect_ratio"_a = optional(c.frame_aspect_ratio));
}

}  // namespace tyndall::python
