#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::constant;
using test::read_world;
using test::world_error;

namespace {

template <typename Kind>
Kind last(const Scene& scene) {
  return std::get<Kind>(test::last_material(scene).kind);
}

}  // namespace

TEST_CASE("diffuse, its default and its sharing") {
  const Scene s = read_world(
      "Material \"diffuse\" Shape \"sphere\" Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3] Shape \"sphere\""
      "Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3] Shape \"sphere\"");
  CHECK(s.materials.size() == 2);
  CHECK(s.shapes.at(0).material == 0);
  CHECK(s.shapes.at(1).material == s.shapes.at(2).material);
  CHECK(constant(s, std::get<DiffuseMaterial>(s.materials[0].kind).reflectance) == Rgb(0.5f));
  CHECK(constant(s, last<DiffuseMaterial>(s).reflectance) == Rgb(.1f, .2f, .3f));
}

TEST_CASE("conductor by reflectance, by index and by default") {
  Scene s = read_world(
      "Material \"conductor\" \"rgb reflectance\" [.8 .7 .6] \"float roughness\" .1 \"float vroughness\" .2 \"bool "
      "remaproughness\" false");
  auto m = last<ConductorMaterial>(s);
  CHECK(constant(s, *m.optics.reflectance) == Rgb(.8f, .7f, .6f));
  CHECK(constant(s, m.roughness.u) == Rgb(.1f));
  CHECK(constant(s, m.roughness.v) == Rgb(.2f));
  CHECK_FALSE(m.roughness.remap);
  s = read_world("Material \"conductor\" \"rgb eta\" [.2 .3 1.1] \"rgb k\" [3 2 4]");
  m = last<ConductorMaterial>(s);
  CHECK_FALSE(m.optics.reflectance);
  CHECK(constant(s, m.optics.eta) == Rgb(.2f, .3f, 1.1f));
  CHECK(constant(s, m.optics.k) == Rgb(3, 2, 4));
  s = read_world("Material \"conductor\"");
  const Scene named = read_world("Material \"conductor\" \"spectrum eta\" \"metal-Cu-eta\" \"spectrum k\" \"metal-Cu-k\"");
  const Rgb eta = constant(s, last<ConductorMaterial>(s).optics.eta);
  CHECK(eta == constant(named, last<ConductorMaterial>(named).optics.eta));
  CHECK(eta.b > eta.r);  // copper is red
  CHECK_CONTAINS(world_error("Material \"conductor\" \"rgb reflectance\" [.5 .5 .5] \"rgb k\" [1 1 1]"), "not both");
}

TEST_CASE("dielectrics") {
  Scene s = read_world("Material \"dielectric\" \"float eta\" 1.33 \"float roughness\" .3");
  CHECK(last<DielectricMaterial>(s).eta == 1.33f);
  CHECK(constant(s, last<DielectricMaterial>(s).roughness.u) == Rgb(.3f));
  CHECK(last<DielectricMaterial>(s).roughness.remap);
  CHECK(last<DielectricMaterial>(read_world("Material \"dielectric\"")).eta == 1.5f);
  CHECK(last<ThinDielectricMaterial>(read_world("Material \"thindielectric\" \"float eta\" 2")).eta == 2);
  const SceneFile glass = test::read_world_file("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"");
  CHECK(last<DielectricMaterial>(glass.scene).eta == doctest::Approx(1.518).epsilon(0.003));
  REQUIRE(glass.warnings.size() == 1);
  CHECK_CONTAINS(glass.warnings[0].message, "red, green and blue are refracted each in one direction");
  CHECK_CONTAINS(world_error("Material \"dielectric\" \"float eta\" 0"), "no index of refraction");
  CHECK_CONTAINS(world_error("Material \"dielectric\" \"rgb eta\" [1 1 1]"), "is a float or spectrum, not a rgb");
}

TEST_CASE("coated materials have pbrt's defaults and names") {
  Scene s = read_world("Material \"coateddiffuse\"");
  const auto d = last<CoatedDiffuseMaterial>(s);
  CHECK(constant(s, d.reflectance) == Rgb(.5f));
  CHECK(constant(s, d.coating.roughness.u) == Rgb(0.0f));
  CHECK(constant(s, d.coating.thickness) == Rgb(.01f));
  CHECK(d.coating.eta == 1.5f);
  CHECK(constant(s, d.coating.g) == Rgb(0.0f));
  CHECK(constant(s, d.coating.albedo) == Rgb(0.0f));
  CHECK(d.coating.max_depth == 10);
  CHECK(d.coating.samples == 1);
  s = read_world(
      R"(Material "coatedconductor" "float interface.roughness" .1 "float conductor.uroughness" .2 "float interface.eta" 1.4
    "rgb reflectance" [.9 .9 .9] "float thickness" .5 "float g" .3 "rgb albedo" [.4 .4 .4] "integer maxdepth" 7 "integer nsamples" 2)");
  const auto c = last<CoatedConductorMaterial>(s);
  CHECK(constant(s, c.coating.roughness.v) == Rgb(.1f));
  CHECK(constant(s, c.conductor_roughness.u) == Rgb(.2f));
  CHECK(constant(s, c.conductor_roughness.v) == Rgb(0.0f));
  CHECK(constant(s, *c.optics.reflectance) == Rgb(.9f));
  CHECK(c.coating.eta == 1.4f);
  CHECK(c.coating.max_depth == 7);
  CHECK(c.coating.samples == 2);
  CHECK_CONTAINS(world_error("Material \"coatedconductor\" \"float roughness\" .1"), "did you mean");
}

TEST_CASE("numbers that a material cannot have are taken for the nearest, and that is said") {
  const auto warnings = [](const std::string& material) { return test::world_warnings("Material " + material); };
  CHECK(warnings("\"conductor\" \"float roughness\" -0.1") == 1);
  CHECK(warnings("\"dielectric\" \"float uroughness\" -0.1 \"float vroughness\" -2") == 2);
  CHECK(warnings("\"coateddiffuse\" \"float thickness\" -1") == 1);
  CHECK(warnings("\"coateddiffuse\" \"float g\" 1.5") == 1);
  CHECK(warnings("\"coateddiffuse\" \"float roughness\" 2 \"float thickness\" 3 \"float g\" -1") == 0);
  const std::string two = "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" ",
                    mix = two + "Material \"mix\" \"string materials\" [\"a\" \"a\"] \"float amount\" ";
  CHECK(test::world_warnings(mix + "1") == 0);
  CHECK(test::world_warnings(mix + "1.5") == 1);
}

TEST_CASE("diffusetransmission and interface") {
  const Scene s = read_world("Material \"diffusetransmission\" \"rgb transmittance\" [.1 .2 .3] \"float scale\" 2");
  CHECK(constant(s, last<DiffuseTransmissionMaterial>(s).reflectance) == Rgb(.25f));
  CHECK(constant(s, last<DiffuseTransmissionMaterial>(s).transmittance) == Rgb(.1f, .2f, .3f));
  CHECK(last<DiffuseTransmissionMaterial>(s).scale == 2);
  for (const char* name : {"interface", "none", ""})
    CHECK(std::holds_alternative<InterfaceMaterial>(
        test::last_material(read_world("Material \"" + std::string(name) + "\"")).kind));
}

TEST_CASE("named materials and their mix") {
  const Scene s = read_world(R"(MakeNamedMaterial "a" "string type" "diffuse" MakeNamedMaterial "b" "string type" "dielectric"
    MakeNamedMaterial "c" "string type" "mix" "string materials" ["a" "b"] "float amount" .3
    NamedMaterial "c" Shape "sphere" NamedMaterial "a" Shape "sphere")");
  CHECK(s.materials.at(s.shapes.at(0).material).name == "c");
  CHECK(s.materials.at(s.shapes.at(1).material).name == "a");
  const auto mix = last<MixMaterial>(s);
  CHECK(s.materials.at(mix.first).name == "a");
  CHECK(s.materials.at(mix.second).name == "b");
  CHECK(constant(s, mix.amount) == Rgb(.3f));
}

TEST_CASE("material errors") {
  CHECK_CONTAINS(world_error("NamedMaterial \"a\""),
                 "test.pbrt:1:26: material \"a\" is not defined; define it with MakeNamedMaterial before line 1");
  CHECK_CONTAINS(world_error("MakeNamedMaterial \"gold\" \"string type\" \"diffuse\" NamedMaterial \"golt\""),
                 "did you mean \"gold\"?");
  CHECK_CONTAINS(world_error("MakeNamedMaterial \"a\""), "has no type");
  CHECK_CONTAINS(
      world_error("MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"a\" \"string type\" \"diffuse\""),
      "defined twice");
  CHECK_CONTAINS(world_error("Material \"mix\" \"string materials\" [\"a\"]"), "takes two names");
  CHECK_CONTAINS(world_error("Material \"mix\" \"string materials\" [\"a\" \"b\"]"), "material \"a\" is not defined");
  CHECK_CONTAINS(world_error("Material \"hair\""), "not supported by Tyndall");
  CHECK_CONTAINS(world_error("Material \"difuse\""), "did you mean \"diffuse\"?");
  CHECK_CONTAINS(world_error("Material \"diffuse\" \"rgb reflectance\" [1.5 0 0]"), "component above 1");
  CHECK_CONTAINS(world_error("Material \"diffuse\" \"rgb reflectance\" [-1 0 0]"), "negative component");
  CHECK_CONTAINS(world_error("Material \"diffuse\" \"rgb reflectance\" [1 1 1 1 1 1]"), "more than one colour");
}

TEST_CASE("displacement and normal maps") {
  const test::TempFolder folder;
  folder.write("a.png", "not read here");
  const auto file = [&](const std::string& body) { return read_scene_text("WorldBegin " + body, "test.pbrt", folder.path()); };
  const std::string fbm = "Texture \"h\" \"float\" \"fbm\" ", diffuse = "Material \"diffuse\" ",
                    bumps = "\"texture displacement\" \"h\" ", map = "\"string normalmap\" \"a.png\" ";
  const Scene bumpy = file(fbm + diffuse + bumps + diffuse).scene;
  REQUIRE(bumpy.materials.size() == 2);  // the default, which the last one shares, and the bumpy one
  REQUIRE(test::last_material(bumpy).displacement.has_value());
  CHECK(std::holds_alternative<NoiseTexture>(bumpy.textures.at(*test::last_material(bumpy).displacement).kind));

  const Scene mapped = file(diffuse + map + "Material \"conductor\" " + map).scene;
  REQUIRE(test::last_material(mapped).normal_map.has_value());
  CHECK(mapped.materials.at(1).normal_map == test::last_material(mapped).normal_map);
  const auto image = std::get<ImageTexture>(mapped.textures.at(*test::last_material(mapped).normal_map).kind);
  CHECK(image.is_data);
  CHECK(image.encoding == "linear");

  CHECK(file(diffuse + map).warnings.empty());
  folder.write("a.JPG", "not read here");  // pbrt-v4 takes it for sRGB
  CHECK(file(diffuse + "\"string normalmap\" \"a.JPG\"").warnings.size() == 1);

  const SceneFile both = file(fbm + diffuse + bumps + map);
  CHECK_FALSE(test::last_material(both.scene).displacement.has_value());
  REQUIRE(both.warnings.size() == 1);
  CHECK_CONTAINS(both.warnings[0].message,
                 "\"displacement\" of material \"diffuse\" is ignored: the material has a normal map");
  CHECK_FALSE(
      test::last_material(file(diffuse + "\"float displacement\" 0.1").scene).displacement.has_value());  // moves nothing
  CHECK_CONTAINS(world_error("Material \"diffuse\" \"string normalmap\" \"absent.png\""), "does not exist");
}

TEST_CASE("dispersion: dielectrics take an index for each channel, coats their mean") {
  const SceneFile glass = test::read_world_file("Material \"dielectric\" \"spectrum eta\" \"glass-F11\"");
  const auto m = last<DielectricMaterial>(glass.scene);
  REQUIRE(m.eta_rgb.has_value());
  CHECK(m.eta_rgb->r < m.eta_rgb->g);
  CHECK(m.eta_rgb->g < m.eta_rgb->b);
  CHECK(m.eta == doctest::Approx(luminance(*m.eta_rgb)));
  const auto constant_index =
      last<DielectricMaterial>(read_world("Material \"dielectric\" \"spectrum eta\" [400 1.4 700 1.4]"));
  CHECK_FALSE(constant_index.eta_rgb.has_value());
  const SceneFile coat = test::read_world_file("Material \"coateddiffuse\" \"spectrum eta\" \"glass-F11\"");
  REQUIRE(coat.warnings.size() == 1);
  CHECK_CONTAINS(coat.warnings[0].message, "without dispersion");
}
