#include "tyndall/color.h"
#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::read_world;
using test::world_error;

namespace {

/// The medium `m` with these parameters.
Medium medium(const std::string& params) { return read_world("MakeNamedMedium \"m\" " + params).media.at(0); }
std::string medium_error(const std::string& params) { return world_error("MakeNamedMedium \"m\" " + params); }

void check_near(Rgb a, Rgb b) {
  for (int i = 0; i < 3; ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-4).scale(1));
}

}  // namespace

TEST_CASE("phase functions by name, with their own parameters and no others") {
  const auto phase = [](const std::string& parameters) {
    return medium("\"string type\" \"homogeneous\" " + parameters).optics.phase;
  };
  CHECK(phase("\"string phase\" \"henyey-greenstein\" \"float g\" .4") == Phase(HenyeyGreenstein{.4f}));
  CHECK(phase("\"string phase\" \"rayleigh\"") == Phase(Rayleigh{}));
  CHECK(phase("\"string phase\" \"draine\" \"float g\" .4 \"float alpha\" 3") == Phase(Draine(.4f, 3)));
  CHECK(phase("\"string phase\" \"draine\"") == Phase(Draine(0, 1)));
  CHECK(phase("\"string phase\" \"mie\" \"float diameter\" 20") == Phase(Mie(20)));
  CHECK_THROWS_WITH_AS(phase("\"string phase\" \"mei\""), doctest::Contains("\"mei\" is unknown"), Error);
  CHECK_THROWS_WITH_AS(phase("\"string phase\" \"rayleigh\" \"float g\" .4"), doctest::Contains("no parameter \"g\""), Error);
  CHECK_THROWS_WITH_AS(phase("\"string phase\" \"mie\" \"float diameter\" 60"), doctest::Contains("between 0.01 and 50"),
                       Error);
  CHECK_THROWS_WITH_AS(phase("\"string phase\" \"draine\" \"float alpha\" -1"), doctest::Contains("between 0 and 1000"), Error);
}

TEST_CASE("homogeneous: defaults, scale and emission") {
  Medium m = medium("\"string type\" \"homogeneous\"");
  CHECK(m.optics.sigma_a == Rgb(1.0f));
  CHECK(m.optics.sigma_s == Rgb(1.0f));
  CHECK(m.optics.phase == Phase(HenyeyGreenstein{0}));
  CHECK(m.name == "m");
  m = medium(
      R"("string type" "homogeneous" "rgb sigma_a" [1 2 3] "spectrum sigma_s" [200 2 900 2] "float scale" 10 "float g" -.5
    "rgb Le" [1 2 3] "float Lescale" 2)");
  CHECK(m.optics.sigma_a == Rgb(10, 20, 30));
  check_near(m.optics.sigma_s, Rgb(20.0f));
  CHECK(m.optics.phase == Phase(HenyeyGreenstein{-.5f}));
  check_near(std::get<HomogeneousMedium>(m.kind).Le, {2, 4, 6});
  // A spectrum of emission is scaled to luminance 1, whatever its values.
  CHECK(
      luminance(std::get<HomogeneousMedium>(medium("\"string type\" \"homogeneous\" \"spectrum Le\" [300 5 900 5]").kind).Le) ==
      doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("presets") {
  CHECK(medium("\"string type\" \"homogeneous\" \"string preset\" \"Wholemilk\" \"float scale\" 2").optics.sigma_s ==
        Rgb(5.1f, 6.42f, 7.54f));
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"string preset\" \"wholemilk\""),
                 "did you mean \"Wholemilk\"?");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"string preset\" \"Cream\" \"rgb sigma_a\" [1 1 1]"),
                 "not both");
}

TEST_CASE("uniformgrid") {
  const Medium m = medium(R"("string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 1 "float density" [.5 1]
    "point3 p0" [2 0 0] "point3 p1" [0 2 2] "float temperature" [10 20] "float temperatureoffset" 5 "float temperaturescale" 100
    "float Lescale" [1 3])");
  const auto& g = std::get<UniformGridMedium>(m.kind);
  CHECK(g.nx == 2);
  CHECK(g.density == std::vector<float>{.5f, 1});
  CHECK(g.bounds.min == Vec3{0, 0, 0});
  CHECK(g.bounds.max == Vec3{2, 2, 2});
  CHECK(g.temperature == std::vector<float>{10, 20});
  CHECK(g.temperature_offset == 5);
  CHECK(g.temperature_scale == 100);
  CHECK(g.Le_scale == std::vector<float>{1, 3});
  CHECK_CONTAINS(medium_error("\"string type\" \"uniformgrid\""), "has no density");
  CHECK_CONTAINS(medium_error("\"string type\" \"uniformgrid\" \"integer nx\" 3 \"float density\" [1 2]"),
                 "\"density\" has 2 values; nx*ny*nz is 3*1*1");
  CHECK_CONTAINS(medium_error("\"string type\" \"uniformgrid\" \"integer nx\" 2 \"float density\" [1 -2]"),
                 "negative at index 1");
  CHECK_CONTAINS(medium_error("\"string type\" \"uniformgrid\" \"integer nx\" 2000000000 \"integer ny\" 2000000000 \"integer "
                              "nz\" 2000000000 \"float density\" [1]"),
                 "nx*ny*nz");
  CHECK_CONTAINS(medium_error("\"string type\" \"uniformgrid\" \"integer nx\" 0 \"float density\" [1]"), "at least 1");
  CHECK_CONTAINS(medium_error("\"string type\" \"uniformgrid\" \"float density\" 1 \"point3 p1\" [0 1 1]"),
                 "box from p0 to p1 is empty");
  CHECK_CONTAINS(medium_error("\"string type\" \"uniformgrid\" \"float density\" 1 \"float temperature\" 1 \"rgb Le\" [1 1 1]"),
                 "not both");
}

TEST_CASE("rgbgrid: emission is not normalised, as in pbrt") {
  const Medium m =
      medium(R"("string type" "rgbgrid" "integer nx" 2 "rgb sigma_a" [1 2 3 4 5 6] "rgb Le" [1 1 1 0 0 0] "float Lescale" 2
    "float scale" 3 "float g" .1)");
  const auto& g = std::get<RgbGridMedium>(m.kind);
  CHECK(g.sigma_a == std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}});
  CHECK(g.sigma_s.empty());
  CHECK(g.Le.at(0).r == doctest::Approx(2 * 106.856895));
  CHECK(g.scale == 3);
  CHECK(m.optics.phase == Phase(HenyeyGreenstein{.1f}));
  CHECK_CONTAINS(medium_error("\"string type\" \"rgbgrid\""), "neither sigma_a nor sigma_s");
  CHECK_CONTAINS(medium_error("\"string type\" \"rgbgrid\" \"rgb sigma_s\" [1 1 1] \"rgb Le\" [1 1 1]"), "needs \"sigma_a\"");
  CHECK_CONTAINS(medium_error("\"string type\" \"rgbgrid\" \"rgb sigma_s\" [1 1 1 2 2 2]"), "has 2 values");
}

TEST_CASE("cloud") {
  const auto c = std::get<CloudMedium>(
      medium("\"string type\" \"cloud\" \"float density\" 4 \"float wispiness\" 2 \"float frequency\" 3").kind);
  CHECK(c.density == 4);
  CHECK(c.wispiness == 2);
  CHECK(c.frequency == 3);
}

TEST_CASE("nanovdb, also spelled openvdb") {
  const test::TempFolder folder;
  folder.write("smoke.vdb", "not read here");
  const std::string text =
      R"(WorldBegin Translate 1 2 3 MakeNamedMedium "m" "string type" "openvdb" "string filename" "smoke.vdb" "string gridname" "soot"
    "string flamename" "flames" "float temperatureoffset" 1 "float temperaturescale" 2 "float Lescale" 3 "rgb Le" [1 .5 .25] "float scale" 4)";
  const Medium m = read_scene_text(text, "test.pbrt", folder.path()).scene.media.at(0);
  const auto& v = std::get<VdbMedium>(m.kind);
  CHECK(v.path == folder.path() + "/smoke.vdb");
  CHECK(v.density_grid == "soot");
  CHECK(v.density_grid_given);
  CHECK(v.temperature_grid == "temperature");
  CHECK_FALSE(v.temperature_grid_given);
  CHECK(v.flame_grid == "flames");
  CHECK(v.temperature_offset == 1);
  CHECK(v.temperature_scale == 2);
  CHECK(v.Le_scale == 3);
  CHECK(v.Le == Rgb(1, .5f, .25f));
  CHECK(m.optics.sigma_a == Rgb(4.0f));
  CHECK(m.to_world.point({0, 0, 0}) == Vec3{1, 2, 3});
  CHECK_CONTAINS(medium_error("\"string type\" \"nanovdb\" \"string filename\" \"absent.nvdb\""),
                 "file \"absent.nvdb\" does not exist");
}

TEST_CASE("medium errors") {
  CHECK_CONTAINS(medium_error("\"rgb sigma_a\" [1 1 1]"), "medium has no type");
  CHECK_CONTAINS(medium_error("\"string type\" \"heterogeneous\""),
                 "medium type \"heterogeneous\" is unknown; did you mean \"homogeneous\"?");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"float g\" 1"), "between -1 and 1");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"float scale\" -1"), "must not be negative");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"float Lescale\" -1"), "must not be negative");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"rgb sigma_s\" [1e38 1 1] \"float scale\" 100"),
                 "sigma_s times its scale is more than a number can hold");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"string preset\" \"Ketchup\" \"float scale\" 3e38"),
                 "preset times its scale is more than a number can hold");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"rgb Le\" [1e38 1 1] \"float Lescale\" 100"),
                 "Le times its scale is more than a number can hold");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" \"float density\" 1"),
                 "medium \"m\" has no parameter \"density\"");
  CHECK_CONTAINS(medium_error("\"string type\" \"homogeneous\" MakeNamedMedium \"m\" \"string type\" \"cloud\""),
                 "defined twice");
  CHECK(test::error_of("WorldBegin\n\nMediumInterface \"smoke\" \"\"")
            .starts_with("test.pbrt:3:17: medium \"smoke\" is not defined; define it with MakeNamedMedium before line 3"));
}
