#include "fuzz/targets.h"

#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "io/exr.h"
#include "io/lens_file.h"
#include "io/ply.h"
#include "math/stream_hash.h"
#include "session/checkpoint.h"
#include "support/scratch.h"
#include "tyndall/error.h"
#include "tyndall/io.h"
#include "volume/medium.h"
#include "volume/vdb_remote.h"

namespace tyndall::fuzz {
namespace {

/// The bytes as a file, for readers that want a path. One file a process, written anew each time.
std::string file_of(std::string_view bytes, const char* name) {
  static const test::Scratch folder;
  const std::string path = folder / name;
  test::write_bytes(path, std::string(bytes));
  return path;
}

/// Error is the one exception that may leave a reader.
template <typename Read>
void attempt(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

void import_medium(const std::string& path) {
  attempt([&] {
    Medium medium;
    VdbMedium vdb;
    vdb.path = path;
    medium.kind = vdb;
    std::vector<std::string> notes;
    const ParticipatingMedium built = build_medium(medium, {.most_memory = std::size_t{1} << 29}, notes);
    static_cast<void>(built.at({0.1f, 0.2f, 0.3f}));
    static_cast<void>(built.bounds());
  });
}

}  // namespace

void scene(std::string_view bytes) {
  attempt([&] { read_scene_text(std::string(bytes), "fuzz.pbrt", TYNDALL_SOURCE_DIR "/tests/regression/suite"); });
  attempt([&] { check_scene(file_of(bytes, "fuzz.pbrt")); });
}

void ply(std::string_view bytes) {
  attempt([&] { read_ply_bytes(bytes, "fuzz.ply"); });
}

void vdb(std::string_view bytes) { import_medium(file_of(bytes, "fuzz.vdb")); }

void nvdb(std::string_view bytes) {
  if (bytes.starts_with("NanoVDB")) import_medium(file_of(bytes, "fuzz.nvdb"));
}

void exr(std::string_view bytes) {
  attempt([&] { read_exr(file_of(bytes, "fuzz.exr")); });
}

void pfm(std::string_view bytes) {
  if (bytes.starts_with('P')) attempt([&] { read_image(file_of(bytes, "fuzz.pfm")); });
}

void ies(std::string_view bytes) {
  attempt([&] { read_ies_text(bytes, "fuzz.ies"); });
}

void lens(std::string_view bytes) {
  attempt([&] { read_lens_text(bytes, "fuzz.dat"); });
}

void checkpoint(std::string_view bytes) {
  StreamHash hash;
  hash.add(bytes.data(), bytes.size());
  const std::uint64_t value = hash.value();
  const std::string whole = std::string(bytes) + std::string(reinterpret_cast<const char*>(&value), sizeof value);
  FilmSums sums(8);
  attempt([&] { decode_checkpoint(whole, "fuzz.checkpoint", {{"scene", "1"}, {"build", "2"}}, sums); });
  attempt([&] { peek_checkpoint(whole, "fuzz.checkpoint"); });
  attempt([&] { decode_checkpoint(bytes, "fuzz.checkpoint", {{"scene", "1"}, {"build", "2"}}, sums); });
}

void volume_message(std::string_view bytes) {
  constexpr std::size_t kRoom = 100'000;  // what the channel holds without a reader
  int ends[2];
  if (bytes.size() > kRoom || socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return;
  const bool sent = write(ends[1], bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  shutdown(ends[1], SHUT_WR);
  attempt([&] {
    const auto file = receive_volume("fuzz.vdb", std::make_unique<ProcessChannel>(ends[0]), std::size_t{1} << 24);
    for (std::size_t i = 0; sent && i < file->grids().size() && i < 4; ++i) {
      attempt([&] { file->describe(i); });
      attempt([&] {
        const VolumeGrid grid = file->load(i);
        std::vector<float> leaf(VoxelSource::kLeafVoxels * static_cast<std::size_t>(grid.source->channels()));
        for (const VoxelBlock& block : grid.source->blocks())
          if (block.leaf != VoxelBlock::kConstant) grid.source->read_leaf(block.leaf, leaf.data());
      });
    }
  });
  close(ends[1]);
}

}  // namespace tyndall::fuzz
