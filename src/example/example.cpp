#include "example/example.h"

#include <cmath>
#include <filesystem>

#include "example/scenes.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

struct Entry {
  ExampleInfo info;
  std::vector<ExampleFile> (*make)(const ExampleSettings&);
};

const std::vector<Entry>& entries() {
  constexpr auto kNone = std::nullopt;
  static const std::vector<Entry> list{
      {{"glossy-lights", "coloured lights over metal of six roughnesses", 10000, kNone, kNone, 5}, make_glossy_lights},
      {{"mesh-light-fog", "an emissive knot in fog: one mesh of many emissive triangles", 20000, 1.0, kNone, 16},
       make_mesh_light_fog},
      {{"ceiling", "a Cornell box with small lights all over its ceiling", 10000, kNone, kNone, 5}, make_ceiling},
      {{"smoke-lights", "a plume of smoke with lights around and inside it", 10000, 1.0, LampShape::triangle, 16},
       make_smoke_lights},
      {{"fog-street", "a street at night in fog: windows, lamps, neon, bulbs", 2000, 1.0, kNone, 16}, make_fog_street},
      {{"furnace", "white objects and media in white light: every pixel is 1", kNone, kNone, kNone, 1000}, make_furnace},
  };
  return list;
}

const Entry& find(std::string_view name) {
  std::string names;
  for (const Entry& e : entries()) {
    if (e.info.name == name) return e;
    names += (names.empty() ? "" : ", ") + std::string(e.info.name);
  }
  throw Error(Failure::usage, "example \"" + std::string(name) + "\" is unknown; there are " + names);
}

/// The value asked for when the example takes such an option, else its default or `unused`.
template <typename T>
T chosen(const ExampleInfo& info, std::string_view option, const std::optional<T>& asked, const std::optional<T>& preset,
         T unused) {
  if (asked && !preset) {
    std::string takes = info.lights ? "--lights, " : "";
    if (info.density) takes += "--density, ";
    if (info.shape) takes += "--shape, ";
    throw Error(Failure::usage, "example " + std::string(info.name) + " takes no " + std::string(option) + "; it takes " +
                                    takes + "--max-depth, --resolution and --seed");
  }
  return asked ? *asked : preset.value_or(unused);
}

void require(bool good, const std::string& what) {
  if (!good) throw Error(Failure::usage, what);
}

ExampleSettings resolve(const ExampleInfo& info, const ExampleOptions& o) {
  const auto lights = chosen<std::int64_t>(info, "--lights", o.lights, info.lights, 0);
  const double density = chosen<double>(info, "--density", o.density, info.density, 1);
  const int max_depth = o.max_depth.value_or(info.max_depth);
  require(!info.lights || (lights >= 1 && lights <= 10'000'000), "--lights must be from 1 to 10000000");
  require(density >= 0 && density <= 1000, "--density must be from 0 to 1000");
  require(max_depth >= 0, "--max-depth must not be negative");
  require(o.width >= 1 && o.height >= 1 && o.width <= 65536 && o.height <= 65536,
          "--resolution must be from 1x1 to 65536x65536");
  return {info,
          static_cast<std::size_t>(lights),
          static_cast<float>(density),
          chosen<LampShape>(info, "--shape", o.shape, info.shape, LampShape::triangle),
          max_depth,
          o.width,
          o.height,
          o.seed};
}

}  // namespace

const std::vector<ExampleInfo>& example_list() {
  static const std::vector<ExampleInfo> list = [] {
    std::vector<ExampleInfo> infos;
    for (const Entry& e : entries()) infos.push_back(e.info);
    return infos;
  }();
  return list;
}

std::vector<ExampleFile> make_example(std::string_view name, const ExampleOptions& options) {
  const Entry& entry = find(name);
  return entry.make(resolve(entry.info, options));
}

std::string write_example(const std::vector<ExampleFile>& files, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error(Failure::output, folder + ": the folder cannot be made: " + failed.message());
  // The scene last: where it stands, all it refers to does.
  for (auto file = files.rbegin(); file != files.rend(); ++file)
    write_file(file->bytes, (fs::path(folder) / file->name).string());
  return (fs::path(folder) / files.front().name).string();
}

}  // namespace tyndall
