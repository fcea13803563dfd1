/// A plume of smoke among standing stones at night, with a swarm of lights around and inside it: embers that rise in the
/// smoke, and blue sparks that circle it in three bands. Triangles turn their backs to the viewer (shade_from).
#include <cmath>

#include "example/lamps.h"
#include "example/pbrt_text.h"
#include "example/plume.h"
#include "example/scenes.h"
#include "example/shapes.h"
#include "math/warp.h"

namespace tyndall {
namespace {

constexpr int kBands = 3, kWarm = 3;  // the first colours of the palette are the embers'

Lamp ember(Rng& rng) {
  const float y = 0.15f + (kPlumeHeight - 0.6f) * std::sqrt(rng.uniform());
  const Vec3 scatter{normal_deviate(rng), normal_deviate(rng), normal_deviate(rng)};
  const int color = std::clamp(static_cast<int>(y / kPlumeHeight * kWarm + 0.4f * normal_deviate(rng)), 0, kWarm - 1);
  return {.position = plume_axis(y) + scatter * (0.3f * plume_radius(y)), .normal = unit_vector(rng), .color = color};
}

Lamp spark(Rng& rng) {
  const float u = rng.uniform();
  const int band = static_cast<int>(rng.uniform() * kBands);
  const float angle = 2 * kPi * (1.35f * u + static_cast<float>(band) / kBands);
  const float y = 0.5f + 3.8f * u;
  const float radius = 1.3f * plume_radius(y) + 0.5f + 0.07f * normal_deviate(rng);
  const Vec3 scatter{normal_deviate(rng), normal_deviate(rng), normal_deviate(rng)};
  return {.position = plume_axis(y) + Vec3{std::cos(angle), 0, std::sin(angle)} * radius + scatter * 0.05f,
          .normal = unit_vector(rng),
          .color = kWarm + static_cast<int>(rng.uniform() * 3)};
}

std::vector<Lamp> swarm(std::size_t count, Rng& rng) {
  std::vector<Lamp> lamps;
  lamps.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    lamps.push_back(rng.uniform() < 0.25f ? ember(rng) : spark(rng));
    lamps.back().position.y = std::max(lamps.back().position.y, 0.04f);
  }
  share_power(lamps, 1, rng);
  return lamps;
}

void add_stones(PbrtText& text, Rng& rng) {
  text << "# Standing stones on a wet floor.\nAttributeBegin\n  Material \"coateddiffuse\" \"rgb reflectance\" [0.17 0.16 0.15]"
       << " \"float roughness\" 0.12\n"
       << quad({-20, 0, -12}, {-20, 0, 24}, {20, 0, 24}, {20, 0, -12});
  text << "  Material \"diffuse\" \"rgb reflectance\" [0.42 0.4 0.37]\n";
  constexpr int kStones = 11;
  for (int i = 0; i < kStones; ++i) {
    const float angle = 2 * kPi * (static_cast<float>(i) + 0.75f) / kStones;
    const float r = 2.7f + 0.2f * rng.uniform(), height = 0.9f + 0.5f * rng.uniform() + 1.1f * (std::sin(angle) > 0);
    text << block({.foot = {r * std::cos(angle), 0, r * std::sin(angle)},
                   .size = {0.24f + 0.1f * rng.uniform(), height, 0.5f + 0.3f * rng.uniform()},
                   .turn = -angle + 0.3f * (rng.uniform() - 0.5f),
                   .lean = 0.25f * (rng.uniform() - 0.5f)});
  }
  text << "  Material \"diffuse\" \"rgb reflectance\" [0.3 0.29 0.28]\n"
       << quad({-20, 0, 7}, {-20, 12, 7}, {20, 12, 7}, {20, 0, 7}) << "AttributeEnd\n";
}

void add_plume(const ExampleSettings& s, const FogGrid& grid, PbrtText& text) {
  const Vec3 top = grid.origin + Vec3{static_cast<float>(grid.nx), static_cast<float>(grid.ny), static_cast<float>(grid.nz)} *
                                     grid.voxel_size;
  text << "# The plume, in the box around its voxels.\nAttributeBegin\n  MakeNamedMedium \"plume\" \"string type\" \"nanovdb\""
       << " \"string filename\" \"plume.vdb\"\n    \"rgb sigma_s\" [7.6 7.8 8] \"rgb sigma_a\" [0.35 0.3 0.26] \"float g\" 0.4"
       << " \"float scale\" " << s.density << "\n  Material \"interface\"\n  MediumInterface \"plume\" \"\"\n"
       << box(grid.origin + Vec3{0, 0.005f, 0}, top) << "AttributeEnd\n";
}

}  // namespace

std::vector<ExampleFile> make_smoke_lights(const ExampleSettings& s) {
  constexpr View kView{.eye = {0.4f, 2.2f, -8.4f}, .look = {0.1f, 2.25f, 0}, .fov_degrees = 34};
  PbrtText text = scene_head(s, kView);
  Rng stones = stream(s.seed, 1), lights = stream(s.seed, 2);
  add_stones(text, stones);
  const FogGrid plume = smoke_plume(s.seed);
  add_plume(s, plume, text);
  std::vector<ExampleFile> files{{scene_name(s), ""}, {"plume.vdb", encode_vdb_fog({plume})}};
  const LampSet set{
      .name = "smoke_lights",
      .palette =
          {{1, 0.42f, 0.06f}, {1, 0.28f, 0.03f}, {1, 0.16f, 0.03f}, {0.03f, 0.2f, 1}, {0.02f, 0.1f, 1}, {0.05f, 0.4f, 1}},
      .power = 280,
      .area = 2};
  text << "# The lights.\n";
  std::vector<Lamp> lamps = swarm(s.lights, lights);
  shade_from(kView.eye, lamps);
  if (s.shape == LampShape::point)
    add_point_lamps(lamps, set, text);
  else
    add_triangle_lamps(lamps, set, lights, text, files);
  files.front().bytes = text.take();
  return files;
}

}  // namespace tyndall
