/// Fog volumes as bytes of a .vdb file. OpenVDB's own writing to files loses errors and stamps each file with a random
/// identifier; a stream in memory has neither trouble once the identifier is replaced.
#include <cmath>
#include <sstream>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include "math/hash.h"
#include "tyndall/error.h"
#include "tyndall/volume_io.h"

namespace tyndall {
namespace {

using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;

[[noreturn]] void fail(const FogGrid& grid, const std::string& what) {
  throw Error(Failure::output, "grid \"" + grid.name + "\" cannot be written: " + what);
}

void require_whole(const FogGrid& grid) {
  if (grid.nx < 1 || grid.ny < 1 || grid.nz < 1) fail(grid, "it has no voxels; give nx, ny and nz of at least 1");
  if (static_cast<double>(grid.nx) * grid.ny * grid.nz != static_cast<double>(grid.values.size()))
    fail(grid, "it has " + std::to_string(grid.values.size()) + " values, not nx * ny * nz");
  if (!(grid.voxel_size > 0) || !std::isfinite(grid.voxel_size)) fail(grid, "its voxel size is not above 0");
  for (const float v : grid.values)
    if (!(v >= 0) || !std::isfinite(v)) fail(grid, "a value is negative or not finite");
}

openvdb::CoordBBox box_of(const FogGrid& grid) { return {{0, 0, 0}, {grid.nx - 1, grid.ny - 1, grid.nz - 1}}; }

openvdb::FloatGrid::Ptr tree_of(const FogGrid& spec) {
  auto grid = openvdb::FloatGrid::create(0.0f);
  // Dense looks at the values and does not change them, yet takes no pointer to const.
  openvdb::tools::copyFromDense(Dense(box_of(spec), const_cast<float*>(spec.values.data())), *grid, /*tolerance=*/0.0f);
  auto map = openvdb::math::Transform::createLinearTransform(spec.voxel_size);
  map->postTranslate({spec.origin.x, spec.origin.y, spec.origin.z});
  grid->setTransform(map);
  grid->setName(spec.name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

/// 8-4-4-4-12 hexadecimal digits of the content's hash: a UUID of version 8 [RFC 9562, 5.8].
std::string identifier(std::string_view content) {
  std::uint64_t a = content.size(), b = 1;
  for (const char c : content) {
    a = (a ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;  // FNV-1a
    b = (b ^ static_cast<unsigned char>(c)) * 0x9e3779b97f4a7c15ull;
  }
  const std::uint64_t words[2] = {mix_bits(a), mix_bits(b)};
  std::string text;
  for (int i = 0; i < 32; ++i) {
    if (i == 8 || i == 12 || i == 16 || i == 20) text += '-';
    int digit = static_cast<int>(words[i / 16] >> (60 - 4 * (i % 16)) & 15);
    if (i == 12) digit = 8;
    if (i == 16) digit = 8 | (digit & 3);
    text += "0123456789abcdef"[digit];
  }
  return text;
}

/// The random identifier stands in the header after magic (8 bytes), three version numbers (4 each) and one flag.
void make_reproducible(std::string& bytes) {
  constexpr std::size_t kAt = 8 + 3 * 4 + 1, kLength = 36;
  const auto is_dash = [&](std::size_t i) { return bytes.size() > kAt + kLength && bytes[kAt + i] == '-'; };
  if (!is_dash(8) || !is_dash(13) || !is_dash(18) || !is_dash(23))
    throw Error(Failure::output, "this OpenVDB writes a header that is not known; build with OpenVDB 10");
  bytes.replace(kAt, kLength, identifier(std::string_view(bytes).substr(kAt + kLength)));
}

bool same(const FogGrid& spec, const openvdb::GridBase::Ptr& read) {
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(read);
  if (!grid || grid->getName() != spec.name) return false;
  std::vector<float> values(spec.values.size());
  Dense dense(box_of(spec), values.data());
  openvdb::tools::copyToDense(*grid, dense);
  return values == spec.values;
}

void verify(const std::string& bytes, const std::vector<FogGrid>& grids) {
  std::istringstream in(bytes);
  in.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
  openvdb::io::Stream stream(in, /*delayLoad=*/false);
  const auto read = stream.getGrids();
  bool equal = read->size() == grids.size();
  for (std::size_t i = 0; equal && i < grids.size(); ++i) equal = same(grids[i], (*read)[i]);
  if (!equal) throw Error(Failure::output, "a volume reads back differently from what was written");
}

}  // namespace

std::string encode_vdb_fog(const std::vector<FogGrid>& grids) {
  for (const FogGrid& grid : grids) require_whole(grid);
  try {
    openvdb::initialize();
    openvdb::GridCPtrVec all;
    for (const FogGrid& grid : grids) all.push_back(tree_of(grid));
    std::ostringstream out;
    out.exceptions(std::ios::failbit | std::ios::badbit);
    {
      openvdb::io::Stream stream(out);
      stream.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
      stream.write(all);
    }
    std::string bytes = std::move(out).str();
    make_reproducible(bytes);
    verify(bytes, grids);
    return bytes;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(Failure::output, std::string("a volume cannot be written: ") + e.what());
  }
}

}  // namespace tyndall
