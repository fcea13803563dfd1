/// A white furnace: nothing absorbs and the surrounding has radiance 1 everywhere, so every pixel is 1. What it shows is
/// light lost or made up anywhere along a path. (Rough metal and rough glass are not here: their microfacets shadow one
/// another and lose what is scattered more than once among them.)
#include "example/lamps.h"
#include "example/pbrt_text.h"
#include "example/scenes.h"

namespace tyndall {
namespace {

void add_ball(PbrtText& text, std::string_view material, Vec3 center) {
  text << "AttributeBegin\n  Material " << material << "\n  Translate " << center
       << "\n  Shape \"sphere\" \"float radius\" 0.7\nAttributeEnd\n";
}

/// `medium` is the text of its parameters but sigma_a, which is 0.
void add_medium_ball(PbrtText& text, std::string_view name, std::string_view medium, Vec3 center) {
  text << "AttributeBegin\n  Translate " << center << "\n  MakeNamedMedium \"" << name << "\" " << medium
       << " \"rgb sigma_a\" [0 0 0]\n  MediumInterface \"" << name
       << "\" \"\"\n  Material \"interface\"\n  Shape \"sphere\" \"float radius\" 0.7\nAttributeEnd\n";
}

}  // namespace

std::vector<ExampleFile> make_furnace(const ExampleSettings& s) {
  PbrtText text = scene_head(s, {.eye = {0, 0, -9}, .look = {0, 0, 0}, .fov_degrees = 30});
  text << "# An infinite light, half of it hidden by a dome of the same radiance, so that both kinds of light are sampled.\n"
       << "LightSource \"infinite\" \"rgb L\" [1 1 1]\nAttributeBegin\n";
  add_emission(text, Rgb(1.0f));
  text << "  ReverseOrientation\n  Shape \"sphere\" \"float radius\" 40 \"float zmin\" 0\nAttributeEnd\n# Surfaces.\n";
  add_ball(text, "\"diffuse\" \"rgb reflectance\" [1 1 1]", {-3.2f, 0.9f, 0});
  add_ball(text, "\"conductor\" \"rgb reflectance\" [1 1 1] \"float roughness\" 0", {-1.6f, 0.9f, 0});
  add_ball(text, "\"dielectric\" \"float eta\" 1.5", {0, 0.9f, 0});
  add_ball(text, "\"thindielectric\" \"float eta\" 1.5", {1.6f, 0.9f, 0});
  add_ball(text, "\"diffusetransmission\" \"rgb reflectance\" [0.4 0.4 0.4] \"rgb transmittance\" [0.6 0.6 0.6]",
           {3.2f, 0.9f, 0});
  text << "# Media.\n";
  add_medium_ball(text, "thin", "\"string type\" \"homogeneous\" \"rgb sigma_s\" [0.8 0.8 0.8]", {-3.2f, -0.9f, 0});
  add_medium_ball(text, "dense", "\"string type\" \"homogeneous\" \"rgb sigma_s\" [6 6 6]", {-1.6f, -0.9f, 0});
  add_medium_ball(text, "forward", "\"string type\" \"homogeneous\" \"float g\" 0.8 \"rgb sigma_s\" [4 4 4]", {0, -0.9f, 0});
  add_medium_ball(text, "chromatic", "\"string type\" \"homogeneous\" \"rgb sigma_s\" [1 2 4]", {1.6f, -0.9f, 0});
  add_medium_ball(text, "cloud",
                  "\"string type\" \"cloud\" \"point3 p0\" [-0.7 -0.7 -0.7] \"point3 p1\" [0.7 0.7 0.7] \"float density\" 2"
                  " \"rgb sigma_s\" [4 4 4]",
                  {3.2f, -0.9f, 0});
  return {{scene_name(s), text.take()}};
}

}  // namespace tyndall
