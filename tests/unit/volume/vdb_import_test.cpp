#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "support/scratch.h"
#include "tyndall/volume_io.h"
#include "unit/volume/vdb_import.h"
#include "volume/vdb_file.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("a .vdb reads as OpenVDB's BoxSampler: tiles, negative and far coordinates, any affine map, half and double") {
  const test::Scratch scratch;
  const std::string path = scratch / "smoke.vdb";
  Rng rng(1);
  const Transform maps[] = {Transform(),
                            Transform::translate(1, 2, 3) * Transform::rotate(40, 1, 2, 3) * Transform::scale(0.1, 0.3, 0.05),
                            Transform::scale(-0.25, 0.25, 0.25)};
  for (const std::array<int, 3>& corner : {std::array<int, 3>{0, 0, 0}, {-37, -300, 5}, {4090, -4100, 120}})
    for (const Transform& map : maps)
      for (const VdbGrid::Type type : {VdbGrid::Type::scalar, VdbGrid::Type::half, VdbGrid::Type::double_precision}) {
        VdbGrid grid;
        grid.type = type;
        grid.index_to_world = map;
        grid.voxels = speckles(rng, corner, 40, 3000);
        grid.boxes.push_back(
            {{corner[0] + 3, corner[1] + 60, corner[2] - 4}, {corner[0] + 40, corner[1] + 90, corner[2] + 44}, 0.5f});
        test::write_vdb(path, {grid});
        const Transform to_world = Transform::rotate(10, 0, 0, 1) * Transform::scale(2, 2, 2);
        const Import loaded = import(path, {}, {}, to_world);
        if (type == VdbGrid::Type::double_precision) {
          CHECK(loaded.medium.sigma_maj() > 2);
          continue;  // the oracle reads floats
        }
        const Transform index_to_world = to_world * map;
        std::vector<Vec3> points;
        for (int i = 0; i < 3000; ++i)
          points.push_back({static_cast<float>(corner[0]) - 2 + rng.uniform() * 44,
                            static_cast<float>(corner[1]) - 2 + rng.uniform() * 95,
                            static_cast<float>(corner[2]) - 6 + rng.uniform() * 52});
        const std::vector<float> expected = test::openvdb_samples(path, points);
        float worst = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
          worst = std::max(worst, std::abs(loaded.medium.at(index_to_world.point(points[i])).sigma_a.r - expected[i]));
        CHECK(worst < 5e-3f);  // floats of world coordinates around index 4096
        CHECK(contains(loaded.notes, "smoke.vdb: density grid \"density\""));
      }
}

TEST_CASE("a background other than 0 fills the active bounding box and nothing beyond") {
  const test::Scratch scratch;
  VdbGrid grid;
  grid.background = 1;
  grid.voxels = {{{-3, 0, 0}, 2.0f}, {{20, 10, 5}, 3.0f}};
  test::write_vdb(scratch / "box.vdb", {grid});
  const Import loaded = import(scratch / "box.vdb");
  const auto at = [&](float x, float y, float z) { return loaded.medium.at({x, y, z}).sigma_a.r; };
  CHECK(at(-3, 0, 0) == doctest::Approx(2));
  CHECK(at(20, 10, 5) == doctest::Approx(3));
  CHECK(at(0, 0, 0) == doctest::Approx(1));
  CHECK(at(10.5f, 5, 2.5f) == doctest::Approx(1));
  CHECK(at(10, 10.5f, 5) == doctest::Approx(0.5));  // the tap outside reads 0
  CHECK(at(10, 11, 5) == 0);
  CHECK(at(-5, 0, 0) == 0);
  CHECK(at(100, 100, 100) == 0);
}

TEST_CASE("vec3 density multiplies per channel") {
  const test::Scratch scratch;
  VdbGrid grid;
  grid.type = VdbGrid::Type::vec3;
  grid.boxes = {{{0, 0, 0}, {9, 9, 9}, 1.0f}};
  test::write_vdb(scratch / "c.vdb", {grid});
  const Coefficients k = import(scratch / "c.vdb").medium.at({4, 5, 6});
  CHECK(k.sigma_a.r == doctest::Approx(1));
  CHECK(k.sigma_a.g == doctest::Approx(0.5));
  CHECK(k.sigma_s.b == doctest::Approx(0.25));
}

TEST_CASE("grids are found by name, number and alias, and the choice is told") {
  const test::Scratch scratch;
  const std::string path = scratch / "many.vdb";
  const auto filled = [](const std::string& name, float value) {
    VdbGrid grid;
    grid.name = name;
    grid.boxes = {{{0, 0, 0}, {9, 9, 9}, value}};
    return grid;
  };
  test::write_vdb(path,
                  {filled("density", 1), filled("density", 2), filled("smoke", 3), filled("heat", 1000), filled("odd", 5)});
  const auto value = [&](const VdbMedium& vdb) { return import(path, vdb).medium.at({4, 4, 4}).sigma_a.r; };
  CHECK(value({}) == doctest::Approx(1));
  CHECK(value(named("density[1]")) == doctest::Approx(2));
  CHECK(value(named("density[0]")) == doctest::Approx(1));
  CHECK(value(named("smoke")) == doctest::Approx(3));
  CHECK(value(named("odd")) == doctest::Approx(5));
  const Import loaded = import(path);
  CHECK(contains(loaded.notes, "2 grids are called \"density\""));
  CHECK(contains(loaded.notes, "temperature grid \"heat\""));
  CHECK(loaded.medium.emissive());
  CHECK(contains(error_of(path, named("missing")), "has no grid \"missing\"; it holds \"density\" (float)"));
  CHECK(contains(error_of(path, named("density[2]")), "has no grid"));

  test::write_vdb(path, {filled("voxel_fog", 4)});
  CHECK(value({}) == doctest::Approx(4));  // the only one there is
  test::write_vdb(path, {filled("a", 4), filled("b", 4)});
  CHECK(contains(error_of(path), "name one"));
}

TEST_CASE("temperature and flame make light; what is cold, empty or absent makes none") {
  const test::Scratch scratch;
  const std::string path = scratch / "fire.vdb";
  VdbGrid density, temperature, flame;
  density.boxes = {{{0, 0, 0}, {15, 15, 15}, 0.5f}};
  temperature.name = "temperature";
  temperature.boxes = {{{0, 0, 0}, {15, 15, 15}, 0.5f}};
  temperature.index_to_world = Transform::scale(2, 2, 2);  // a grid of its own
  flame.name = "flames";
  flame.boxes = {{{4, 4, 4}, {12, 12, 12}, 0.25f}};
  test::write_vdb(path, {density, temperature, flame});

  VdbMedium vdb;
  CHECK_FALSE(import(path, vdb).medium.emissive());  // 0.5 K
  vdb.temperature_scale = 4000;
  vdb.temperature_offset = -0.25f;
  vdb.Le_scale = 2;
  const Import hot = import(path, vdb);
  CHECK(hot.medium.emissive());
  const Coefficients k = hot.medium.at({8, 8, 8});
  CHECK(k.Le.r > 0);
  CHECK(hot.medium.at({-0.5f, 8, 8}).sigma_a.r > 0);
  vdb.flame_grid = "flame";  // an alias of "flames"
  const Import burning = import(path, vdb);
  CHECK(burning.medium.at({8, 8, 8}).Le.r == doctest::Approx(k.Le.r / 4).epsilon(1e-3));
  CHECK(burning.medium.at({2, 8, 8}).Le.r == 0);
  vdb.Le = {1, 0.5f, 0.25f};
  vdb.temperature_scale = 1e-3f;  // too cold: the flame is alone
  CHECK(import(path, vdb).medium.at({8, 8, 8}).Le.g == doctest::Approx(2 * 0.5 * 0.25));
  CHECK_FALSE(contains(import(path, vdb).notes, "Le is ignored"));
  vdb.flame_grid.clear();
  CHECK_FALSE(contains(import(path, vdb).notes, "emits nothing"));
  vdb.emission_given = true;
  CHECK(contains(import(path, vdb).notes, "emits nothing"));
  vdb.temperature_scale = 4000;
  CHECK_FALSE(contains(import(path, vdb).notes, "emits nothing"));
  CHECK(contains(import(path, vdb).notes, "Le is ignored beside temperatures"));
  vdb.flame_grid = "flame";

  test::write_vdb(path, {density, flame});
  vdb.Le = {1, 0.5f, 0.25f};
  CHECK(import(path, vdb).medium.at({8, 8, 8}).Le.g == doctest::Approx(2 * 0.5 * 0.25));
  flame.boxes.clear();
  test::write_vdb(path, {density, flame});
  const Import out = import(path, vdb);
  CHECK_FALSE(out.medium.emissive());
  CHECK(contains(out.notes, "flame grid \"flames\" is empty"));
  vdb.temperature_grid = "t";
  vdb.temperature_grid_given = true;
  CHECK(contains(error_of(path, vdb), "has no grid \"t\""));
}

TEST_CASE("an empty density grid is an empty medium") {
  const test::Scratch scratch;
  test::write_vdb(scratch / "empty.vdb", {VdbGrid{}});
  const Import loaded = import(scratch / "empty.vdb");
  CHECK(loaded.medium.bounds().empty());
  CHECK(loaded.medium.sigma_maj() == 0);
  CHECK(is_black(loaded.medium.at({0, 0, 0}).sigma_t()));
  CHECK(contains(loaded.notes, "is empty"));
}

TEST_CASE("voxels that are no amount: negative ones become 0 with one warning, others are errors unless sanitized") {
  const test::Scratch scratch;
  const std::string path = scratch / "bad.vdb";
  VdbGrid grid;
  grid.voxels = {{{1, 1, 1}, 1.0f}, {{2, 1, 1}, -0.5f}, {{30, 1, 1}, -2.0f}};
  test::write_vdb(path, {grid});
  const Import negative = import(path);
  CHECK(contains(negative.notes, "2 negative voxels (lowest -2.0"));
  CHECK(negative.medium.at({2, 1, 1}).sigma_a.r == 0);

  grid.voxels = {{{1, 1, 1}, 1.0f}, {{5, 6, -7}, std::nanf("")}, {{40, 0, 0}, std::numeric_limits<float>::infinity()}};
  test::write_vdb(path, {grid});
  const std::string message = error_of(path);
  CHECK(contains(message, "grid \"density\": 2 voxels are NaN or infinite, the first at index (5, 6, -7)"));
  const Import clean = import(path, {}, {.sanitize = true});
  CHECK(clean.medium.sigma_maj() == doctest::Approx(2));
  CHECK(contains(clean.notes, "set to 0"));
}

/// The grid with each background that is no amount: none of its voxels counts as one.
std::vector<Import> with_no_amounts(VdbGrid grid) {
  const test::Scratch scratch;
  std::vector<Import> loaded;
  for (const float background : {-0.5f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    grid.background = background;
    test::write_vdb(scratch / "background.vdb", {grid});
    loaded.push_back(import(scratch / "background.vdb"));
    CHECK_FALSE(contains(loaded.back().notes, "set to 0"));
  }
  return loaded;
}

TEST_CASE("a background that is no amount is empty space, and counts as no voxel") {
  VdbGrid grid;
  grid.boxes = {{{0, 0, 0}, {15, 15, 15}, 1}};
  for (const Import& loaded : with_no_amounts(grid)) {
    CHECK(loaded.medium.at({8, 8, 8}).sigma_a.r == doctest::Approx(1));
    CHECK(loaded.medium.at({20, 8, 8}).sigma_a.r == 0);
  }
}

// Between the box and a voxel of its own there are some that nobody has set, in leaves as well.
TEST_CASE("voxels that were not set are empty space where the background is no amount") {
  VdbGrid grid;
  grid.boxes = {{{0, 0, 0}, {11, 11, 11}, 1}};
  grid.voxels = {{{40, 2, 2}, 1.0f}};
  for (const Import& loaded : with_no_amounts(grid)) {
    CHECK(loaded.medium.at({11, 8, 8}).sigma_a.r == doctest::Approx(1));
    CHECK(loaded.medium.at({40, 2, 2}).sigma_a.r == doctest::Approx(1));
    CHECK(loaded.medium.at({13, 8, 8}).sigma_a.r == 0);
    CHECK(loaded.medium.at({30, 2, 2}).sigma_a.r == 0);
  }
}

TEST_CASE("temperatures have the sign of their background") {
  const test::Scratch scratch;
  const std::string path = scratch / "celsius.vdb";
  VdbGrid density, temperature;
  density.boxes = {{{0, 0, 0}, {47, 15, 15}, 0.5f}};
  temperature.name = "temperature";
  temperature.background = -2000;
  temperature.boxes = {{{0, 0, 0}, {11, 15, 15}, 0}};
  temperature.voxels = {{{47, 15, 15}, -2000.0f}};
  test::write_vdb(path, {density, temperature});
  VdbMedium vdb;
  vdb.temperature_offset = -2000;
  const Import loaded = import(path, vdb);
  CHECK(loaded.medium.at({8, 8, 8}).Le.r > 0);
  for (const float x : {13.0f, 20.0f, 30.0f, 44.0f}) CHECK(loaded.medium.at({x, 8, 8}).Le.r == 0);
}

TEST_CASE("temperatures that nobody asked for stop no density") {
  const test::Scratch scratch;
  const std::string path = scratch / "cold.vdb";
  VdbGrid density, temperature;
  density.boxes = temperature.boxes = {{{0, 0, 0}, {15, 15, 15}, 0.5f}};
  temperature.name = "temperature";
  temperature.frustum = true;
  test::write_vdb(path, {density, temperature});
  const Import bent = import(path);
  CHECK_FALSE(bent.medium.emissive());
  CHECK(contains(bent.notes, "temperature grid \"temperature\" is passed over"));
  temperature.frustum = false;
  temperature.voxels = {{{1, 1, 1}, std::nanf("")}};
  test::write_vdb(path, {density, temperature});
  CHECK(contains(error_of(path), "NaN"));
  VdbMedium dark;
  dark.Le_scale = 0;
  CHECK_FALSE(import(path, dark).medium.emissive());
}

TEST_CASE("grids are chosen by names in any script") {
  const test::Scratch scratch;
  const std::string path = scratch / "names.vdb";
  VdbGrid grid;
  grid.boxes = {{{0, 0, 0}, {15, 15, 15}, 1}};
  VdbGrid other = grid;
  grid.name = "Dichte \u00fc";
  other.name = "\u7159";
  test::write_vdb(path, {grid, other});
  CHECK(import(path, named(grid.name)).medium.at({8, 8, 8}).sigma_a.r == doctest::Approx(1));
  CHECK(import(path, named(other.name)).medium.at({8, 8, 8}).sigma_a.r == doctest::Approx(1));
  CHECK(contains(error_of(path, named("none")), grid.name));
}

TEST_CASE("grids are chosen by their true names, however long or unprintable, and by what messages call them") {
  const test::Scratch scratch;
  const std::string path = scratch / "names.vdb", begin(400, 'a');
  const std::vector<std::string> names{begin + "1", begin + "2", "a\tb", "c\nd"};
  std::vector<VdbGrid> grids;
  for (const std::string& name : names) {
    VdbGrid& grid = grids.emplace_back();
    grid.name = name;
    grid.boxes = {{{0, 0, 0}, {9, 9, 9}, static_cast<float>(grids.size())}};
  }
  test::write_vdb(path, grids);
  const auto value = [&](const std::string& name) { return import(path, named(name)).medium.at({4, 4, 4}).sigma_a.r; };
  for (std::size_t i = 0; i < names.size(); ++i) CHECK(value(names[i]) == doctest::Approx(static_cast<double>(i + 1)));
  CHECK(value("a b") == doctest::Approx(3));
  const std::string error = error_of(path, named("none"));
  CHECK(contains(error, "\"a b\""));
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("what is no fog is refused by name") {
  const test::Scratch scratch;
  const std::string path = scratch / "x.vdb";
  VdbGrid grid;
  grid.voxels = {{{1, 1, 1}, 1.0f}};
  grid.grid_class = VdbGrid::Class::level_set;
  test::write_vdb(path, {grid});
  CHECK(contains(error_of(path), "density grid \"density\" is a level set"));
  grid.grid_class = VdbGrid::Class::fog;
  grid.frustum = true;
  test::write_vdb(path, {grid});
  CHECK(contains(error_of(path), "frustum"));
  CHECK(contains(error_of(kData + "pointgrid.vdb", named("points")), "PointDataGrid"));
  CHECK(contains(error_of(kData + "pointgrid.vdb"), "PointDataGrid"));
}

TEST_CASE(".nvdb: every type and codec reads as the ball it was made of") {
  // Density 1 - r / 9 within radius 9 of voxel (3, -2, 5); voxels of 0.25, the origin at (1, 2, 3).
  const struct {
    const char* file;
    float tolerance;
  } files[] = {{"ball_float_zip.nvdb", 1e-4f}, {"ball_float_blosc.nvdb", 1e-4f}, {"ball_fp16_zip.nvdb", 1e-4f},
               {"ball_fp8_zip.nvdb", 4e-3f},   {"ball_fp4_zip.nvdb", 6e-2f},     {"ball_fpn_zip.nvdb", 2e-2f},
               {"ball_vec3_zip.nvdb", 1e-4f}};
  for (const auto& ball : files) {
    const Import loaded = import(kData + ball.file);
    float worst = 0;
    for (int i = 0; i < 21 * 21 * 21; ++i) {
      const int x = i % 21 - 10, y = i / 21 % 21 - 10, z = i / 441 - 10;
      const float r = std::sqrt(static_cast<float>(x * x + y * y + z * z));
      const Vec3 world{1 + 0.25f * static_cast<float>(x + 3), 2 + 0.25f * static_cast<float>(y - 2),
                       3 + 0.25f * static_cast<float>(z + 5)};
      worst = std::max(worst, std::abs(loaded.medium.at(world).sigma_a.r - (r < 9 ? 1 - r / 9 : 0)));
    }
    CHECK_MESSAGE(worst < ball.tolerance, ball.file << ": " << worst);
  }
}

TEST_CASE("a volume that needs more memory than there is is refused before it is taken") {
  const test::Scratch scratch;
  const std::string path = scratch / "large.vdb";
  VdbGrid hollow;  // nearly nothing in the file, and bricks all over its faces
  hollow.background = 1;
  hollow.voxels = {{{0, 0, 0}, 2.0f}, {{2000, 2000, 2000}, 2.0f}};
  test::write_vdb(path, {hollow});
  CHECK(contains(error_of(path, {}, {.most_memory = std::size_t{64} << 20}), "becomes more bricks than 0.06"));

  // 20^3 leaves, not one of a single value: 4 bytes a voxel in the tree of the reading process, 4 as they are received
  // and 3 as bricks are 45 MB.
  VdbGrid dense;
  for (int z = 1; z < 160; z += 8) dense.boxes.push_back({{0, 0, z}, {159, 159, z + 5}, 1.0f});
  test::write_vdb(path, {dense});
  CHECK(contains(error_of(path, {}, {.most_memory = 40'000'000}), "\"density\" is estimated to need 0.045"));
  CHECK(import(path, {}, {.most_memory = 60'000'000}).medium.sigma_maj() > 0);
}

TEST_CASE(".nvdb: grids that need more memory than there is are not unpacked") {
  const std::string path = kData + "ball_float_zip.nvdb", says = "raise --max-memory or use a coarser volume";
  CHECK(contains(error_of(path, {}, {.most_memory = 1000}), "holds a grid of 0.0"));
  CHECK(contains(error_of(path, {}, {.most_memory = 1000}), says));
  CHECK(contains(error_of(kData + "ball_float_blosc.nvdb", {}, {.most_memory = 1000}), says));
  CHECK(import(path, {}, {.most_memory = 100'000'000}).medium.sigma_maj() > 0);

  // Two segments, one after the other: their sum counts.
  const test::Scratch scratch;
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::ofstream(scratch / "two.nvdb", std::ios::binary) << bytes << bytes;
  std::size_t each = 0;
  for (const auto& [name, value] : open_volume(path)->describe(0))
    if (name == "memory") each = std::stoul(value);
  REQUIRE(each > 1000);
  CHECK(open_volume(scratch / "two.nvdb", 2 * each)->grids().size() == 2);
  CHECK_THROWS_WITH_AS(open_volume(scratch / "two.nvdb", 2 * each - 1), doctest::Contains("holds a grid of"), Error);
}

TEST_CASE("describe_volume lists every grid with its properties") {
  const test::Scratch scratch;
  VdbGrid grid, other;
  grid.voxels = {{{1, 2, 3}, 1.5f}, {{4, 2, 3}, 0.5f}};
  grid.index_to_world = Transform::scale(0.5, 0.5, 0.5);
  other.type = VdbGrid::Type::vec3;
  other.name = "velocity";
  test::write_vdb(scratch / "two.vdb", {grid, grid, other});
  const Description description = describe_volume(scratch / "two.vdb");
  CHECK(description.kind == "OpenVDB");
  const auto value = [&](const std::string& subject, const std::string& name) {
    for (const Property& p : description.properties)
      if (p.subject == subject && p.name == name) return p.value;
    return std::string("absent");
  };
  CHECK(value("density", "type") == "float");
  CHECK(value("density", "class") == "Fog Volume");
  CHECK(value("density", "voxel size") == "[0.5, 0.5, 0.5]");
  CHECK(value("density", "active voxels") == "2");
  CHECK(value("density", "maximum") == "1.5");
  CHECK(value("density", "world bounds") == "[0.25, 0.75, 1.25] .. [2.25, 1.25, 1.75]");
  CHECK(value("density[1]", "type") == "float");
  CHECK(value("velocity", "type") == "vec3s");
  CHECK(value("velocity", "world bounds") == "empty");
  CHECK(describe_volume(kData + "ball_vec3_zip.nvdb").kind == "NanoVDB");
  CHECK_THROWS_AS(describe_volume(scratch / "none.vdb"), Error);
}
