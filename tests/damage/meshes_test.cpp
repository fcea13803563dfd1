/// Damaged polygon files: read, or refused in one line.
#include <doctest/doctest.h>

#include "io/ply.h"
#include "support/damage.h"
#include "support/scratch.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

TriangleMesh grid(int side) {
  TriangleMesh mesh;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) {
      mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0.5f * static_cast<float>(x * y)});
      mesh.normals.push_back({0, 0, 1});
      mesh.uvs.push_back({static_cast<float>(x), static_cast<float>(y)});
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (side + 1) + x), b = a + static_cast<std::uint32_t>(side) + 1;
      for (const std::uint32_t i : {a, a + 1, b, b, a + 1, b + 1}) mesh.indices.push_back(i);
    }
  return mesh;
}

std::string ascii(const TriangleMesh& mesh) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(mesh.indices.size() / 3) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : mesh.positions)
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    text += "3 " + std::to_string(mesh.indices[i]) + " " + std::to_string(mesh.indices[i + 1]) + " " +
            std::to_string(mesh.indices[i + 2]) + "\n";
  return text;
}

void read_mesh(const std::string& path) {
  const PlyMesh mesh = read_ply(path);
  for (const auto* indices : {&mesh.triangles, &mesh.quads})
    for (const std::uint32_t i : *indices)
      if (i >= mesh.positions.size()) throw std::runtime_error("an index out of range");
  for (const Vec3& p : mesh.positions)
    if (!is_finite(p)) throw std::runtime_error("a position that is not finite");
}

}  // namespace

TEST_CASE("damaged .ply files") {
  const Scratch folder;
  write_bytes(folder / "binary.ply", encode_ply(grid(6)));
  write_bytes(folder / "ascii.ply", ascii(grid(6)));
  read_mesh(folder / "binary.ply");
  read_mesh(folder / "ascii.ply");
  const Verdict binary = read_mutants({folder / "binary.ply"}, read_mesh);
  MESSAGE(binary.str());
  CHECK(binary.complaints.empty());
  CHECK(binary.accepted_truncations == 0);
  const Verdict text = read_mutants({folder / "ascii.ply"}, read_mesh, /*text=*/true);
  MESSAGE(text.str());
  CHECK(text.complaints.empty());
  CHECK(text.accepted_truncations <= text.cases / 100);  // a last number that has lost digits is a number
}
