#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::read_world;
using test::world_error;

namespace {

template <typename Kind>
Kind last_texture(const Scene& scene) {
  return std::get<Kind>(scene.textures.back().kind);
}

}  // namespace

TEST_CASE("constants of one value are one texture") {
  const Scene s = read_world(R"(Material "diffuse" "rgb reflectance" [.1 .1 .1] Material "dielectric" "float roughness" .1
    Texture "c" "float" "constant" "float value" .1 Texture "d" "spectrum" "constant" "rgb value" [.1 .1 .1])");
  int equal = 0;
  for (const Texture& t : s.textures)
    if (const auto* c = std::get_if<ConstantTexture>(&t.kind)) equal += c->value == Rgb(.1f);
  CHECK(equal == 1);
}

TEST_CASE("scale and mix of constants and textures") {
  const Scene s = read_world(R"(Texture "a" "spectrum" "constant" "rgb value" [.2 .4 .6]
    Texture "f" "float" "constant" "float value" .3
    Texture "m" "spectrum" "mix" "texture tex1" "a" "rgb tex2" [1 0 0] "texture amount" "f"
    Texture "s" "spectrum" "scale" "texture tex" "m" "float scale" .5)");
  const auto scale = last_texture<ScaleTexture>(s);
  CHECK(test::constant(s, scale.scale) == Rgb(.5f));
  const auto mix = std::get<MixTexture>(s.textures.at(scale.texture).kind);
  CHECK(test::constant(s, mix.first) == Rgb(.2f, .4f, .6f));
  CHECK(test::constant(s, mix.second) == Rgb(1, 0, 0));
  CHECK(test::constant(s, mix.amount) == Rgb(.3f));
  const auto plain = last_texture<MixTexture>(read_world("Texture \"m\" \"float\" \"mix\""));
  CHECK(plain.first != plain.second);
}

TEST_CASE("checkerboard and mappings") {
  const Scene s =
      read_world(R"(Translate 1 2 3 Texture "c" "spectrum" "checkerboard" "integer dimension" 3 "rgb tex1" [.1 .1 .1]
    "string mapping" "planar" "vector3 v1" [1 2 3] "vector3 v2" [4 5 6] "float udelta" 7 "float vscale" 8)");
  const auto c = last_texture<CheckerboardTexture>(s);
  CHECK(c.dimension == 3);
  CHECK(test::constant(s, c.first) == Rgb(.1f));
  CHECK(test::constant(s, c.second) == Rgb(0.0f));
  CHECK(c.mapping.kind == TextureMapping::Kind::planar);
  CHECK(c.mapping.v1 == Vec3{1, 2, 3});
  CHECK(c.mapping.v2 == Vec3{4, 5, 6});
  CHECK(c.mapping.offset.x == 7);
  CHECK(c.mapping.scale.y == 8);
  CHECK(c.mapping.to_texture.point({1, 2, 3}) == Vec3{0, 0, 0});
  CHECK_CONTAINS(world_error("Texture \"c\" \"float\" \"checkerboard\" \"integer dimension\" 4"), "dimension 2 or 3");
  CHECK_CONTAINS(world_error("Texture \"c\" \"float\" \"checkerboard\" \"string mapping\" \"cubic\""),
                 "\"cubic\" is no mapping");
}

TEST_CASE("imagemap") {
  const test::TempFolder folder;
  folder.write("tex/a.png", "not read here");
  const SceneFile file =
      read_scene_text(R"(WorldBegin Texture "i" "spectrum" "imagemap" "string filename" "tex/a.png" "string wrap" "clamp"
    "string filter" "trilinear" "float scale" 2 "bool invert" true "string encoding" "gamma 2.2" "float maxanisotropy" 4)",
                      "test.pbrt", folder.path());
  const auto t = last_texture<ImageTexture>(file.scene);
  CHECK(t.path == folder.path() + "/tex/a.png");
  CHECK(t.wrap == ImageTexture::Wrap::clamp);
  CHECK(t.filter == ImageTexture::Filter::trilinear);
  CHECK(t.max_anisotropy == 4);
  CHECK(t.scale == 2);
  CHECK(t.invert);
  CHECK(t.encoding == "gamma 2.2");
  CHECK(file.warnings.size() == 1);  // nothing uses the texture
  const auto filter = [&](const std::string& parameters) {
    const std::string text = "WorldBegin Texture \"i\" \"spectrum\" \"imagemap\" \"string filename\" \"tex/a.png\" ";
    return last_texture<ImageTexture>(read_scene_text(text + parameters, "test.pbrt", folder.path()).scene).filter;
  };
  CHECK(filter("") == ImageTexture::Filter::bilinear);
  CHECK(filter("\"string filter\" \"point\"") == ImageTexture::Filter::point);
  CHECK(filter("\"string filter\" \"EWA\"") == ImageTexture::Filter::elliptical);
  CHECK(filter("\"string filter\" \"ewa\"") == ImageTexture::Filter::elliptical);
  CHECK_THROWS_WITH_AS(filter("\"float maxanisotropy\" 0"), doctest::Contains("maxanisotropy must be from 1"), Error);
  const auto warnings = [&](const std::string& image) {
    folder.write("tex/a.tga", "");
    return read_scene_text("WorldBegin Texture \"i\" \"float\" \"imagemap\" \"string filename\" " + image, "test.pbrt",
                           folder.path())
        .warnings.size();
  };
  CHECK(warnings("\"tex/a.png\" \"string encoding\" \"linear\"") == 1);  // it feeds nothing
  CHECK(warnings("\"tex/a.tga\" \"string encoding\" \"linear\"") == 2);  // and pbrt-v4 takes it for sRGB
  CHECK(warnings("\"tex/a.tga\" \"string encoding\" \"sRGB\"") == 1);
  CHECK_CONTAINS(world_error("Texture \"i\" \"float\" \"imagemap\" \"string filename\" \"absent.png\""),
                 "test.pbrt:1:43: file \"absent.png\" does not exist");
  CHECK_CONTAINS(world_error("Texture \"i\" \"float\" \"imagemap\""), "file name is empty");
}

TEST_CASE("textures are looked up by kind, and must stand before") {
  CHECK_CONTAINS(world_error("Material \"diffuse\" \"texture reflectance\" \"w\""),
                 "spectrum texture \"w\" is not defined; define it with Texture before line 1");
  CHECK_CONTAINS(world_error("Texture \"f\" \"float\" \"constant\" Material \"diffuse\" \"texture reflectance\" \"f\""),
                 "texture \"f\" is a float texture, and \"reflectance\" takes a spectrum texture");
  CHECK_CONTAINS(world_error("Texture \"f\" \"float\" \"scale\" \"texture tex\" \"f\""), "is not defined");
  CHECK_CONTAINS(world_error("Texture \"f\" \"float\" \"constant\" Texture \"f\" \"float\" \"constant\""), "defined twice");
  CHECK_CONTAINS(world_error("Texture \"f\" \"color\" \"constant\""), "use \"float\" or \"spectrum\"");
  CHECK_CONTAINS(world_error("Texture \"f\" \"float\" \"ptex\""), "\"ptex\" is not supported by Tyndall; bake it");
  CHECK_CONTAINS(world_error("Texture \"f\" \"float\" \"scales\""), "did you mean \"scale\"?");
  CHECK(world_error("Texture \"f\" \"float\" \"constant\" Texture \"f\" \"spectrum\" \"constant\"") == "no error");
}

TEST_CASE("textures that feed nothing are named in one warning") {
  const SceneFile file = test::read_world_file(
      "Texture \"a\" \"float\" \"constant\" \nTexture \"b\" \"float\" \"scale\" \"texture tex\" \"a\" "
      "Texture \"b\" \"spectrum\" \"constant\" Texture \"c\" \"spectrum\" \"constant\" "
      "Material \"diffuse\" \"texture reflectance\" \"c\"");
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0].where.line == 2);
  CHECK_CONTAINS(file.warnings[0].message, "2 textures feed nothing: \"b\", \"b\"");
  CHECK(
      test::read_world_file("Texture \"a\" \"float\" \"constant\" Shape \"sphere\" \"texture alpha\" \"a\"").warnings.empty());
}

TEST_CASE("dots, whose inside and outside pbrt exchanges, bilerp and directionmix") {
  const Scene s =
      read_world("Texture \"d\" \"float\" \"dots\" \"float inside\" 0.25 \"float outside\" 0.75 \"float uscale\" 3");
  const auto d = last_texture<DotsTexture>(s);
  CHECK(test::constant(s, d.inside) == Rgb(0.75f));
  CHECK(test::constant(s, d.outside) == Rgb(0.25f));
  CHECK(d.mapping.scale.x == 3);
  const auto b = last_texture<BilerpTexture>(read_world("Texture \"b\" \"spectrum\" \"bilerp\" \"rgb v10\" [.1 .2 .3]"));
  CHECK(b.v00 == Rgb(0.0f));
  CHECK(b.v01 == Rgb(1.0f));
  CHECK(b.v10 == Rgb(.1f, .2f, .3f));
  CHECK(b.v11 == Rgb(1.0f));
  CHECK(last_texture<BilerpTexture>(read_world("Texture \"b\" \"float\" \"bilerp\" \"float v00\" .5")).v00 == Rgb(.5f));
  const Scene m = read_world("Rotate 90 0 0 1 Scale 2 2 2 Texture \"m\" \"float\" \"directionmix\" \"vector3 dir\" [1 0 0]");
  const auto mix = last_texture<DirectionMixTexture>(m);
  CHECK(mix.direction.y == doctest::Approx(1));
  CHECK(test::constant(m, mix.first) == Rgb(0.0f));
  CHECK(test::constant(m, mix.second) == Rgb(1.0f));
  CHECK_CONTAINS(world_error("Texture \"m\" \"float\" \"directionmix\" \"vector3 dir\" [0 0 0]"), "dir is 0 0 0");
}

TEST_CASE("noise textures") {
  const auto fbm = last_texture<NoiseTexture>(
      read_world("Translate 1 2 3 Texture \"n\" \"float\" \"fbm\" \"integer octaves\" 3 \"float roughness\" .7"));
  CHECK(fbm.kind == NoiseTexture::Kind::fbm);
  CHECK(fbm.octaves == 3);
  CHECK(fbm.roughness == .7f);
  CHECK(fbm.to_texture.point({1, 2, 3}) == Vec3{0, 0, 0});
  const auto marble =
      last_texture<NoiseTexture>(read_world("Texture \"n\" \"spectrum\" \"marble\" \"float scale\" 5 \"float variation\" 1"));
  CHECK(marble.kind == NoiseTexture::Kind::marble);
  CHECK(marble.octaves == 8);
  CHECK(marble.scale == 5);
  CHECK(marble.variation == 1);
  CHECK(last_texture<NoiseTexture>(read_world("Texture \"n\" \"float\" \"windy\"")).kind == NoiseTexture::Kind::windy);
  CHECK_CONTAINS(world_error("Texture \"n\" \"float\" \"windy\" \"integer octaves\" 3"), "has no parameter \"octaves\"");
  CHECK_CONTAINS(world_error("Texture \"n\" \"float\" \"wrinkled\" \"integer octaves\" -1"), "octaves must be from 0 to 64");
  CHECK_CONTAINS(world_error("Texture \"n\" \"spectrum\" \"fbm\""), "\"fbm\" is a float texture");
  CHECK_CONTAINS(world_error("Texture \"n\" \"float\" \"marble\""), "\"marble\" is a spectrum texture");
}
