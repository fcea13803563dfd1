#include "support/scene_text.h"

#include <array>
#include <charconv>

namespace tyndall::test {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double v : values) text += number(v) + " ";
  return text;
}
std::string text_of(Vec3 v) { return numbers({v.x, v.y, v.z}); }
std::string text_of(Rgb c) { return numbers({c.r, c.g, c.b}); }

std::string rgb(const std::string& name, Rgb c) { return " \"rgb " + name + "\" [" + text_of(c) + "]"; }
std::string scalar(const std::string& name, double v) { return " \"float " + name + "\" " + number(v); }

std::string optics(const Coefficients& c) {
  return rgb("sigma_a", c.sigma_a) + rgb("sigma_s", c.sigma_s) + (c.phase.empty() ? scalar("g", c.g) : c.phase + " ") +
         (is_black(c.Le) ? "" : rgb("Le", c.Le));
}

std::string medium(const std::string& name, const std::string& type, const std::string& parameters) {
  return "MakeNamedMedium \"" + name + "\" \"string type\" \"" + type + "\"" + parameters + "\n";
}

/// Corners of the six faces of a box, by Bounds3::corner, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

std::string interface_between(const std::string& inside, const std::string& outside) {
  return "Material \"interface\"\nMediumInterface \"" + inside + "\" \"" + outside + "\"\n";
}

std::string quad(const std::array<Vec3, 4>& p) {
  std::string points;
  for (const Vec3& v : p) points += text_of(v);
  return "Shape \"trianglemesh\" \"point3 P\" [" + points + "] \"integer indices\" [0 1 2 0 2 3]\n";
}

}  // namespace

std::string number(double v) {
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(v)).ptr;
  return {text.data(), end};
}

std::string block(const std::string& text) { return "AttributeBegin\n" + text + "AttributeEnd\n"; }

std::string view(const View& v) {
  const std::string n = std::to_string(v.resolution), w = number(v.half_width);
  const Vec3 d = v.look - v.eye;
  const bool vertical = std::abs(d.y) > 0.9f * length(d);
  std::string text = "Film \"rgb\" \"integer xresolution\" " + n + " \"integer yresolution\" " + n + "\n" + "PixelFilter " +
                     v.filter + "\n" + "Integrator \"volpath\" \"integer maxdepth\" " + std::to_string(v.max_depth) + "\n" +
                     "LookAt " + text_of(v.eye) + text_of(v.look) + (vertical ? "0 0 1\n" : "0 1 0\n") + v.before_camera;
  if (!v.medium.empty()) text += "MediumInterface \"\" \"" + v.medium + "\"\n";
  if (v.fov_degrees > 0) {
    text += "Camera \"perspective\" \"float fov\" " + number(v.fov_degrees) + "\n";
  } else {
    text += "Camera \"orthographic\" \"float screenwindow\" [-" + w + " " + w + " -" + w + " " + w + "]\n";
  }
  // Shapes would inherit the camera's interface.
  return text + "WorldBegin\n" + (v.medium.empty() ? "" : "MediumInterface \"\" \"\"\n");
}

std::string homogeneous(const std::string& name, const Coefficients& c) { return medium(name, "homogeneous", optics(c)); }

std::string uniform_grid(const std::string& name, const Coefficients& c, const Grid& grid) {
  std::string density;
  for (const float d : grid.density) density += number(d) + " ";
  return medium(name, "uniformgrid",
                optics(c) + " \"integer nx\" " + std::to_string(grid.nx) + " \"integer ny\" " + std::to_string(grid.ny) +
                    " \"integer nz\" " + std::to_string(grid.nz) + " \"point3 p0\" [" + text_of(grid.bounds.min) +
                    "] \"point3 p1\" [" + text_of(grid.bounds.max) + "] \"float density\" [" + density + "]");
}

std::string vdb(const std::string& name, const Coefficients& c, const std::string& path) {
  return medium(name, "nanovdb", optics(c) + " \"string filename\" \"" + path + "\"");
}

std::string box_mesh(const Bounds3& box) {
  std::string points, indices;
  for (int i = 0; i < 8; ++i) points += text_of(box.corner(i));
  for (const auto& f : kFaces) {
    for (const int corner : {0, 1, 2, 0, 2, 3}) indices += std::to_string(f[corner]) + " ";
  }
  return "Shape \"trianglemesh\" \"point3 P\" [" + points + "] \"integer indices\" [" + indices + "]\n";
}

std::string medium_box(const std::string& inside, const std::string& outside, const Bounds3& box) {
  return block(interface_between(inside, outside) + box_mesh(box));
}

std::string medium_box_of_quads(const std::string& inside, const std::string& outside, const Bounds3& box) {
  std::string text = interface_between(inside, outside);
  for (const auto& f : kFaces) text += quad({box.corner(f[0]), box.corner(f[1]), box.corner(f[2]), box.corner(f[3])});
  return block(text);
}

std::string environment(float L) { return "LightSource \"infinite\"" + rgb("L", Rgb(L)) + "\n"; }

std::string point_light(Vec3 from, float I) {
  return "LightSource \"point\" \"point3 from\" [" + text_of(from) + "]" + rgb("I", Rgb(I)) + "\n";
}

std::string distant_light(Vec3 direction, float E) {
  return "LightSource \"distant\" \"point3 from\" [0 0 0] \"point3 to\" [" + text_of(direction) + "]" + rgb("L", Rgb(E)) + "\n";
}

std::string diffuse_plane(float height, float half, float reflectance) {
  const float h = half;
  return block("Material \"diffuse\"" + rgb("reflectance", Rgb(reflectance)) + "\n" +
               quad({Vec3{-h, -h, height}, Vec3{h, -h, height}, Vec3{h, h, height}, Vec3{-h, h, height}}));
}

std::string emitting_square(Vec3 c, float half, float L) {
  const float h = half;
  return block("AreaLightSource \"diffuse\"" + rgb("L", Rgb(L)) + "\nMaterial \"diffuse\"" + rgb("reflectance", Rgb(0.0f)) +
               "\n" + quad({c + Vec3{-h, -h, 0}, c + Vec3{-h, h, 0}, c + Vec3{h, h, 0}, c + Vec3{h, -h, 0}}));
}

}  // namespace tyndall::test
