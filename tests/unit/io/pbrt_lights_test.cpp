#include "io/color.h"
#include "math/cie.h"
#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::read_world;
using test::world_error;

namespace {

template <typename Kind>
Kind light(const std::string& text) {
  return std::get<Kind>(read_world(text).lights.at(0).kind);
}

AreaLight area(const std::string& params) {
  return *read_world("AreaLightSource \"diffuse\" " + params + " Shape \"sphere\"").shapes.at(0).emission;
}

void check_near(Rgb a, Rgb b) {
  for (int i = 0; i < 3; ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-5).scale(1));
}

}  // namespace

TEST_CASE("point") {
  const auto p =
      light<PointLight>("Scale 2 2 2 LightSource \"point\" \"point3 from\" [1 2 3] \"rgb I\" [6 5 4] \"float scale\" .5");
  CHECK(p.position == Vec3{2, 4, 6});
  check_near(p.I, {3, 2.5f, 2});
  check_near(light<PointLight>("LightSource \"point\"").I, Rgb(1.0f));
  // Power is spread over the sphere; scale multiplies it.
  check_near(light<PointLight>("LightSource \"point\" \"float power\" 80 \"float scale\" .5").I, Rgb(40 / (4 * kPi)));
}

TEST_CASE("no light is negative") {
  for (const char* kind : {"point", "spot", "distant", "infinite"})
    CHECK_CONTAINS(world_error(std::string("LightSource \"") + kind + "\" \"float scale\" -1"),
                   "scale must not be negative; use 0 or more");
  CHECK_CONTAINS(world_error("AreaLightSource \"diffuse\" \"float scale\" -0.1 Shape \"sphere\""), "must not be negative");
}

TEST_CASE("spectra of lights are scaled to luminance 1") {
  const Rgb warm = light<PointLight>("LightSource \"point\" \"blackbody I\" 3000 \"float scale\" 5").I;
  CHECK(luminance(warm) == doctest::Approx(5).epsilon(1e-3));
  CHECK(warm.r > warm.b);
  CHECK(luminance(light<PointLight>("LightSource \"point\" \"spectrum I\" [300 7 900 7]").I) ==
        doctest::Approx(1).epsilon(1e-3));
  check_near(light<PointLight>("LightSource \"point\" \"spectrum I\" \"stdillum-D65\"").I,
             illuminant_rgb(*named_spectrum("stdillum-D65")));
}

TEST_CASE("spot") {
  const auto s = light<SpotLight>(
      "LightSource \"spot\" \"point3 from\" [1 0 0] \"point3 to\" [1 5 0] \"rgb I\" [1 2 3] \"float coneangle\" 40 \"float "
      "conedeltaangle\" 10");
  CHECK(s.to_world.point({0, 0, 0}) == Vec3{1, 0, 0});
  const Vec3 axis = s.to_world.vector({0, 0, 1});
  CHECK(axis.y == doctest::Approx(1));
  CHECK_FALSE(s.to_world.swaps_handedness());
  CHECK(s.cone_angle_degrees == 40);
  CHECK(s.falloff_start_degrees == 30);
  // The power integrates the smoothstep falloff: 2 pi (1 - (cos 30 + cos 40) / 2).
  const auto p = light<SpotLight>("LightSource \"spot\" \"float power\" 10 \"float coneangle\" 40 \"float conedeltaangle\" 10");
  check_near(p.I, Rgb(10 / (2 * kPi * (1 - (0.8660254f + 0.7660444f) / 2))));
  const auto start = [](const std::string& delta) {
    return light<SpotLight>("LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" " + delta)
        .falloff_start_degrees;
  };
  CHECK(start("60") == 20);   // as in pbrt-v4, which takes cos(-20 degrees)
  CHECK(start("100") == 40);  // the falloff is within the cone
  CHECK_CONTAINS(world_error("LightSource \"spot\" \"float conedeltaangle\" -1"), "must not be negative");
  CHECK_CONTAINS(world_error("LightSource \"spot\" \"point3 to\" [0 0 0]"), "same point");
  CHECK_CONTAINS(world_error("LightSource \"spot\" \"float coneangle\" 0"), "coneangle must be above 0");
}

TEST_CASE("distant") {
  const auto d = light<DistantLight>(
      "LightSource \"distant\" \"point3 from\" [0 2 0] \"point3 to\" [0 0 0] \"rgb L\" [2 2 2] \"float scale\" 3");
  CHECK(d.direction == Vec3{0, -1, 0});
  check_near(d.E, Rgb(6.0f));
  CHECK(light<DistantLight>("LightSource \"distant\"").direction == Vec3{0, 0, 1});
  check_near(light<DistantLight>("LightSource \"distant\" \"float illuminance\" 7").E, Rgb(7.0f));
  const Vec3 turned = light<DistantLight>("Rotate 90 1 0 0 LightSource \"distant\"").direction;
  CHECK(turned.y == doctest::Approx(-1));
}

TEST_CASE("infinite") {
  check_near(light<InfiniteLight>("LightSource \"infinite\" \"rgb L\" [1 2 3] \"float scale\" 2").L, {2, 4, 6});
  check_near(light<InfiniteLight>("LightSource \"infinite\" \"float illuminance\" 10").L, Rgb(10 / kPi));
  const test::TempFolder folder;
  folder.write("sky.exr", "not read here");
  const Scene s = read_scene_text(
                      "WorldBegin Rotate 90 0 1 0 LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 3 "
                      "\"float illuminance\" 9",
                      "test.pbrt", folder.path())
                      .scene;
  const auto map = std::get<InfiniteLight>(s.lights.at(0).kind);
  CHECK(map.path == folder.path() + "/sky.exr");
  CHECK(map.L == Rgb(3.0f));
  CHECK(*map.illuminance == 9);
  CHECK_FALSE(map.to_world.is_identity());
  // Portals stand in world space.
  const auto portal = light<InfiniteLight>("Scale 2 2 2 LightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 1 1 0 0 1 0]");
  REQUIRE(portal.portal);
  CHECK((*portal.portal)[2] == Vec3{1, 1, 0});
  CHECK_CONTAINS(world_error("LightSource \"infinite\" \"point3 portal\" [0 0 0 1 0 0 1 1 0]"), "four corners, not 3");
  CHECK_CONTAINS(world_error("LightSource \"infinite\" \"string filename\" \"absent.exr\""), "does not exist");
}

TEST_CASE("goniometric and projection") {
  const test::TempFolder folder;
  folder.write("map.exr", "not read here");
  const auto read = [&](const std::string& text) {
    return read_scene_text("WorldBegin " + text, "test.pbrt", folder.path()).scene;
  };
  const std::string file = " \"string filename\" \"map.exr\" ";
  const auto map = std::get<GoniometricLight>(
      read("Translate 1 2 3 LightSource \"goniometric\"" + file + "\"rgb I\" [1 2 3] \"float scale\" 2 \"float power\" 7")
          .lights.at(0)
          .kind);
  CHECK(map.path == folder.path() + "/map.exr");
  CHECK(map.to_world.point({}) == Vec3{1, 2, 3});
  check_near(map.I, {2, 4, 6});
  CHECK(*map.power == 7);
  const auto image = std::get<ProjectionLight>(
      read("LightSource \"projection\"" + file + "\"float fov\" 30 \"float scale\" 4").lights.at(0).kind);
  CHECK(image.fov_degrees == 30);
  CHECK(image.I == Rgb(4));
  CHECK(!image.power);
  CHECK_CONTAINS(world_error("LightSource \"goniometric\""), "has no \"filename\"");
  CHECK_CONTAINS(world_error("LightSource \"projection\""), "has no \"filename\"");
  CHECK_CONTAINS(world_error("LightSource \"goniometric\" \"string filename\" \"absent.ies\""), "does not exist");
  CHECK_THROWS_WITH_AS(read("LightSource \"projection\"" + file + "\"float fov\" 180"), doctest::Contains("below 180 degrees"),
                       Error);
}

TEST_CASE("area lights") {
  check_near(area("").L, Rgb(1.0f));
  const AreaLight a = area("\"rgb L\" [4 8 3] \"float scale\" 2 \"bool twosided\" true \"float power\" 40");
  check_near(a.L, {8, 16, 6});
  CHECK(a.two_sided);
  CHECK(*a.power == 40);
  CHECK_FALSE(area("\"float power\" -1").power);
  CHECK_FALSE(area("").two_sided);
  CHECK_CONTAINS(world_error("AreaLightSource \"diffus\""), "did you mean \"diffuse\"?");
}

TEST_CASE("an interface does not emit, and that is said") {
  const SceneFile file = test::read_world_file("AreaLightSource \"diffuse\" Material \"interface\" Shape \"sphere\"");
  CHECK_FALSE(file.scene.shapes.at(0).emission);
  CHECK(file.warnings.size() == 1);
}

TEST_CASE("an emitter's alpha, which counts otherwise in pbrt, is warned of unless it is 0 or 1") {
  const auto warnings = [](const std::string& alpha) {
    return test::world_warnings("AreaLightSource \"diffuse\" Shape \"sphere\" \"float alpha\" " + alpha);
  };
  CHECK(warnings("0") == 0);
  CHECK(warnings("1") == 0);
  CHECK(warnings("0.5") == 1);
}

TEST_CASE("a constant sky behind a portal is warned of where pbrt weighs it otherwise") {
  const auto warnings = [](const std::string& light) { return test::world_warnings("LightSource \"infinite\" " + light); };
  const std::string portal = " \"point3 portal\" [0 0 0  1 0 0  1 1 0  0 1 0]";
  CHECK(warnings("\"float illuminance\" 3" + portal) == 1);
  CHECK(warnings("\"blackbody L\" 3000" + portal) == 1);
  CHECK(warnings("\"rgb L\" [1 1 1]" + portal) == 0);
  CHECK(warnings("\"float illuminance\" 3") == 0);
}

TEST_CASE("a scaled quadric's power, which pbrt scales too, is warned of") {
  const auto warnings = [](const std::string& transform, const std::string& shape) {
    return test::world_warnings(transform + " AreaLightSource \"diffuse\" \"float power\" 1 Shape " + shape);
  };
  CHECK(warnings("Scale 2 2 2", "\"sphere\"") == 1);
  CHECK(warnings("Rotate 30 1 2 3", "\"sphere\"") == 0);
  CHECK(warnings("Scale 2 2 2", "\"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]") == 0);
}

TEST_CASE("colours are read in the colour space in force") {
  const ColorSpace& aces = *find_color_space("aces2065-1");
  check_near(light<PointLight>("ColorSpace \"aces2065-1\" LightSource \"point\" \"rgb I\" [1 2 3]").I,
             transformed(aces.to_rec709, {1, 2, 3}));
  check_near(light<PointLight>("ColorSpace \"aces2065-1\" LightSource \"point\"").I, transformed(aces.to_rec709, Rgb(1.0f)));
  // The Attribute's parameters keep the space of their own place.
  check_near(light<PointLight>(
                 "ColorSpace \"aces2065-1\" Attribute \"light\" \"rgb I\" [1 2 3] ColorSpace \"srgb\" LightSource \"point\"")
                 .I,
             transformed(aces.to_rec709, {1, 2, 3}));
  const Scene s = read_world("ColorSpace \"aces2065-1\" Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]");
  check_near(test::constant(s, std::get<DiffuseMaterial>(s.materials[0].kind).reflectance), Rgb(.5f));
}

TEST_CASE("light errors") {
  CHECK_CONTAINS(world_error("LightSource \"pint\""), "did you mean \"point\"?");
  CHECK_CONTAINS(world_error("LightSource \"point\" \"rgb L\" [1 1 1]"), "light \"point\" has no parameter \"L\"");
  CHECK_CONTAINS(world_error("LightSource \"point\" \"spectrum I\" \"metal-Xx\""), "neither a named spectrum");
  CHECK_CONTAINS(world_error("LightSource \"point\" \"spectrum I\" [400 1 300 1]"), "wavelengths out of order");
  CHECK_CONTAINS(world_error("LightSource \"point\" \"spectrum I\" [400 1 500]"), "odd number of values");
  CHECK_CONTAINS(world_error("LightSource \"point\" \"blackbody I\" -3"), "no temperature");
}

TEST_CASE("spectra come from files too") {
  const test::TempFolder folder;
  folder.write("flat.spd", "# wavelength value\n300 2\n900 2\n");
  const Scene s =
      read_scene_text("WorldBegin MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"spectrum sigma_s\" \"flat.spd\"",
                      "test.pbrt", folder.path())
          .scene;
  check_near(s.media.at(0).optics.sigma_s, Rgb(2.0f));
}

TEST_CASE("light groups: at the light, and by the Attribute directive that pbrt takes too") {
  const Scene scene = read_world(
      "LightSource \"point\" \"string lightgroup\" \"key\"\n"
      "AttributeBegin Attribute \"light\" \"string lightgroup\" \"set\" Attribute \"medium\" \"string lightgroup\" \"fire\"\n"
      "LightSource \"infinite\" AreaLightSource \"diffuse\" Shape \"sphere\"\n"
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" AttributeEnd\n"
      "LightSource \"distant\" AreaLightSource \"diffuse\" \"string lightgroup\" \"lamp-1_b\" Shape \"sphere\"\n"
      "MakeNamedMedium \"n\" \"string type\" \"homogeneous\" \"string lightgroup\" \"n\"\n");
  CHECK(scene.lights.at(0).group == "key");
  CHECK(scene.lights.at(1).group == "set");
  CHECK(scene.lights.at(2).group.empty());
  CHECK(scene.shapes.at(0).emission->group == "set");
  CHECK(scene.shapes.at(1).emission->group == "lamp-1_b");
  CHECK(scene.media.at(0).group == "fire");
  CHECK(scene.media.at(1).group == "n");
  const std::vector<std::string> all_bad{"", "a.b", "a b", "k=1", "a,b", "\xc3\xa4", std::string(65, 'a')};
  for (const std::string& bad : all_bad) {
    CAPTURE(bad);
    CHECK_CONTAINS(world_error("LightSource \"point\" \"string lightgroup\" \"" + bad + "\""), "use 1 to 64 letters");
  }
  CHECK_CONTAINS(world_error("LightSource \"point\" \"float lightgroup\" 1"), "lightgroup");
}
