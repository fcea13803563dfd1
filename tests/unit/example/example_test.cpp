#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "example/example.h"
#include "example/lamps.h"
#include "example/plume.h"
#include "example/shapes.h"
#include "io/ply.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

/// Small enough to be made often.
ExampleOptions small(const ExampleInfo& info) {
  ExampleOptions o;
  if (info.lights) o.lights = 300;
  return o;
}

std::string all_bytes(const std::vector<ExampleFile>& files) {
  std::string text;
  for (const ExampleFile& f : files) text += f.name + "\n" + f.bytes;
  return text;
}

std::string message_of(std::string_view name, const ExampleOptions& options) {
  try {
    make_example(name, options);
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::usage);
    return e.what();
  }
  return "";
}

double triangle_area(const PlyMesh& mesh, std::size_t i) {
  const auto p = [&](std::size_t k) { return mesh.positions[mesh.triangles[3 * i + k]]; };
  return 0.5 * length(cross(p(1) - p(0), p(2) - p(0)));
}

struct Emission {
  double triangles = 0, power = 0;  ///< W, mean of the channels, of the emissive polygon files of a scene
};

/// As the reader sees it: every emissive mesh of more than a few triangles.
Emission emission_of(const std::string& folder, const std::vector<ExampleFile>& files) {
  Emission sum;
  const Scene scene = read_scene(write_example(files, folder)).scene;
  for (const Shape& shape : scene.shapes) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape.kind);
    if (!shape.emission || !mesh || mesh->indices.size() <= 3 * 60) continue;
    for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
      const auto p = [&](std::size_t k) { return mesh->positions[mesh->indices[i + k]]; };
      sum.power += 0.5 * length(cross(p(1) - p(0), p(2) - p(0))) * double(kPi) * mean(shape.emission->L);
      ++sum.triangles;
    }
  }
  for (const Light& light : scene.lights)
    if (const auto* point = std::get_if<PointLight>(&light.kind)) {
      sum.power += 4 * double(kPi) * mean(point->I);
      ++sum.triangles;
    }
  return sum;
}

TEST_CASE("equal options give equal bytes, another seed other ones") {
  for (const ExampleInfo& info : example_list()) {
    CAPTURE(info.name);
    const ExampleOptions options = small(info);
    const std::string once = all_bytes(make_example(info.name, options));
    CHECK(once == all_bytes(make_example(info.name, options)));
    ExampleOptions other = options;
    other.seed = 1;
    CHECK(once != all_bytes(make_example(info.name, other)));
  }
}

TEST_CASE("every option shapes the scene") {
  ExampleOptions o{.lights = 50};
  const auto has = [&](const std::string& text, const char* name = "fog-street") {
    return make_example(name, o).front().bytes.find(text) != std::string::npos;
  };
  CHECK(has("\"integer xresolution\" 640 \"integer yresolution\" 360"));
  CHECK(has("--lights 50 --density 1 --max-depth 16 --resolution 640x360 --seed 0"));
  o = {.lights = 50, .density = 0.5, .max_depth = 3, .width = 64, .height = 48, .seed = 9};
  CHECK(has("\"integer maxdepth\" 3\n"));
  CHECK(has("\"float scale\" 0.5\n"));
  CHECK(has("\"integer xresolution\" 64 \"integer yresolution\" 48"));
  CHECK(has("--lights 50 --density 0.5 --max-depth 3 --resolution 64x48 --seed 9"));
  o = {.lights = 50, .shape = LampShape::point};
  CHECK(has("--lights 50 --shape point --density 1", "smoke-lights"));
  CHECK(has("LightSource \"point\"", "smoke-lights"));
}

TEST_CASE("unknown names and options list what there is") {
  CHECK(message_of("cieling", {}).find("glossy-lights, mesh-light-fog, ceiling") != std::string::npos);
  CHECK(message_of("ceiling", {.density = 2}).find("takes no --density; it takes --lights, --max-depth") != std::string::npos);
  CHECK(message_of("furnace", {.lights = 2}).find("takes no --lights") != std::string::npos);
  CHECK(message_of("ceiling", {.shape = LampShape::point}).find("takes no --shape") != std::string::npos);
  CHECK(!message_of("ceiling", {.lights = 0}).empty());
  CHECK(!message_of("ceiling", {.lights = 10'000'001}).empty());
  CHECK(!message_of("fog-street", {.density = -1}).empty());
  CHECK(!message_of("ceiling", {.max_depth = -1}).empty());
  CHECK(!message_of("ceiling", {.width = 0}).empty());
}

TEST_CASE("as many lights as asked for, of the same power for any number") {
  for (const char* name : {"glossy-lights", "ceiling", "smoke-lights", "fog-street", "mesh-light-fog"}) {
    CAPTURE(name);
    const double slack = std::string_view(name) == "mesh-light-fog" ? 0.03 : 1e-9;
    const Emission few = emission_of("few", make_example(name, {.lights = 3000}));
    const Emission many = emission_of("many", make_example(name, {.lights = 20000}));
    CHECK(few.triangles == doctest::Approx(3000).epsilon(slack));
    CHECK(many.triangles == doctest::Approx(20000).epsilon(slack));
    CHECK(few.power > 0);
    // The palette's colours have unlike luminances but like means, so the mean power is the same to rounding.
    CHECK(many.power == doctest::Approx(few.power).epsilon(1e-3));
  }
}

TEST_CASE("points and triangles carry the same power") {
  const Emission triangles = emission_of("triangles", make_example("smoke-lights", {.lights = 4000}));
  const Emission points = emission_of("points", make_example("smoke-lights", {.lights = 4000, .shape = LampShape::point}));
  CHECK(points.triangles == 4000);
  CHECK(points.power == doctest::Approx(triangles.power).epsilon(1e-3));
}

TEST_CASE("the powers of the lights are log-normal") {
  const auto files = make_example("ceiling", {.lights = 20000});
  const PlyMesh mesh = read_ply_bytes(files.at(1).bytes, files.at(1).name);
  double sum = 0, squares = 0;
  const std::size_t n = mesh.triangles.size() / 3;
  REQUIRE(n == 20000);
  for (std::size_t i = 0; i < n; ++i) {
    const double l = std::log(triangle_area(mesh, i));
    sum += l, squares += l * l;
  }
  const double m = sum / double(n), deviation = std::sqrt(squares / double(n) - m * m);
  CHECK(deviation == doctest::Approx(1).epsilon(0.03));
}

TEST_CASE("the lights of the ceiling emit downward from under it") {
  const auto files = make_example("ceiling", {.lights = 500});
  const PlyMesh mesh = read_ply_bytes(files.at(1).bytes, files.at(1).name);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.triangles[i]];
    const Vec3 n = cross(mesh.positions[mesh.triangles[i + 1]] - a, mesh.positions[mesh.triangles[i + 2]] - a);
    CHECK(normalize(n).y < -0.999f);
    CHECK(a.y < 1.8f);
    CHECK(a.y > 1.77f);
  }
}

TEST_CASE("log-normal shares sum to 1") {
  Rng rng(7);
  const auto shares = log_normal_shares(100000, 1, rng);
  double sum = 0;
  for (const float s : shares) sum += s;
  CHECK(sum == doctest::Approx(1).epsilon(1e-5));
  CHECK(*std::min_element(shares.begin(), shares.end()) > 0);
}

TEST_CASE("blocks have their normals outside") {
  for (const TriangleMesh& mesh :
       {box({-1, -2, -3}, {3, 2, 1}), block({.foot = {1, 2, 3}, .size = {1, 2, 3}, .turn = 0.7f, .lean = 0.2f})}) {
    double volume = 0;  // by the divergence theorem
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      volume += dot(mesh.positions[mesh.indices[i]],
                    cross(mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]])) /
                6.0;
    const Vec3 size = mesh.positions[0] == Vec3{-1, -2, -3} ? Vec3{4, 4, 4} : Vec3{1, 2, 3};
    CHECK(volume == doctest::Approx(size.x * size.y * size.z).epsilon(1e-5));
  }
}

TEST_CASE("the plume lies within its grid and has a hollow nowhere but outside") {
  const FogGrid plume = smoke_plume(0);
  CHECK(plume.values.size() == std::size_t(plume.nx) * std::size_t(plume.ny) * std::size_t(plume.nz));
  std::size_t filled = 0, at_the_side = 0;
  for (std::size_t i = 0; i < plume.values.size(); ++i) {
    if (plume.values[i] <= 0) continue;
    ++filled;
    CHECK(plume.values[i] <= 1);
    const auto x = int(i % std::size_t(plume.nx)), z = int(i / std::size_t(plume.nx) / std::size_t(plume.ny));
    if (x == 0 || z == 0 || x == plume.nx - 1 || z == plume.nz - 1) ++at_the_side;
  }
  CHECK(filled > plume.values.size() / 20);
  CHECK(filled < plume.values.size() / 2);
  CHECK(at_the_side == 0);  // nothing is cut off
}

TEST_CASE("writing leaves other files alone and replaces its own") {
  namespace fs = std::filesystem;
  fs::remove_all("out");
  const auto files = make_example("ceiling", {.lights = 10});
  CHECK(write_example(files, "out/deep") == (fs::path("out/deep") / "ceiling.pbrt").string());
  write_file("kept", "out/deep/notes.txt");
  write_file("old", "out/deep/ceiling.pbrt");
  write_example(files, "out/deep");
  CHECK(fs::file_size("out/deep/notes.txt") == 4);
  CHECK(fs::file_size("out/deep/ceiling.pbrt") == files.front().bytes.size());
  CHECK(std::distance(fs::directory_iterator("out/deep"), {}) == 3);
  CHECK_THROWS_AS(write_example(files, "out/deep/ceiling.pbrt"), Error);
}

}  // namespace
}  // namespace tyndall
