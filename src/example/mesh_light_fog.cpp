/// Figure 2 of Conty Estevez and Kulla: one emissive mesh of many triangles in a participating medium. An emissive trefoil
/// knot stands in a cage of slats, which cut its light into shafts. Its tube is open toward the viewer, who sees its dark
/// inside: the edges of a bright mesh make noise that would drown what the scene is to show.
#include <cmath>

#include "example/fog.h"
#include "example/lamps.h"
#include "example/pbrt_text.h"
#include "example/scenes.h"
#include "example/shapes.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr float kTube = 0.1f, kSize = 0.36f;  // metres
constexpr Vec3 kCenter{0, 1.3f, 0};

Vec3 trefoil(float t) {
  const float across = std::sin(t) + 2 * std::sin(2 * t), along = std::cos(t) - 2 * std::cos(2 * t), up = -std::sin(3 * t);
  return kCenter + Vec3{across, 0.85f * up + 0.42f * along, 0.9f * along - 0.4f * up} * kSize;  // tilted toward the camera
}

/// Rings of `sides` vertices along the knot. Their distances are log-normal, and with them the triangles' powers.
TriangleMesh knot(std::size_t triangles, Rng& rng) {
  // The knot is about 17 times as long as its tube is around: as many more rings than sides make the triangles' sides alike.
  const double even = std::sqrt(static_cast<double>(triangles) / 2 / 17);
  const auto sides = static_cast<std::size_t>(std::clamp(std::lround(even), 3l, 2000l));
  const std::size_t rings = std::max<std::size_t>((triangles / 2 + sides / 2) / sides, 3);
  const std::vector<float> steps = log_normal_shares(rings, 1, rng);
  TriangleMesh mesh;
  double t = 0;
  for (std::size_t r = 0; r < rings; t += 2 * double(kPi) * steps[r++]) {
    const auto at = static_cast<float>(t);
    const Vec3 p = trefoil(at), ahead = normalize(trefoil(at + 1e-2f) - trefoil(at - 1e-2f));
    // The knot's own outward direction as reference: it never runs along the tube, and closes with it.
    const Vec3 out = normalize(cross(ahead, cross(p - kCenter, ahead))), side = cross(ahead, out);
    for (std::size_t k = 0; k < sides; ++k) {
      const float angle = 2 * kPi * static_cast<float>(k) / static_cast<float>(sides);
      mesh.positions.push_back(p + (out * std::cos(angle) + side * std::sin(angle)) * kTube);
      const auto index = [&](std::size_t ring, std::size_t i) {
        return static_cast<std::uint32_t>(ring % rings * sides + i % sides);
      };
      const std::uint32_t a = index(r, k), b = index(r, k + 1), c = index(r + 1, k + 1), d = index(r + 1, k);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  }
  return mesh;
}

/// Without the triangles that emit toward the viewer.
void shade_from(Vec3 eye, TriangleMesh& mesh) {
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
               c = mesh.positions[mesh.indices[i + 2]];
    if (dot(cross(b - a, c - a), eye - a) > 0) continue;
    kept.insert(kept.end(), mesh.indices.begin() + static_cast<std::ptrdiff_t>(i),
                mesh.indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  mesh.indices = std::move(kept);
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.indices[i]];
    area += 0.5 * length(cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a));
  }
  return area;
}

void add_cage(PbrtText& text) {
  constexpr int kSlats = 11;
  constexpr float kRadius = 1.75f;
  text << "# A cage of slats, on a floor.\nAttributeBegin\n  Material \"diffuse\" \"rgb reflectance\" [0.16 0.13 0.11]\n";
  for (int i = 0; i < kSlats; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / kSlats;  // a gap toward the camera
    text << block(
        {.foot = {kRadius * std::cos(angle), 0, kRadius * std::sin(angle)}, .size = {0.06f, 2.0f, 0.56f}, .turn = -angle});
  }
  text << "  Material \"coateddiffuse\" \"rgb reflectance\" [0.3 0.28 0.26] \"float roughness\" 0.2\n"
       << quad({-14, 0, -14}, {-14, 0, 14}, {14, 0, 14}, {14, 0, -14}) << "AttributeEnd\n";
}

}  // namespace

std::vector<ExampleFile> make_mesh_light_fog(const ExampleSettings& s) {
  const Fog fog{.bounds = {{-13, -0.5f, -13}, {13, 7, 13}},
                .sigma_s = {0.052f, 0.055f, 0.06f},
                .sigma_a = Rgb(0.004f),
                .g = 0.2f,
                .density = s.density};
  constexpr View kView{.eye = {-2.2f, 5.3f, -5.4f}, .look = {0, 0.75f, 0}, .fov_degrees = 42};
  PbrtText text = scene_head(s, kView, fog_medium(fog));
  add_fog(fog, text);
  add_cage(text);

  Rng rng = stream(s.seed, 1);
  TriangleMesh mesh = knot(2 * s.lights, rng);  // about half of a tube faces any viewer
  shade_from(kView.eye, mesh);
  constexpr float kPower = 280;
  text << "# The knot: " << static_cast<int>(mesh.indices.size() / 3) << " emissive triangles.\nAttributeBegin\n";
  add_emission(text, Rgb(1.8f, 0.88f, 0.32f) * (kPower / (kPi * static_cast<float>(area_of(mesh)))));
  text << "  Shape \"plymesh\" \"string filename\" \"knot.ply\"\nAttributeEnd\n";
  return {{scene_name(s), text.take()}, {"knot.ply", encode_ply(mesh)}};
}

}  // namespace tyndall
