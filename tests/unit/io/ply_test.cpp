#include "io/ply.h"

#include <algorithm>
#include <cstring>

#include "unit/io/reader_checks.h"

using namespace tyndall;

namespace {

const std::string kHeader =
    "element vertex 4\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
    "element edge 1\nproperty int a\nproperty list uchar short b\n"
    "element face 2\nproperty uchar flag\nproperty list uint8 int vertex_index\nend_header\n";

/// Appends values in one byte order.
struct Bytes {
  bool swap;
  std::string out;
  template <typename T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (swap) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
    return *this;
  }
};

std::string binary(bool big) {
  Bytes b{big, "ply\ncomment made by a test\nformat binary_" + std::string(big ? "big" : "little") + "_endian 1.0\n" + kHeader};
  for (int i = 0; i < 4; ++i) {
    b.add(float(i)).add(double(2 * i)).add(float(-i)).add(std::uint8_t(255));
    b.add(0.0f).add(0.0f).add(1.0f).add(0.25f * i).add(0.5f);
  }
  b.add(7).add(std::uint8_t(2)).add(std::int16_t(1)).add(std::int16_t(2));
  b.add(std::uint8_t(1)).add(std::uint8_t(3)).add(0).add(1).add(2);
  b.add(std::uint8_t(1)).add(std::uint8_t(4)).add(0).add(1).add(2).add(3);
  return b.out;
}

std::string ascii() {
  std::string text = "ply\r\nformat ascii 1.0\n" + kHeader;
  for (int i = 0; i < 4; ++i)
    text += std::to_string(i) + " " + std::to_string(2 * i) + " " + std::to_string(-i) + " 255 0 0 1 " +
            std::to_string(0.25 * i) + " 0.5\n";
  return text + "7 2 1 2\n1 3 0 1 2\n1 4 0 1 2 3\n";
}

std::string error_of(const std::string& bytes) {
  return test::message_of([&] { read_ply_bytes(bytes, "a.ply"); });
}

std::string triangle(const std::string& vertices, const std::string& face, const std::string& counts = "3 1") {
  const std::size_t blank = counts.find(' ');
  return "ply\nformat ascii 1.0\nelement vertex " + counts.substr(0, blank) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + counts.substr(blank + 1) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + face;
}

}  // namespace

TEST_CASE("ascii and both byte orders hold the same mesh") {
  for (const std::string& bytes : {ascii(), binary(false), binary(true)}) {
    const PlyMesh m = read_ply_bytes(bytes, "a.ply");
    REQUIRE(m.positions.size() == 4);
    CHECK(m.positions[3] == Vec3{3, 6, -3});
    CHECK(m.normals.at(2) == Vec3{0, 0, 1});
    CHECK(m.uvs.at(3).x == 0.75f);
    CHECK(m.triangles == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(m.quads == std::vector<std::uint32_t>{0, 1, 3, 2});
  }
}

TEST_CASE("every truncation is refused") {
  for (const std::string& whole : {ascii(), binary(false)})
    for (std::size_t cut = 0; cut + 2 < whole.size(); ++cut) CHECK_MESSAGE(error_of(whole.substr(0, cut)) != "no error", cut);
}

TEST_CASE("every damaged byte gives a mesh in range or an error") {
  const std::string whole = binary(false);
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int flip : {1, 128, 255}) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(bytes[i] ^ flip);
      try {
        const PlyMesh m = read_ply_bytes(bytes, "a.ply");
        for (const std::uint32_t k : m.triangles) CHECK(k < m.positions.size());
        for (const std::uint32_t k : m.quads) CHECK(k < m.positions.size());
      } catch (const Error&) {
      }
    }
}

TEST_CASE("what is wrong is said") {
  const std::string good = "0 0 0\n1 0 0\n0 1 0\n";
  CHECK(error_of(triangle(good, "3 0 1 2\n")) == "no error");
  CHECK_CONTAINS(error_of(triangle(good, "3 0 1 3\n")), "face 0 has index 3 out of range; the file has 3 vertices");
  CHECK_CONTAINS(error_of(triangle(good, "3 0 -1 2\n")), "index -1 out of range");
  CHECK_CONTAINS(error_of(triangle(good, "5 0 1 2 0 1\n")), "face 0 has 5 corners");
  CHECK_CONTAINS(error_of(triangle(good, "2 0 1\n")), "triangulate the mesh");
  CHECK_CONTAINS(error_of(triangle("0 0 0\nnan 0 0\n0 1 0\n", "3 0 1 2\n")), "in vertex 1 of 3");
  CHECK_CONTAINS(error_of(triangle("0 0 0\n1e39 0 0\n0 1 0\n", "3 0 1 2\n")), "vertex 1 has a NaN or infinite value");
  CHECK_CONTAINS(error_of(triangle(good, "3 0 1 2\n", "4000000000 1")), "more than the file can hold");
  CHECK_CONTAINS(error_of(triangle(good, "3 0 1 2\n", "3 18446744073709551615")), "more than the file can hold");
  CHECK_CONTAINS(error_of(triangle(good, "", "3 0")), "has no faces");
  CHECK_CONTAINS(error_of("ply\nformat ascii 1.0\nelement vertex 99999999999999999999\nend_header\n"),
                 "a.ply:3:1: element line");
  CHECK_CONTAINS(error_of("ply\nformat binary 1.0\nend_header\n"), "a.ply:2:1: format is unknown");
  CHECK_CONTAINS(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty vec3 x\nend_header\n"),
                 "property type is unknown");
  CHECK_CONTAINS(error_of("ply\nformat ascii 1.0\nnonsense\nend_header\n"), "not understood");
  CHECK_CONTAINS(error_of("ply\nformat ascii 1.0\n"), "header ends too early");
}

TEST_CASE("binary NaN and infinity are refused") {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity}) {
    Bytes b{false,
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"};
    for (int i = 0; i < 3; ++i) b.add(float(i)).add(i == 2 ? bad : 1.0f).add(0.0f);
    b.add(std::uint8_t(3)).add(0).add(1).add(2);
    CHECK_CONTAINS(error_of(b.out), "vertex 2 has a NaN or infinite value");
  }
}

TEST_CASE("normals that are NaN are left out, and counted") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto mesh = [&](int broken) {
    Bytes b{false,
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"};
    for (int i = 0; i < 3; ++i) b.add(float(i)).add(float(i * i)).add(0.0f).add(0.0f).add(i < broken ? nan : 0.0f).add(1.0f);
    b.add(std::uint8_t(3)).add(0).add(1).add(2);
    return read_ply_bytes(b.out, "a.ply");
  };
  CHECK(mesh(0).broken_normals == 0);
  CHECK(mesh(2).broken_normals == 2);
  CHECK(mesh(2).normals == std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}});
  CHECK(mesh(3).normals.empty());
}
