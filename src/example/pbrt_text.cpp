#include "example/pbrt_text.h"

#include <charconv>

namespace tyndall {
namespace {

std::string resolution(const ExampleSettings& s) { return std::to_string(s.width) + "x" + std::to_string(s.height); }

/// Every parameter is named, so that a later default changes nothing.
std::string command(const ExampleSettings& s) {
  std::string text = "tyndall example " + std::string(s.info.name);
  if (s.info.lights) text += " --lights " + std::to_string(s.lights);
  if (s.info.shape) text += s.shape == LampShape::point ? " --shape point" : " --shape triangle";
  if (s.info.density) text += " --density " + (PbrtText() << s.density).take();
  return text + " --max-depth " + std::to_string(s.max_depth) + " --resolution " + resolution(s) + " --seed " +
         std::to_string(s.seed) + " -o DIR";
}

}  // namespace

PbrtText& PbrtText::operator<<(std::string_view text) {
  text_ += text;
  return *this;
}

PbrtText& PbrtText::operator<<(float number) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof(digits), number);
  text_.append(digits, end.ptr);
  return *this;
}

PbrtText& PbrtText::operator<<(int number) { return *this << std::string_view(std::to_string(number)); }
PbrtText& PbrtText::operator<<(Vec3 v) { return *this << v.x << " " << v.y << " " << v.z; }
PbrtText& PbrtText::operator<<(Rgb c) { return *this << c.r << " " << c.g << " " << c.b; }

PbrtText& PbrtText::operator<<(const TriangleMesh& mesh) {
  *this << "  Shape \"trianglemesh\" \"point3 P\" [";
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) *this << (i ? "  " : "") << mesh.positions[i];
  *this << "]\n    \"integer indices\" [";
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    *this << (i % 3 ? " " : (i ? "  " : "")) << static_cast<int>(mesh.indices[i]);
  return *this << "]\n";
}

PbrtText scene_head(const ExampleSettings& s, const View& view, std::string_view camera_medium) {
  PbrtText text;
  text << "# " << s.info.title << "\n# Made by: " << command(s) << "\n";
  text << "Film \"rgb\" \"integer xresolution\" " << s.width << " \"integer yresolution\" " << s.height
       << " \"string filename\" \"" << s.info.name << ".exr\"\n";
  text << "PixelFilter \"gaussian\" \"float xradius\" 1.5 \"float yradius\" 1.5\n";
  text << "Sampler \"zsobol\" \"integer pixelsamples\" 64\n";
  text << "Integrator \"volpath\" \"integer maxdepth\" " << s.max_depth << "\n";
  text << camera_medium;
  text << "LookAt " << view.eye << "  " << view.look << "  0 1 0\n";
  text << "Camera \"perspective\" \"float fov\" " << view.fov_degrees << "\n";
  text << "WorldBegin\n";
  return text;
}

std::string scene_name(const ExampleSettings& settings) { return std::string(settings.info.name) + ".pbrt"; }

}  // namespace tyndall
