#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::read_world;
using test::world_error;

namespace {

template <typename Kind>
Kind shape(const std::string& text) {
  return std::get<Kind>(read_world("Shape " + text).shapes.at(0).kind);
}

}  // namespace

TEST_CASE("sphere, disk, cylinder") {
  const auto s = shape<Sphere>("\"sphere\" \"float radius\" 2 \"float zmin\" 3 \"float zmax\" -1 \"float phimax\" 90");
  CHECK(s.radius == 2);
  CHECK(s.z_min == -1);
  CHECK(s.z_max == 2);
  CHECK(s.phi_max_degrees == 90);
  CHECK(shape<Sphere>("\"sphere\" \"float radius\" 3").z_min == -3);
  const auto d = shape<Disk>("\"disk\" \"float height\" 1 \"float radius\" 2 \"float innerradius\" .5 \"float phimax\" 900");
  CHECK(d.height == 1);
  CHECK(d.inner_radius == .5f);
  CHECK(d.phi_max_degrees == 360);
  const auto c = shape<Cylinder>("\"cylinder\" \"float zmin\" 2 \"float zmax\" 1");
  CHECK(c.z_min == 1);
  CHECK(c.z_max == 2);
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" 0"), "radius must be above 0");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float zmin\" 5 \"float zmax\" 6"), "cut away entirely");
  CHECK_CONTAINS(world_error("Shape \"disk\" \"float innerradius\" 1"), "below radius");
  CHECK_CONTAINS(world_error("Shape \"cylinder\" \"float zmin\" 1"), "no height");
}

TEST_CASE("trianglemesh") {
  const auto m = shape<TriangleMesh>(R"("trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 0] "integer indices" [0 1 2 2 1 3]
    "normal N" [0 0 1 0 0 1 0 0 1 0 0 1] "point2 uv" [0 0 1 0 0 1 1 1])");
  CHECK(m.positions.at(3) == Vec3{1, 1, 0});
  CHECK(m.indices == std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3});
  CHECK(m.normals.size() == 4);
  CHECK(m.uvs.at(1).x == 1);
  CHECK(shape<TriangleMesh>("\"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]").indices ==
        std::vector<std::uint32_t>{0, 1, 2});
  const std::string four = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] ";
  CHECK_CONTAINS(world_error(four), "has no indices");
  CHECK_CONTAINS(world_error(four + "\"integer indices\" [0 1]"), "no multiple of 3");
  CHECK_CONTAINS(world_error(four + "\"integer indices\" [0 1 4]"), "index 4 (the 3. of the list) is out of range");
  CHECK_CONTAINS(world_error(four + "\"integer indices\" [0 -1 2]"), "index -1 (the 2. of the list)");
  CHECK_CONTAINS(world_error(four + "\"integer indices\" [0 1 2] \"point2 uv\" [0 0]"), "\"uv\" has 1 values for 4 vertices");
  CHECK_CONTAINS(world_error("Shape \"trianglemesh\""), "has no vertices");
}

TEST_CASE("bilinearmesh") {
  const auto m = shape<BilinearMesh>("\"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]");
  CHECK(m.indices == std::vector<std::uint32_t>{0, 1, 2, 3});
}

TEST_CASE("plymesh: triangles and quadrilaterals become two shapes of one boundary") {
  const test::TempFolder folder;
  folder.write("a.ply",
               "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 2\n3 0 1 4\n4 0 1 2 3\n");
  const Scene s = read_scene_text(R"(WorldBegin MakeNamedMedium "m" "string type" "homogeneous" MediumInterface "m" ""
    Shape "plymesh" "string filename" "a.ply")",
                                  "test.pbrt", folder.path())
                      .scene;
  REQUIRE(s.shapes.size() == 2);
  CHECK(std::get<TriangleMesh>(s.shapes[0].kind).indices == std::vector<std::uint32_t>{0, 1, 4});
  CHECK(std::get<BilinearMesh>(s.shapes[1].kind).indices == std::vector<std::uint32_t>{0, 1, 3, 2});
  CHECK(std::get<BilinearMesh>(s.shapes[1].kind).positions.size() == 5);
  CHECK(s.shapes[0].boundary == s.shapes[1].boundary);
  folder.write("bad.ply", "plx\n");
  CHECK_CONTAINS(test::message_of([&] {
                   read_scene_text("WorldBegin Shape \"plymesh\" \"string filename\" \"bad.ply\"", "test.pbrt", folder.path());
                 }),
                 "bad.ply:1:1: is no ply file");
  CHECK_CONTAINS(world_error("Shape \"plymesh\" \"string filename\" \"absent.ply\""),
                 "test.pbrt:1:28: file \"absent.ply\" does not exist");
}

TEST_CASE("alpha: a constant below 1 or a texture; 1 is none") {
  CHECK_FALSE(read_world("Shape \"sphere\" \"float alpha\" 1").shapes.at(0).alpha);
  const Scene s = read_world(
      "Shape \"sphere\" \"float alpha\" .25 Texture \"a\" \"float\" \"checkerboard\" Shape \"sphere\" \"texture alpha\" \"a\"");
  CHECK(test::constant(s, *s.shapes.at(0).alpha) == Rgb(.25f));
  CHECK(std::holds_alternative<CheckerboardTexture>(s.textures.at(*s.shapes.at(1).alpha).kind));
}

TEST_CASE("shapes know where they stand") {
  const Scene s = test::read("WorldBegin\n\n  Shape \"sphere\"");
  CHECK(s.shapes.at(0).where.str() == "test.pbrt:3:3");
  CHECK_CONTAINS(world_error("Shape \"curve\""), "not supported by Tyndall; convert it to a plymesh");
  CHECK_CONTAINS(world_error("Shape \"torus\""), "shape \"torus\" is unknown");
}
