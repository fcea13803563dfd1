#include <bit>
#include <cstring>

#include "tyndall/io.h"

namespace tyndall {
namespace {

/// Numbers of the machine's own byte order, which the header states.
class Bytes {
 public:
  template <typename T>
  void put(const T& value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  void put(std::string_view text) { bytes_ += text; }
  void reserve(std::size_t size) { bytes_.reserve(size); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

std::string header_of(const TriangleMesh& mesh) {
  std::string text = "ply\nformat binary_";
  text += std::endian::native == std::endian::little ? "little" : "big";
  text += "_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) + "\n";
  const auto properties = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) text += std::string("property float ") + name + "\n";
  };
  properties({"x", "y", "z"});
  if (!mesh.normals.empty()) properties({"nx", "ny", "nz"});
  if (!mesh.uvs.empty()) properties({"u", "v"});
  return text + "element face " + std::to_string(mesh.indices.size() / 3) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

void require_whole(const TriangleMesh& mesh) {
  const auto fail = [](const std::string& what) { throw Error(Failure::output, "a mesh cannot be written: " + what); };
  const std::size_t count = mesh.positions.size();
  if (count == 0 || mesh.indices.empty()) fail("it has no triangles; give it vertices and indices");
  if (count > 0x7fffffff) fail("it has more than 2^31 - 1 vertices; split it");
  if (mesh.indices.size() % 3 != 0) fail("its indices are no multiple of three");
  if (!mesh.normals.empty() && mesh.normals.size() != count) fail("it has not one normal a vertex");
  if (!mesh.uvs.empty() && mesh.uvs.size() != count) fail("it has not one uv a vertex");
  for (const std::uint32_t i : mesh.indices)
    if (i >= count) fail("index " + std::to_string(i) + " is out of range of its " + std::to_string(count) + " vertices");
}

}  // namespace

std::string encode_ply(const TriangleMesh& mesh) {
  require_whole(mesh);
  const std::string header = header_of(mesh);
  Bytes out;
  const std::size_t floats = 3 + (mesh.normals.empty() ? 0 : 3) + (mesh.uvs.empty() ? 0 : 2);
  out.reserve(header.size() + mesh.positions.size() * floats * 4 + mesh.indices.size() / 3 * 13);
  out.put(std::string_view(header));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    out.put(mesh.positions[i]);
    if (!mesh.normals.empty()) out.put(mesh.normals[i]);
    if (!mesh.uvs.empty()) out.put(mesh.uvs[i]);
  }
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (i % 3 == 0) out.put(std::uint8_t{3});
    out.put(mesh.indices[i]);
  }
  return out.take();
}

}  // namespace tyndall
