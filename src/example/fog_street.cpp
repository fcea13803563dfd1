/// A wet street at night in fog: lit windows, street lamps under hoods, neon signs, and strings of small bulbs across it.
#include <cmath>

#include "example/fog.h"
#include "example/lamps.h"
#include "example/pbrt_text.h"
#include "example/scenes.h"
#include "example/shapes.h"

namespace tyndall {
namespace {

constexpr float kFacade = 5.5f, kEnd = 78;  // metres from the middle of the street; its length

struct House {
  float side;  ///< -1 left, 1 right
  float z0, z1, height;
};

std::vector<House> houses(Rng& rng) {
  std::vector<House> row;
  for (const float side : {-1.0f, 1.0f})
    for (float z = -8; z < kEnd;) {
      const float end = z + 7 + 6 * rng.uniform();
      row.push_back({side, z, end, 8 + 7 * rng.uniform()});
      z = end;
    }
  return row;
}

void add_houses(const std::vector<House>& row, PbrtText& text, Rng& rng) {
  text << "# The road, pavements and houses.\nAttributeBegin\n"
       << "  Material \"coateddiffuse\" \"rgb reflectance\" [0.05 0.05 0.055] \"float roughness\" 0.06\n"
       << quad({-20, 0, -9}, {-20, 0, kEnd + 8}, {20, 0, kEnd + 8}, {20, 0, -9});
  text << "  Material \"coateddiffuse\" \"rgb reflectance\" [0.16 0.155 0.15] \"float roughness\" 0.25\n"
       << box({-kFacade, 0, -8}, {-3.6f, 0.14f, kEnd}) << box({3.6f, 0, -8}, {kFacade, 0.14f, kEnd});
  for (const House& h : row) {
    const float grey = 0.16f + 0.2f * rng.uniform(), warm = 0.04f * rng.uniform();
    text << "  Material \"diffuse\" \"rgb reflectance\" [" << Rgb(grey + warm, grey, grey - 0.5f * warm) << "]\n"
         << box({h.side > 0 ? kFacade : -15, 0, h.z0}, {h.side > 0 ? 15 : -kFacade, h.height, h.z1});
  }
  text << "  Material \"diffuse\" \"rgb reflectance\" [0.12 0.12 0.12]\n"
       << box({-15, 0, kEnd}, {15, 13, kEnd + 6}) << "AttributeEnd\n";
}

/// A plane rectangle on a facade, facing the street.
TriangleMesh on_facade(float side, Vec2 z, Vec2 y) {
  const float x = side * (kFacade - 0.02f);
  return side > 0 ? quad({x, y.x, z.x}, {x, y.x, z.y}, {x, y.y, z.y}, {x, y.y, z.x})
                  : quad({x, y.x, z.x}, {x, y.y, z.x}, {x, y.y, z.y}, {x, y.x, z.y});
}

/// A cross and a sill of wood before a window.
void add_bars(PbrtText& text, float side, Vec2 z, Vec2 y) {
  const float near = side * (kFacade - 0.03f), far = side * (kFacade - 0.08f), edge = side * (kFacade - 0.2f);
  const float middle = (z.x + z.y) / 2, cross = y.x + 0.62f * (y.y - y.x);
  const auto bar = [&](float reach, Vec2 along, Vec2 up) {
    return box({std::min(near, reach), up.x, along.x}, {std::max(near, reach), up.y, along.y});
  };
  text << bar(far, {middle - 0.03f, middle + 0.03f}, y) << bar(far, z, {cross - 0.03f, cross + 0.03f})
       << bar(edge, {z.x - 0.1f, z.y + 0.1f}, {y.x - 0.1f, y.x - 0.02f});
}

void add_windows(const std::vector<House>& row, PbrtText& text, Rng& rng) {
  text << "# Windows, a third of them lit, each with its own brightness; shop fronts below.\n"
       << "Material \"diffuse\" \"rgb reflectance\" [0.06 0.05 0.045]\n";
  const Rgb palette[] = {{1.5f, 1, 0.5f}, {1.6f, 0.95f, 0.42f}, {1.25f, 1.05f, 0.75f}, {0.75f, 0.95f, 1.3f}};
  for (const House& h : row)
    for (float y = 0.7f; y + 2.2f < h.height; y += 3)
      for (float z = h.z0 + 0.8f; z + 1.3f < h.z1; z += 2.1f) {
        const bool shop = y < 1;
        const bool lit = rng.uniform() < (shop ? 0.4f : 0.3f);
        const float strength = std::exp(0.8f * normal_deviate(rng)) * (shop ? 2.6f : 1.5f);
        const int color = static_cast<int>(rng.uniform() * 4);
        text << "AttributeBegin\n";
        if (lit)
          add_emission(text, palette[color] * strength);
        else
          text << "  Material \"coateddiffuse\" \"rgb reflectance\" [0.02 0.02 0.025] \"float roughness\" 0.02\n";
        const Vec2 across{z, z + 1.2f}, up{y, y + (shop ? 2.0f : 1.7f)};
        text << on_facade(h.side, across, up) << "AttributeEnd\n";
        if (lit) add_bars(text, h.side, across, up);
      }
}

void add_street_lamps(PbrtText& text) {
  text << "# Street lamps: a pole, an arm, and a light under a hood.\n";
  for (int i = 0; i < 12; ++i) {
    const float side = i % 2 ? 1.0f : -1.0f, z = 4.5f + 6 * static_cast<float>(i), x = side * 4.1f, head = side * 2.9f;
    text << "AttributeBegin\n  Material \"diffuse\" \"rgb reflectance\" [0.05 0.05 0.05]\n"
         << box({x - 0.06f, 0.14f, z - 0.06f}, {x + 0.06f, 5.3f, z + 0.06f})
         << box({std::min(x, head), 5.22f, z - 0.04f}, {std::max(x, head), 5.3f, z + 0.04f})
         << box({head - 0.34f, 5.1f, z - 0.2f}, {head + 0.34f, 5.22f, z + 0.2f});
    add_emission(text, Rgb(1.5f, 0.95f, 0.42f) * (i == 7 ? 60.0f : 180.0f));  // one is failing
    text << quad({head - 0.3f, 5.09f, z - 0.16f}, {head + 0.3f, 5.09f, z - 0.16f}, {head + 0.3f, 5.09f, z + 0.16f},
                 {head - 0.3f, 5.09f, z + 0.16f})
         << "AttributeEnd\n";
  }
}

void add_neon(PbrtText& text, Rng& rng) {
  text << "# Neon signs that stand out from the facades.\n";
  const Rgb colors[] = {{2.6f, 0.12f, 0.9f}, {0.1f, 1.5f, 2}, {2.6f, 0.35f, 0.1f}, {0.3f, 2, 0.5f}, {0.9f, 0.3f, 2.4f}};
  for (int i = 0; i < 11; ++i) {
    const float side = i % 2 ? -1.0f : 1.0f, z = 7 + 6.2f * static_cast<float>(i) + rng.uniform();
    const float y = 3.1f + 1.6f * rng.uniform(), height = 1.4f + 1.3f * rng.uniform();
    const float in = side * 4.35f, out = side * (kFacade + 0.05f);
    text << "AttributeBegin\n";
    add_emission(text, colors[i % 5] * 9);
    const Vec3 lo{std::min(in, out), y, z}, hi{std::max(in, out), y + height, z + 0.14f};
    // A frame of tubes around a dark board.
    text << box(lo, {hi.x, lo.y + 0.09f, hi.z}) << box({lo.x, hi.y - 0.09f, lo.z}, hi);
    text << box({in - 0.045f, lo.y + 0.09f, lo.z}, {in + 0.045f, hi.y - 0.09f, hi.z});
    text << box({lo.x + 0.3f, lo.y + 0.3f, lo.z}, {hi.x - 0.35f, hi.y - 0.3f, hi.z});
    text << "AttributeEnd\n";
  }
}

std::vector<Lamp> bulbs(std::size_t count, Rng& rng) {
  constexpr int kStrings = 9;
  std::vector<Lamp> lamps(count);
  for (std::size_t i = 0; i < count; ++i) {
    Lamp& lamp = lamps[i];
    const auto string = static_cast<float>(i % kStrings);
    const float u = rng.uniform();
    const float sag = 1.1f * (1 - (2 * u - 1) * (2 * u - 1));
    lamp.position = {(2 * u - 1) * kFacade * 0.99f, 6.6f - sag + 0.03f * normal_deviate(rng),
                     8 + 7.5f * string + 0.5f * (u - 0.5f) + 0.03f * normal_deviate(rng)};
    lamp.normal = unit_vector(rng);
    lamp.color = static_cast<int>(rng.uniform() * 4);
  }
  share_power(lamps, 1, rng);
  return lamps;
}

void add_obstacles(PbrtText& text, Rng& rng) {
  text << "# Parked vans, advertising pillars and bollards.\nAttributeBegin\n"
       << "  Material \"coateddiffuse\" \"rgb reflectance\" [0.08 0.09 0.12] \"float roughness\" 0.05\n";
  for (int i = 0; i < 6; ++i) {
    const float side = i % 3 ? 1.0f : -1.0f, z = 10 + 9.5f * static_cast<float>(i) + 2 * rng.uniform(), x = side * 2.65f;
    text << box({x - 0.85f, 0.35f, z}, {x + 0.85f, 1.1f, z + 4.4f})
         << box({x - 0.78f, 1.1f, z + 0.9f}, {x + 0.78f, 1.95f, z + 4.3f});
    for (const float wheel : {0.5f, 3.3f}) text << box({x - 0.8f, 0, z + wheel}, {x + 0.8f, 0.5f, z + wheel + 0.6f});
  }
  text << "  Material \"diffuse\" \"rgb reflectance\" [0.2 0.22 0.2]\n  Rotate -90 1 0 0\n";
  for (const Vec3 p : {Vec3{4.4f, 0, 9}, Vec3{-4.4f, 0, 19}, Vec3{4.4f, 0, 33}})
    text << "  AttributeBegin\n    Translate " << p.x << " " << -p.z << " 0\n"
         << "    Shape \"cylinder\" \"float radius\" 0.55 \"float zmin\" 0 \"float zmax\" 2.6\n"
         << "    Shape \"disk\" \"float radius\" 0.55 \"float height\" 2.6\n  AttributeEnd\n";
  text << "AttributeEnd\n";
}

}  // namespace

std::vector<ExampleFile> make_fog_street(const ExampleSettings& s) {
  const Fog fog{.bounds = {{-21, -0.5f, -10}, {21, 18, kEnd + 9}},
                .sigma_s = Rgb(0.014f),
                .sigma_a = Rgb(0.001f),
                .g = 0.55f,
                .density = s.density};
  PbrtText text = scene_head(s, {.eye = {-0.9f, 1.75f, -3}, .look = {0.35f, 2.75f, 14}, .fov_degrees = 46}, fog_medium(fog));
  add_fog(fog, text);
  text << "# The night sky.\nLightSource \"infinite\" \"rgb L\" [0.008 0.012 0.022]\n";
  Rng rng = stream(s.seed, 1), lights = stream(s.seed, 2);
  const std::vector<House> row = houses(rng);
  add_houses(row, text, rng);
  add_windows(row, text, rng);
  add_street_lamps(text);
  add_neon(text, rng);
  add_obstacles(text, rng);
  text << "# Strings of bulbs.\n";
  std::vector<ExampleFile> files{{scene_name(s), ""}};
  const LampSet set{.name = "bulbs",
                    .palette = {{1, 0.7f, 0.32f}, {1, 0.3f, 0.1f}, {0.3f, 0.9f, 0.4f}, {0.35f, 0.55f, 1}},
                    .power = 1500,
                    .area = 6};
  add_triangle_lamps(bulbs(s.lights, lights), set, lights, text, files);
  files.front().bytes = text.take();
  return files;
}

}  // namespace tyndall
