#include <doctest/doctest.h>

#include "support/scratch.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

using namespace tyndall;

namespace {

std::string value(const Description& d, const std::string& subject, const std::string& name) {
  for (const Property& p : d.properties)
    if (p.subject == subject && p.name == name) return p.value;
  return "none";
}

}  // namespace

TEST_CASE("describe sums up a scene") {
  const test::Scratch folder;
  test::write_bytes(folder / "a.pbrt", R"(
Film "rgb" "integer xresolution" 20 "integer yresolution" 10 "string filename" "out.exr"
Sampler "independent" "integer pixelsamples" 32
Integrator "volpath" "integer maxdepth" 7
LookAt 1 2 3  1 2 4  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
LightSource "point" "rgb I" [1 1 1]
LightSource "infinite"
MakeNamedMedium "fog" "string type" "homogeneous"
AttributeBegin
  Translate 1 0 0
  Shape "sphere" "float radius" 2
AttributeEnd
ObjectBegin "quad"
  Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 1 1 0 0 1 0] "integer indices" [0 1 2 0 2 3]
ObjectEnd
Translate 0 0 9
ObjectInstance "quad"
ObjectInstance "quad"
AttributeBegin
  AreaLightSource "diffuse"
  Shape "disk"
AttributeEnd
)");
  const Description d = describe(folder / "a.pbrt");
  CHECK(d.kind == "pbrt-v4 scene");
  CHECK(value(d, "film", "size") == "20 x 10");
  CHECK(value(d, "camera", "kind") == "perspective");
  CHECK(value(d, "camera", "position") == "1 2 3");
  CHECK(value(d, "settings", "spp") == "32");
  CHECK(value(d, "settings", "max-depth") == "7");
  CHECK(value(d, "lights", "lights") == "2: 1 point, 1 infinite");
  CHECK(value(d, "lights", "emissive shapes") == "1");
  CHECK(value(d, "media", "media") == "1: 1 homogeneous");
  CHECK(value(d, "geometry", "shapes") == "2: 1 sphere, 1 disk");
  CHECK(value(d, "geometry", "instances") == "2 with 4 triangles");
  CHECK(value(d, "geometry", "bounds") == "(-1 -2 -2) to (3 2 9)");
}

TEST_CASE("a scene's description has a name for every kind of texture, its limits and its crop, and lights in objects") {
  const test::Scratch folder;
  write_file(R"(
Integrator "volpath" "float time" 3 "integer crop" [0 8 2 6]
Film "rgb" "integer xresolution" 20 "integer yresolution" 10
WorldBegin
Texture "a" "float" "constant"
Texture "b" "float" "scale"
Texture "c" "float" "mix"
Texture "d" "float" "checkerboard"
Texture "e" "float" "dots"
Texture "f" "float" "bilerp"
Texture "g" "float" "directionmix"
Texture "h" "float" "wrinkled"
Texture "i" "spectrum" "marble"
ObjectBegin "bulb"
  AreaLightSource "diffuse"
  Shape "sphere"
ObjectEnd
ObjectInstance "bulb"
ObjectInstance "bulb"
)",
             folder / "a.pbrt");
  const Description d = describe(folder / "a.pbrt");
  const std::string textures = value(d, "textures", "textures");
  for (const char* kind : {"scale", "mix", "checkerboard", "1 dots", "1 bilerp", "1 directionmix", "2 noise"})
    CHECK_MESSAGE(textures.find(kind) != std::string::npos, textures);
  CHECK(value(d, "settings", "time") == "3");
  CHECK(value(d, "settings", "spp") == "none");
  CHECK(value(d, "film", "crop") == "0,8,2,6");
  CHECK(value(d, "lights", "emissive shapes") == "2");
}

TEST_CASE("describe refuses what is missing or broken") {
  const test::Scratch folder;
  CHECK_THROWS_AS(describe(folder / "none.pbrt"), Error);
  CHECK_THROWS_AS(describe(folder / "none.vdb"), Error);
  CHECK_THROWS_AS(describe(folder / "none.png"), Error);
  test::write_bytes(folder / "bad.pbrt", "WorldBegin\nShap \"sphere\"\n");
  CHECK_THROWS_AS(describe(folder / "bad.pbrt"), Error);
}
