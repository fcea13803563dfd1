/// How a vertex puts itself to light selection: lights should be chosen in proportion to what it scatters of them.
#include "transport/vertex/vertex.h"

#include <doctest/doctest.h>

#include "light/wide_light_tree.h"
#include "math/rng.h"

namespace tyndall {
namespace {

Vec3 direction(Rng& rng) {
  const float z = 2 * rng.uniform() - 1, phi = 2 * kPi * rng.uniform(), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// 1000 equal points of light around the origin.
WideLightTree sphere_of_lights(std::vector<Vec3>& places) {
  Rng rng(4);
  std::vector<TreeLight> lights;
  for (LightId i = 0; i < 1000; ++i) {
    places.push_back(direction(rng));
    LightBounds b;
    b.box.expand(places.back() * 50.0f);
    b.normals = DirectionCone::everything();
    b.theta_e = kPi / 2;
    b.intensity = 1;
    lights.push_back({b, i});
  }
  return WideLightTree(std::move(lights));
}

/// sum f^2 / p / (sum f)^2 - 1 of the vertex's light, one light chosen.
double relative_variance(const WideLightTree& tree, const std::vector<Vec3>& places, const Vertex& vertex,
                         const PointQuery& query) {
  double sum = 0, second = 0;
  std::vector<std::uint32_t> leaf(places.size());
  tree.for_each_leaf([&](LightId light, std::uint32_t ref) { leaf[light] = ref; });
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double f = mean(vertex.eval(places[i]));
    if (!(f > 0)) continue;
    const double p = tree.pmf(query, leaf[i]);
    REQUIRE(p > 0);
    sum += f;
    second += f * f / p;
  }
  return second / (sum * sum) - 1;
}

Vertex surface(const Bsdf::Lobe& lobe, Vec3 wo) {
  SurfaceHit hit{};
  hit.ng = hit.ns = {0, 0, 1};
  hit.dpdu = {1, 0, 0};
  return Vertex(Vertex::Surface{hit, Bsdf(Frame::around({0, 0, 1}), lobe)}, wo, MediaState());
}

TEST_CASE("lights are chosen by the surface's lobes and the medium's phase function") {
  std::vector<Vec3> places;
  const WideLightTree tree = sphere_of_lights(places);
  const Vec3 wo = normalize(Vec3{0.6f, -0.3f, 0.5f});
  const Rgb metal = conductor_k(Rgb(0.9f));
  const DielectricLobe rough_glass{1.5f, Ggx(0.2f, 0.2f)};
  PhaseMix forward;
  const Phase lobe = HenyeyGreenstein{0.8f};
  forward.add(Rgb(1.0f), lobe);
  struct Case {
    std::string name;
    Vertex vertex;
    double most;  ///< of what is left of the variance
  };
  const Case cases[] = {
      {"dull metal", surface(ConductorLobe{Ggx(0.4f, 0.4f), Rgb(1.0f), metal}, wo), 0.1},
      {"glossy metal", surface(ConductorLobe{Ggx(0.15f, 0.15f), Rgb(1.0f), metal}, wo), 0.1},
      {"brushed metal", surface(ConductorLobe{Ggx(0.4f, 0.1f), Rgb(1.0f), metal}, wo), 0.2},
      {"rough glass", surface(rough_glass, wo), 0.5},
      {"rough glass from within", surface(rough_glass, -wo), 1},
      {"coated", surface(CoatedDiffuseLobe{rough_glass, {Rgb(0.5f)}, Coat{}}, wo), 0.5},
      {"forward scattering", Vertex(Vertex::InMedium{{}, forward}, wo, MediaState()), 0.1},
  };
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const PointQuery query = c.vertex.light_query();
    PointQuery plain = query;
    plain.lobe_count = 0;
    plain.g = 0;
    const double with = relative_variance(tree, places, c.vertex, query);
    const double without = relative_variance(tree, places, c.vertex, plain);
    MESSAGE(c.name, ": relative variance ", with, ", without lobes ", without);
    CHECK(with < c.most * without);
  }
}

}  // namespace
}  // namespace tyndall
