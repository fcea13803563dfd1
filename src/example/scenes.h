/// The examples, one file each. Each returns its files, the scene first; its title and defaults stand in example.cpp.
#pragma once

#include <string>
#include <vector>

#include "example/example.h"

namespace tyndall {

/// Options with every default filled in.
struct ExampleSettings {
  ExampleInfo info;
  std::size_t lights;
  float density;
  LampShape shape;
  int max_depth, width, height;
  std::uint64_t seed;
};

std::vector<ExampleFile> make_glossy_lights(const ExampleSettings& settings);
std::vector<ExampleFile> make_mesh_light_fog(const ExampleSettings& settings);
std::vector<ExampleFile> make_ceiling(const ExampleSettings& settings);
std::vector<ExampleFile> make_smoke_lights(const ExampleSettings& settings);
std::vector<ExampleFile> make_fog_street(const ExampleSettings& settings);
std::vector<ExampleFile> make_furnace(const ExampleSettings& settings);

}  // namespace tyndall
