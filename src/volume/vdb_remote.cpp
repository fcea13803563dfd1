// Between the two processes: the child answers each request with a flag, then the result or the text of its Error.
#include "volume/vdb_remote.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <mutex>

#include "tyndall/error.h"
#include "tyndall/memory.h"

namespace tyndall {
namespace {

enum class Request : std::uint8_t { load, describe };

/// Leaves that are sent at a time.
constexpr std::size_t kBatch = 128;

// A VDB tree unfolds to at most about 32 times its size in the file (nodes of one value, whose masks alone are stored),
// three times that for vectors in double precision; a file that asks for more is damaged or hostile.
constexpr std::size_t kUnfolding = 100, kBaseMemory = std::size_t{256} << 20;
// Unpacking and building the tree takes a fraction of this (docs/measurements.md).
constexpr double kBaseSeconds = 4, kBytesPerSecond = 1e7;
// A reader is replaced that does nothing from the start; one that waits for a slow disk is, too, but the last is waited for.
constexpr int kMostRestarts = 3;
constexpr double kIdleSeconds = 1;

ProcessLimits limits_for(const std::string& path, std::size_t most_memory) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  const std::size_t bytes = code ? 0 : std::min<std::size_t>(size, std::size_t{1} << 48);
  const std::size_t fair = std::min(kBaseMemory + kUnfolding * bytes, usable_memory());
  return {.memory = std::min(fair, most_memory), .cpu_seconds = kBaseSeconds + static_cast<double>(bytes) / kBytesPerSecond};
}

// ------------------------------------------------------------------------------------------ in the child

void put_rows(ProcessChannel& channel, const VolumeFile::Rows& rows) {
  channel.put(static_cast<std::uint32_t>(rows.size()));
  for (const auto& [name, value] : rows) {
    channel.put_text(name);
    channel.put_text(value);
  }
}

void put_entry(ProcessChannel& channel, const VolumeGridEntry& entry) {
  channel.put(entry.values);
  for (const std::string* text : {&entry.name, &entry.type, &entry.grid_class}) channel.put_text(*text);
  channel.put_flag(entry.level_set);
  channel.put_flag(entry.linear);
  channel.put(entry.leaves);
}

void put_grid(ProcessChannel& channel, const VolumeGrid& grid) {
  channel.put(grid.index_to_world.matrix());
  channel.put_flag(grid.clip.has_value());
  channel.put(grid.clip.value_or(VoxelBox{}));
  channel.put(grid.background);
  const std::vector<VoxelBlock>& blocks = grid.source->blocks();
  std::uint32_t leaves = 0;
  for (const VoxelBlock& block : blocks) leaves += block.leaf == VoxelBlock::kConstant ? 0 : 1;
  const auto channels = static_cast<std::uint32_t>(grid.source->channels());
  channel.put(channels);
  channel.put(leaves);
  channel.put(static_cast<std::uint64_t>(blocks.size()));
  channel.send(blocks.data(), blocks.size() * sizeof(VoxelBlock));

  const std::size_t leaf_size = std::size_t{VoxelSource::kLeafVoxels} * channels;
  std::vector<float> batch(leaf_size * kBatch);
  for (std::uint32_t first = 0; first < leaves; first += kBatch) {
    const auto count = std::min<std::size_t>(kBatch, leaves - first);
    for (std::size_t i = 0; i < count; ++i)
      grid.source->read_leaf(first + static_cast<std::uint32_t>(i), batch.data() + i * leaf_size);
    channel.send(batch.data(), count * leaf_size * sizeof(float));
  }
}

/// Answers with what `make` gives, handed to `put`, or with its Error.
template <typename Make, typename Put>
bool answer(ProcessChannel& channel, const Make& make, const Put& put) {
  std::string failure;
  try {
    const auto result = make();
    channel.put_flag(true);
    put(result);
    return true;
  } catch (const Error& e) {
    failure = e.what();
  }
  channel.put_flag(false);
  channel.put_text(failure);
  return false;
}

void serve(ProcessChannel& channel, const std::string& path, std::unique_ptr<VolumeFile> (*open)(const std::string&)) {
  std::unique_ptr<VolumeFile> file;
  const auto out_of_memory = [&]() -> Error {
    return Error(Failure::scene, path + ": needs more memory than its size explains, or than may be used; it may be damaged");
  };
  const auto guarded = [&](const auto& make) {
    return [&] {
      try {
        return make();
      } catch (const std::bad_alloc&) {
        throw out_of_memory();
      }
    };
  };
  const auto open_it = [&] {
    file = open(path);
    return true;
  };
  const auto put_entries = [&](bool) {
    channel.put_text(file->format());
    put_rows(channel, file->properties());
    channel.put(static_cast<std::uint32_t>(file->grids().size()));
    for (const VolumeGridEntry& entry : file->grids()) put_entry(channel, entry);
  };
  if (!answer(channel, guarded(open_it), put_entries)) return;
  while (true) {
    const auto request = channel.get<Request>();
    const auto grid = static_cast<std::size_t>(channel.get<std::uint64_t>());
    if (request == Request::load)
      answer(channel, guarded([&] { return file->load(grid); }), [&](const VolumeGrid& g) { put_grid(channel, g); });
    else
      answer(channel, guarded([&] { return file->describe(grid); }), [&](const auto& rows) { put_rows(channel, rows); });
  }
}

// ----------------------------------------------------------------------------------------- in the parent

class ReceivedSource : public VoxelSource {
 public:
  ReceivedSource(ProcessChannel& channel, std::size_t most_memory) {
    const auto channels = channel.get<std::uint32_t>(), leaves = channel.get<std::uint32_t>();
    const auto blocks = channel.get<std::uint64_t>();
    if (channels != 1 && channels != 3) refuse();
    channels_ = static_cast<int>(channels);
    leaf_size_ = std::size_t{kLeafVoxels} * channels;
    if (leaves > blocks || blocks > most_memory / sizeof(VoxelBlock) || leaves > most_memory / (leaf_size_ * sizeof(float)))
      refuse();
    blocks_.resize(blocks);
    channel.receive(blocks_.data(), blocks * sizeof(VoxelBlock));
    for (const VoxelBlock& block : blocks_) require_sound(block, leaves);
    values_ = std::make_unique_for_overwrite<float[]>(leaf_size_ * leaves);
    for (std::size_t first = 0; first < leaves; first += kBatch) {
      const std::size_t count = std::min<std::size_t>(kBatch, leaves - first);
      channel.receive(values_.get() + first * leaf_size_, count * leaf_size_ * sizeof(float));
    }
  }

  int channels() const override { return channels_; }
  const std::vector<VoxelBlock>& blocks() const override { return blocks_; }
  void read_leaf(std::uint32_t leaf, float* out) const override {
    std::copy_n(values_.get() + leaf * leaf_size_, leaf_size_, out);
  }

  [[noreturn]] static void refuse() { throw ProcessEnded("makes its reader talk nonsense; it is damaged"); }
  static void require_sound(const VoxelBox& box) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 32;  // indices are 32 bits in the file
    for (std::size_t a = 0; a < 3; ++a)
      if (box.lo[a] < -kFarthest || box.hi[a] > kFarthest || box.lo[a] > box.hi[a]) refuse();
  }

 private:
  static void require_sound(const VoxelBlock& block, std::uint32_t leaves) {
    require_sound(block.box);
    if (block.leaf == VoxelBlock::kConstant) return;
    if (block.leaf >= leaves) refuse();
    for (std::size_t a = 0; a < 3; ++a)
      if (block.box.hi[a] - block.box.lo[a] != kLeafSide - 1 || (block.box.lo[a] & (kLeafSide - 1)) != 0) refuse();
  }

  int channels_ = 1;
  std::size_t leaf_size_ = 0;
  std::vector<VoxelBlock> blocks_;
  std::unique_ptr<float[]> values_;
};

class RemoteVolumeFile : public VolumeFile {
 public:
  RemoteVolumeFile(const std::string& path, std::unique_ptr<ProcessChannel> worker, std::size_t most_memory)
      : path_(path), most_memory_(most_memory), channel_(std::move(worker)), worker_(*channel_) {
    receive([&] {
      format_ = worker_.get_text();
      properties_ = get_rows();
      const std::uint32_t count = get_count();
      for (std::uint32_t i = 0; i < count; ++i) entries_.push_back(get_entry());
    });
  }

  std::string format() const override { return format_; }
  Rows properties() const override { return properties_; }
  const std::vector<VolumeGridEntry>& grids() const override { return entries_; }

  VolumeGrid load(std::size_t grid) const override {
    VolumeGrid result;
    ask(Request::load, grid, [&] {
      const auto matrix = worker_.get<Transform::Matrix>();
      const bool clipped = worker_.get_flag();
      const auto clip = worker_.get<VoxelBox>();
      result.background = worker_.get<Background::Values>();
      if (clipped) ReceivedSource::require_sound(clip);
      if (clipped) result.clip = clip;
      result.source = std::make_unique<ReceivedSource>(worker_, most_memory_);
      result.index_to_world = Transform(matrix);
    });
    return result;
  }

  Rows describe(std::size_t grid) const override {
    Rows rows;
    ask(Request::describe, grid, [&] { rows = get_rows(); });
    return rows;
  }

 private:
  template <typename Get>
  void ask(Request request, std::size_t grid, const Get& get) const {
    const std::scoped_lock lock(mutex_);
    try {
      worker_.put(request);
      worker_.put(static_cast<std::uint64_t>(grid));
    } catch (const ProcessEnded& e) {
      fail(e);
    }
    receive(get);
  }

  /// The child's answer: its Error, or what `get` takes from the channel.
  template <typename Get>
  void receive(const Get& get) const {
    try {
      if (!worker_.get_flag()) throw Error(Failure::scene, worker_.get_text());
      get();
    } catch (const ProcessEnded& e) {
      fail(e);
    } catch (const std::bad_alloc&) {
      throw Error(Failure::scene, path_ + ": needs more memory than there is");
    }
  }
  [[noreturn]] void fail(const ProcessEnded& e) const { throw Error(Failure::scene, path_ + ": " + e.what()); }

  std::uint32_t get_count() const {
    constexpr std::uint32_t kMost = 1 << 20;
    const auto count = worker_.get<std::uint32_t>();
    if (count > kMost) ReceivedSource::refuse();
    return count;
  }
  Rows get_rows() const {
    Rows rows(get_count());
    for (auto& [name, value] : rows) {
      name = worker_.get_text();
      value = worker_.get_text();
    }
    return rows;
  }
  VolumeGridEntry get_entry() const {
    VolumeGridEntry entry;
    const auto values = worker_.get<std::underlying_type_t<VolumeGridEntry::Values>>();
    if (values < 0 || values > static_cast<int>(VolumeGridEntry::Values::other)) ReceivedSource::refuse();
    entry.values = static_cast<VolumeGridEntry::Values>(values);
    entry.name = worker_.get_text();
    for (std::string* text : {&entry.type, &entry.grid_class}) *text = printable(worker_.get_text());
    entry.level_set = worker_.get_flag();
    entry.linear = worker_.get_flag();
    entry.leaves = worker_.get<std::uint64_t>();
    entry.read_bytes = 2 * sizeof(float);  // in the child's tree, and as they come from there
    return entry;
  }

  std::string path_, format_;
  std::size_t most_memory_;
  mutable std::mutex mutex_;
  std::unique_ptr<ProcessChannel> channel_;
  ProcessChannel& worker_;
  Rows properties_;
  std::vector<VolumeGridEntry> entries_;
};

}  // namespace

std::unique_ptr<VolumeFile> open_remotely(const std::string& path, std::size_t most_memory,
                                          std::unique_ptr<VolumeFile> (*open)(const std::string& path)) {
  const ProcessLimits limits = limits_for(path, most_memory);
  const auto start = [&] {
    return std::make_unique<WorkerProcess>(limits, [&](ProcessChannel& channel) { serve(channel, path, open); });
  };
  auto worker = start();
  for (int again = 0; again < kMostRestarts && worker->is_stuck(kIdleSeconds); ++again) worker = start();
  return receive_volume(path, std::move(worker), limits.memory);
}

std::unique_ptr<VolumeFile> receive_volume(const std::string& path, std::unique_ptr<ProcessChannel> channel,
                                           std::size_t most_memory) {
  return std::make_unique<RemoteVolumeFile>(path, std::move(channel), most_memory);
}

}  // namespace tyndall
