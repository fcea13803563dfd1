#include "volume/vdb_nano_file.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include <blosc.h>
#include <zlib.h>

#include "tyndall/error.h"
#include "volume/vdb_file.h"

namespace tyndall {
namespace {

/// The layout of nanovdb::io::Header and MetaData, read by ourselves: the library's own reader trusts every number.
struct SegmentHeader {
  char magic[8];
  std::uint32_t version;
  std::uint16_t grid_count, codec;
};
struct GridHeader {
  std::uint64_t grid_size, file_size, name_key, voxel_count;
  std::uint32_t type, grid_class;
  double world_box[6];
  std::int32_t index_box[6];
  double voxel_size[3];
  std::uint32_t name_size, node_count[4], tile_count[3];
  std::uint16_t codec, padding;
  std::uint32_t version;
};
static_assert(sizeof(SegmentHeader) == 16 && sizeof(GridHeader) == 176);

constexpr const char* kCodecs[] = {"none", "ZIP", "Blosc"};
constexpr std::uint32_t kMaxName = 4096;
/// Neither ZIP nor Blosc packs denser than this; more is a damaged or hostile header.
constexpr std::uint64_t kMaxRatio = 2048;

class NanoReader {
 public:
  NanoReader(const std::string& path, std::size_t most_memory)
      : path_(path), in_(path, std::ios::binary), memory_left_(most_memory) {
    std::error_code code;
    left_ = std::filesystem::file_size(path, code);
    if (!in_ || code) fail("cannot be opened; check its permissions");
  }

  NanoFile read() {
    NanoFile file;
    while (left_ > 0) {
      const auto header = take<SegmentHeader>();
      if (std::memcmp(header.magic, "NanoVDB", 7) != 0) fail("has bytes that belong to no grid; it is damaged");
      file.version = nano_version(header.version);
      check_version(header.version);
      if (header.codec > 2) fail("is packed by unknown codec " + std::to_string(header.codec));
      read_segment(header, file);
    }
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(Failure::scene, path_ + ": " + what); }

  template <typename T>
  T take() {
    T value;
    take(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
  }
  void take(char* out, std::uint64_t size) {
    if (size > left_) fail("ends too early; it may have been cut off while it was written");
    in_.read(out, static_cast<std::streamsize>(size));
    if (!in_) fail("cannot be read to its end");
    left_ -= size;
  }

  /// Layouts are only compatible within one major version.
  void check_version(std::uint32_t version) const {
    if (version >> 21 == NANOVDB_MAJOR_VERSION_NUMBER) return;
    fail("is NanoVDB version " + nano_version(version) + ", which cannot be read (only " +
         std::to_string(NANOVDB_MAJOR_VERSION_NUMBER) + ".x); write it again from its .vdb with a newer nanovdb_convert");
  }

  void read_segment(const SegmentHeader& segment, NanoFile& file) {
    std::vector<GridHeader> headers;
    std::vector<std::string> names;
    for (int i = 0; i < segment.grid_count; ++i) {
      headers.push_back(take<GridHeader>());
      const std::uint32_t name_size = headers.back().name_size;
      if (name_size > kMaxName) fail("has a grid name of " + std::to_string(name_size) + " characters; it is damaged");
      std::string name(name_size, '\0');
      take(name.data(), name_size);
      names.emplace_back(name.c_str());  // its end is a zero
    }
    for (std::size_t i = 0; i < headers.size(); ++i) {
      if (headers[i].codec > 2) fail("holds a grid packed by an unknown codec; it is damaged");
      NanoBlob& grid = file.grids.emplace_back(NanoBlob{unpack(headers[i]), kCodecs[headers[i].codec], {}});
      check_head(grid);
      grid.name = whole_name(grid.head().mGridName, names[i]);
    }
  }

  /// The head of a grid has room for the beginning of a long name, which the file has whole.
  static std::string whole_name(const std::string& in_head, const std::string& in_file) {
    const bool cut = in_head.size() + 1 >= nanovdb::GridData::MaxNameSize;
    return cut && in_file.starts_with(in_head) ? in_file : in_head;
  }

  nanovdb::HostBuffer unpack(const GridHeader& header) {
    if (header.file_size > left_) fail("ends too early; it may have been cut off while it was written");
    if (header.grid_size < sizeof(nanovdb::GridData) + sizeof(nanovdb::TreeData<3>) ||
        (header.codec == 0 ? header.grid_size != header.file_size : header.grid_size / kMaxRatio > header.file_size))
      fail("has a grid of impossible size; it is damaged");
    if (header.grid_size > memory_left_) fail_large(header.grid_size);
    memory_left_ -= header.grid_size;
    nanovdb::HostBuffer buffer = nanovdb::HostBuffer::create(header.grid_size);
    auto* out = reinterpret_cast<char*>(buffer.data());
    if (header.codec == 0)
      take(out, header.grid_size);
    else
      unpack_chunks(header, out);
    return buffer;
  }

  [[noreturn]] void fail_large(std::uint64_t bytes) const {
    const auto gigabytes = [](std::uint64_t b) { return std::to_string(static_cast<double>(b) * 1e-9) + " GB"; };
    fail("holds a grid of " + gigabytes(bytes) + " where only " + gigabytes(memory_left_) +
         " of memory are left; raise --max-memory or use a coarser volume");
  }

  /// ZIP is one chunk, Blosc as many as it takes; each after its size.
  void unpack_chunks(const GridHeader& header, char* out) {
    std::uint64_t packed_left = header.file_size, left = header.grid_size;
    while (left > 0) {
      if (packed_left < 8) fail("has a packed grid that ends too early; it is damaged");
      const auto size = take<std::uint64_t>();
      packed_left -= 8;
      if (size > packed_left) fail("has a packed grid of impossible size; it is damaged");
      std::vector<char> packed(size);
      take(packed.data(), size);
      packed_left -= size;
      const std::uint64_t got = header.codec == 1 ? unzip(packed, out, left) : unblosc(packed, out, left);
      if (got == 0 || got > left || (header.codec == 1 && got != left)) fail("has a grid that does not unpack; it is damaged");
      out += got;
      left -= got;
    }
    if (packed_left != 0) fail("has a packed grid that is longer than it says; it is damaged");
  }
  static std::uint64_t unzip(const std::vector<char>& packed, char* out, std::uint64_t room) {
    uLongf size = room;
    const int status =
        uncompress(reinterpret_cast<Bytef*>(out), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    return status == Z_OK ? size : 0;
  }
  static std::uint64_t unblosc(const std::vector<char>& packed, char* out, std::uint64_t room) {
    std::size_t size = 0;
    if (blosc_cbuffer_validate(packed.data(), packed.size(), &size) < 0 || size > room) return 0;
    const int got = blosc_decompress_ctx(packed.data(), out, size, 1);
    return got > 0 ? static_cast<std::uint64_t>(got) : 0;
  }

  void check_head(const NanoBlob& blob) const {
    const nanovdb::GridData& head = blob.head();
    std::uint64_t magic = 0;
    std::memcpy(&magic, "NanoVDB0", 8);
    if (head.mMagic != magic) fail("holds a grid without NanoVDB's magic number; it is damaged");
    std::uint32_t version = 0;
    std::memcpy(&version, &head.mVersion, 4);
    check_version(version);
    if (head.mGridSize != blob.bytes.size()) fail("holds a grid whose size differs from the file's header; it is damaged");
    if (!std::memchr(head.mGridName, 0, nanovdb::GridData::MaxNameSize))
      fail("holds a grid whose name has no end; it is damaged");
  }

  const std::string& path_;
  std::ifstream in_;
  std::uint64_t left_ = 0;  // bytes of the file
  std::uint64_t memory_left_;
};

}  // namespace

std::string nano_version(std::uint32_t packed) {
  return std::to_string(packed >> 21) + "." + std::to_string(packed >> 10 & 0x7ff) + "." + std::to_string(packed & 0x3ff);
}

NanoFile read_nano_file(const std::string& path, std::size_t most_memory) {
  try {
    return NanoReader(path, most_memory).read();
  } catch (const std::bad_alloc&) {
    throw Error(Failure::scene, path + ": needs more memory than there is; it may be damaged");
  }
}

}  // namespace tyndall
