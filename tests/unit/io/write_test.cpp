#include <doctest/doctest.h>

#include <string>

#include "io/file_text.h"
#include "io/ply.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

TriangleMesh two_triangles() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1.5f, 0, 0}, {1, 1e-30f, 0}, {0, 1, -7.25f}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

TEST_CASE("a polygon file reads back as it was") {
  TriangleMesh mesh = two_triangles();
  const auto check = [&] {
    const PlyMesh read = read_ply_bytes(encode_ply(mesh), "memory");
    CHECK(read.positions == mesh.positions);
    CHECK(read.normals == mesh.normals);
    CHECK(read.triangles == mesh.indices);
    REQUIRE(read.uvs.size() == mesh.uvs.size());
    for (std::size_t i = 0; i < read.uvs.size(); ++i) CHECK((read.uvs[i].x == mesh.uvs[i].x && read.uvs[i].y == mesh.uvs[i].y));
  };
  check();
  mesh.normals.assign(4, {0, 0, 1});
  check();
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0.25f}};
  check();
  mesh.normals.clear();
  check();
}

TEST_CASE("a mesh that contradicts itself is not written") {
  CHECK_THROWS_AS(encode_ply({}), Error);
  TriangleMesh mesh = two_triangles();
  mesh.indices.back() = 4;
  CHECK_THROWS_AS(encode_ply(mesh), Error);
  mesh = two_triangles();
  mesh.indices.pop_back();
  CHECK_THROWS_AS(encode_ply(mesh), Error);
  mesh = two_triangles();
  mesh.normals.resize(3);
  CHECK_THROWS_AS(encode_ply(mesh), Error);
  mesh = two_triangles();
  mesh.uvs.resize(5);
  CHECK_THROWS_AS(encode_ply(mesh), Error);
}

TEST_CASE("bytes are written as they are, or not at all") {
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(bytes, "bytes.bin");
  CHECK(read_file_text("bytes.bin") == bytes);
  write_file("", "bytes.bin");
  CHECK(read_file_text("bytes.bin").empty());
  try {
    write_file(bytes, "no/such/folder/x");
    FAIL("written into a folder that is not there");
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::output);
  }
}

}  // namespace
}  // namespace tyndall
