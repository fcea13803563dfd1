#include "io/ply.h"

#include <array>
#include <cmath>

#include "io/file_text.h"
#include "io/ply_header.h"
#include "io/ply_values.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Items of one list; more do not fit into any file, and a text file may claim any number.
constexpr double kMaxListed = 1e15;

/// A number of the file for a message.
std::string shown(double value) {
  return std::abs(value) < kMaxListed ? std::to_string(static_cast<long long>(value)) : "a number that cannot be";
}

/// Where the values we want stand in a vertex; -1: absent.
struct VertexLayout {
  std::array<int, 3> position, normal;
  std::array<int, 2> uv{-1, -1};
  bool has_normal() const { return normal[0] >= 0 && normal[1] >= 0 && normal[2] >= 0; }
  bool has_uv() const { return uv[0] >= 0 && uv[1] >= 0; }
};

VertexLayout layout_of(const PlyElement& e) {
  VertexLayout layout{{e.index_of("x"), e.index_of("y"), e.index_of("z")},
                      {e.index_of("nx"), e.index_of("ny"), e.index_of("nz")}};
  constexpr std::array<std::array<const char*, 2>, 4> kNames{
      {{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};
  for (const auto& names : kNames)
    if (!layout.has_uv()) layout.uv = {e.index_of(names[0]), e.index_of(names[1])};
  return layout;
}

template <typename Values>
class BodyReader {
 public:
  BodyReader(const PlyHeader& header, Values values, const std::string& path)
      : header_(header), values_(std::move(values)), path_(path) {}

  PlyMesh read() {
    vertex_count_ = 0;
    for (const PlyElement& e : header_.elements)
      if (e.name == "vertex") vertex_count_ = e.count;
    for (const PlyElement& e : header_.elements) {
      if (e.properties.empty()) continue;
      if (!values_.can_hold(e.count, e))
        throw error("declares " + std::to_string(e.count) + " elements \"" + e.name +
                    "\", more than the file can hold; it is truncated or damaged");
      if (e.name == "vertex")
        read_vertices(e);
      else if (e.name == "face")
        read_faces(e);
      else
        skip_elements(e);
    }
    if (mesh_.positions.empty()) throw error("has no vertices");
    if (mesh_.broken_normals == mesh_.normals.size()) mesh_.normals.clear();
    if (mesh_.triangles.empty() && mesh_.quads.empty()) throw error("has no faces");
    return std::move(mesh_);
  }

 private:
  Error error(const std::string& what) const { return Error(Failure::scene, path_ + ": " + what); }
  Error truncated(const PlyElement& e, std::size_t i) const {
    return error("ends or holds no number in " + e.name + " " + std::to_string(i) + " of " + std::to_string(e.count) +
                 "; it is truncated or damaged");
  }

  void read_vertices(const PlyElement& e) {
    const VertexLayout at = layout_of(e);
    if (at.position[0] < 0 || at.position[1] < 0 || at.position[2] < 0) throw error("has vertices without x, y and z");
    mesh_.positions.reserve(e.count);
    if (at.has_normal()) mesh_.normals.reserve(e.count);
    if (at.has_uv()) mesh_.uvs.reserve(e.count);
    std::vector<float> row(e.properties.size());
    for (std::size_t i = 0; i < e.count; ++i) {
      for (std::size_t p = 0; p < row.size(); ++p) row[p] = read_property(e, p, i);
      add_vertex(at, row, i);
    }
  }

  void add_vertex(const VertexLayout& at, const std::vector<float>& row, std::size_t i) {
    const auto triple = [&](const std::array<int, 3>& k) { return Vec3{row[k[0]], row[k[1]], row[k[2]]}; };
    mesh_.positions.push_back(triple(at.position));
    bool finite = is_finite(mesh_.positions.back());
    if (at.has_normal()) {
      // Exporters write NaN normals for faces without area; nothing else depends on them, as it does on positions.
      Vec3 n = triple(at.normal);
      if (!is_finite(n)) n = {}, ++mesh_.broken_normals;
      mesh_.normals.push_back(n);
    }
    if (at.has_uv()) {
      mesh_.uvs.push_back({row[at.uv[0]], row[at.uv[1]]});
      finite = finite && std::isfinite(mesh_.uvs.back().x) && std::isfinite(mesh_.uvs.back().y);
    }
    if (!finite) throw error("vertex " + std::to_string(i) + " has a NaN or infinite value; repair the mesh");
  }

  /// The value of a scalar property; a list is skipped.
  float read_property(const PlyElement& e, std::size_t p, std::size_t i) {
    const PlyProperty& property = e.properties[p];
    double value = 0;
    if (!values_.value(property.is_list ? property.count_type : property.type, value)) throw truncated(e, i);
    if (!property.is_list) return static_cast<float>(value);
    if (!(value >= 0 && value < kMaxListed) || !values_.skip(property.type, static_cast<std::size_t>(value)))
      throw truncated(e, i);
    return 0;
  }

  void read_faces(const PlyElement& e) {
    int list = e.index_of("vertex_indices");
    if (list < 0) list = e.index_of("vertex_index");
    if (list < 0 || !e.properties[list].is_list) throw error("has faces without a list \"vertex_indices\"");
    const PlyType type = e.properties[list].type;
    if (type == PlyType::float32 || type == PlyType::float64) throw error("has indices of a floating-point type");
    for (std::size_t i = 0; i < e.count; ++i)
      for (std::size_t p = 0; p < e.properties.size(); ++p) {
        if (static_cast<int>(p) == list)
          read_corners(e, e.properties[p], i);
        else
          read_property(e, p, i);
      }
  }

  void read_corners(const PlyElement& e, const PlyProperty& property, std::size_t face) {
    double count = 0;
    if (!values_.value(property.count_type, count)) throw truncated(e, face);
    if (count != 3 && count != 4)
      throw error("face " + std::to_string(face) + " has " + shown(count) +
                  " corners; only triangles and quadrilaterals are supported, triangulate the mesh");
    std::array<std::uint32_t, 4> corners{};
    for (int c = 0; c < static_cast<int>(count); ++c) {
      double index = 0;
      if (!values_.value(property.type, index)) throw truncated(e, face);
      if (!(index >= 0 && index < static_cast<double>(vertex_count_)))
        throw error("face " + std::to_string(face) + " has index " + shown(index) + " out of range; the file has " +
                    std::to_string(vertex_count_) + " vertices");
      corners[c] = static_cast<std::uint32_t>(index);
    }
    // A patch names its corners by rows, a quadrilateral goes around.
    if (count == 3)
      mesh_.triangles.insert(mesh_.triangles.end(), corners.begin(), corners.begin() + 3);
    else
      mesh_.quads.insert(mesh_.quads.end(), {corners[0], corners[1], corners[3], corners[2]});
  }

  void skip_elements(const PlyElement& e) {
    for (std::size_t i = 0; i < e.count; ++i)
      for (std::size_t p = 0; p < e.properties.size(); ++p) read_property(e, p, i);
  }

  const PlyHeader& header_;
  Values values_;
  const std::string& path_;
  std::size_t vertex_count_ = 0;
  PlyMesh mesh_;
};

}  // namespace

PlyMesh read_ply_bytes(std::string_view bytes, const std::string& path) {
  const PlyHeader header = parse_ply_header(bytes, path);
  const std::string_view body = bytes.substr(header.size);
  if (header.encoding == PlyEncoding::ascii) return BodyReader(header, PlyTextValues(body), path).read();
  const auto order = header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little;
  return BodyReader(header, PlyBinaryValues(body, order), path).read();
}

PlyMesh read_ply(const std::string& path) { return read_ply_bytes(read_file_text(path), path); }

}  // namespace tyndall
