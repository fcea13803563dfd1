#include "tyndall/scene.h"

#include "define.h"
#include "lights.h"
#include "media.h"
#include "settings.h"
#include "tyndall/io.h"
#include "tyndall/scene_edit.h"
#include "watch.h"

namespace tyndall::python {
namespace {

/// (scene, [(file, line, column, warning)])
py::tuple from_file(SceneFile file) {
  py::list warnings;
  for (const Warning& w : file.warnings)
    warnings.append(py::make_tuple(from_name(w.where.file), w.where.line, w.where.column, from_text(w.message)));
  return py::make_tuple(std::move(file.scene), warnings);
}

py::tuple read(py::handle path, std::optional<int> frame) {
  const std::string name = to_name(path, "path");
  Watched watched;
  std::optional<SceneFile> file;
  run_watched(watched, [&] { file = read_scene(name, {.frame = frame}); });
  return from_file(std::move(*file));
}

py::list from_lights(const Scene& scene) {
  py::list lights;
  for (const Light& light : scene.lights) lights.append(from_light(light));
  return lights;
}

/// All or none.
void set_lights(Scene& scene, const py::list& lights) {
  std::vector<Light> all;
  for (const py::handle light : lights) all.push_back(to_light(light));
  scene.lights = std::move(all);
}

template <typename Named>
py::list names_of(const std::vector<Named>& list) {
  std::vector<std::string> names;
  for (const Named& n : list)
    if (!n.name.empty()) names.push_back(n.name);
  return from_names(names);
}

void place_medium(Scene& scene, py::handle value) {
  BoxedMedium boxed = to_medium(value);
  add_medium(scene, std::move(boxed.medium), boxed.bounds);
}

/// The shapes that hold it stay, and so does its place.
void replace_medium(Scene& scene, py::handle called, py::handle value) {
  const std::string name = to_name(called, "name");
  Medium& old = scene.media[medium_named(scene, name)];
  Medium medium = to_medium(value).medium;
  medium.name = name;
  medium.where = old.where;
  old = std::move(medium);
}

std::optional<AreaLight> to_emission(py::handle radiance, std::string group) {
  if (radiance.is_none()) return std::nullopt;
  AreaLight light;
  light.L = to_rgb(radiance);
  light.group = std::move(group);
  return light;
}

/// What all shapes are made of: material, emission, light group, place.
Shape to_shape(const Scene& scene, py::handle look) {
  Shape shape;
  shape.to_world = to_transform(look.attr("to_world"));
  shape.material = material_named(scene, to_name(look.attr("material"), "material"));
  shape.emission = to_emission(look.attr("emission"), to_name(look.attr("group"), "group"));
  return shape;
}

std::vector<Vec3> to_vectors(const Floats& array) {
  std::vector<Vec3> vectors;
  for (py::ssize_t i = 0; i + 2 < array.size(); i += 3)
    vectors.push_back({array.data()[i], array.data()[i + 1], array.data()[i + 2]});
  return vectors;
}

std::vector<Vec2> to_uvs(const Floats& array) {
  std::vector<Vec2> uvs;
  for (py::ssize_t i = 0; i + 1 < array.size(); i += 2) uvs.push_back({array.data()[i], array.data()[i + 1]});
  return uvs;
}

/// Arrays without entries: no normals, no uvs.
struct MeshArrays {
  Floats positions, normals, uvs;
  Indices indices;
};

void add_mesh(Scene& scene, const MeshArrays& arrays, py::handle look) {
  Shape shape = to_shape(scene, look);
  shape.kind = TriangleMesh{.positions = to_vectors(arrays.positions),
                            .normals = to_vectors(arrays.normals),
                            .uvs = to_uvs(arrays.uvs),
                            .indices = {arrays.indices.data(), arrays.indices.data() + arrays.indices.size()}};
  scene.shapes.push_back(std::move(shape));
}

void add_sphere(Scene& scene, float radius, py::handle look) {
  Shape shape = to_shape(scene, look);
  shape.kind = Sphere{.radius = radius, .z_min = -radius, .z_max = radius};
  scene.shapes.push_back(std::move(shape));
}

void set_resolution(Scene& scene, int width, int height) {
  scene.film.width = width;
  scene.film.height = height;
  scene.film.crop = {0, 0, width, height};
  scene.settings.crop.reset();
}

/// Of four rows that are affine.
bool is_invertible(py::handle matrix) {
  try {
    to_transform(matrix);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

void define_scene(py::module_& m) {
  py::class_<Scene>(m, "Scene")
      .def(py::init<>())
      .def("copy", [](const Scene& scene) { return Scene(scene); })
      .def("lights", from_lights)
      .def("set_lights", set_lights)
      .def("camera", [](const Scene& scene) { return from_camera(scene.camera); })
      .def("set_camera", [](Scene& scene, py::handle value) { set_camera(scene.camera, value); })
      .def("resolution", [](const Scene& scene) { return py::make_tuple(scene.film.width, scene.film.height); })
      .def("set_resolution", set_resolution)
      .def("settings", [](const Scene& scene) { return from_settings(scene.settings); })
      .def("set_settings", [](Scene& scene, const py::dict& options) { scene.settings = with_options(scene, options); })
      .def("media", [](const Scene& scene) { return names_of(scene.media); })
      .def("add_medium", place_medium)
      .def("replace_medium", replace_medium)
      .def("materials", [](const Scene& scene) { return names_of(scene.materials); })
      .def("add_material", [](Scene& scene, py::handle name,
                              py::handle color) { add_diffuse_material(scene, to_name(name, "name"), to_rgb(color)); })
      .def("add_mesh",
           [](Scene& scene, Floats positions, Indices indices, Floats normals, Floats uvs, py::handle look) {
             add_mesh(scene, {std::move(positions), std::move(normals), std::move(uvs), std::move(indices)}, look);
           })
      .def("add_sphere", add_sphere)
      .def("source", [](const Scene& scene) { return from_name(scene.source); });
  m.def("read_scene", read);
  m.def("read_scene_text", [](const std::string& text, py::handle name, py::handle folder) {
    return from_file(read_scene_text(text, to_name(name, "name"), to_name(folder, "folder")));
  });
  m.def("is_invertible", is_invertible);
  m.def("camera_to_world", [](py::handle eye, py::handle look, py::handle up) {
    return from_transform(Transform::look_at(to_vec3(eye), to_vec3(look), to_vec3(up)).inverse());
  });
}

}  // namespace tyndall::python
