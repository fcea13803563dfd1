#include "media.h"

namespace tyndall::python {
namespace {

Bounds3 to_box(py::handle corners) {
  Bounds3 bounds;
  for (int i = 0; i < 2; ++i) bounds.expand(to_vec3(corners[py::int_(i)]));
  return bounds;
}

std::vector<float> plane(py::handle grid, const char* name) {
  const py::object array = grid.attr(name);
  return array.is_none() ? std::vector<float>() : to_floats(array.cast<Floats>());
}

std::vector<Rgb> colors(py::handle grid, const char* name) {
  const std::vector<float> values = plane(grid, name);
  std::vector<Rgb> result;
  result.reserve(values.size() / 3);
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) result.emplace_back(values[i], values[i + 1], values[i + 2]);
  return result;
}

UniformGridMedium uniform_grid(py::handle voxels) {
  UniformGridMedium grid;
  grid.bounds = to_box(voxels.attr("bounds"));
  std::tie(grid.nx, grid.ny, grid.nz) = get<std::tuple<int, int, int>>(voxels, "size");
  grid.density = plane(voxels, "density");
  grid.temperature = plane(voxels, "temperature");
  grid.Le = to_rgb(voxels.attr("Le"));
  grid.Le_factor = get<float>(voxels, "Le_scale");
  return grid;
}

RgbGridMedium rgb_grid(py::handle voxels) {
  RgbGridMedium grid;
  grid.bounds = to_box(voxels.attr("bounds"));
  std::tie(grid.nx, grid.ny, grid.nz) = get<std::tuple<int, int, int>>(voxels, "size");
  grid.sigma_a = colors(voxels, "sigma_a");
  grid.sigma_s = colors(voxels, "sigma_s");
  grid.Le = colors(voxels, "Le");
  return grid;
}

}  // namespace

BoxedMedium to_medium(py::handle m) {
  const py::object voxels = m.attr("voxels")();
  BoxedMedium result;
  Medium& medium = result.medium;
  medium.optics.phase = HenyeyGreenstein{get<float>(m, "g")};
  medium.to_world = to_transform(m.attr("to_world"));
  medium.name = to_name(m.attr("name"), "name");
  medium.group = to_name(m.attr("group"), "group");
  result.bounds = to_box(voxels.attr("bounds"));
  const auto kind = get<std::string>(voxels, "kind");
  if (kind == "rgb") {  // its arrays are coefficients already
    medium.kind = rgb_grid(voxels);
    return result;
  }
  medium.optics.sigma_a = to_rgb(m.attr("sigma_a"));
  medium.optics.sigma_s = to_rgb(m.attr("sigma_s"));
  if (kind == "homogeneous") {
    medium.kind = HomogeneousMedium{to_rgb(voxels.attr("Le"))};
  } else {
    medium.kind = uniform_grid(voxels);
  }
  return result;
}

}  // namespace tyndall::python
