#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <set>

#include "io/image_decode.h"
#include "io/jpeg_tables.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Everything that stb_image holds: it is left by an exception at the end of a file, and cannot clean up then.
class StbMemory {
 public:
  StbMemory() : outer_(current) { current = this; }
  ~StbMemory() {
    current = outer_;
    for (void* block : blocks_) std::free(block);
  }
  StbMemory(const StbMemory&) = delete;
  StbMemory& operator=(const StbMemory&) = delete;

  void* resize(void* block, std::size_t size) {
    void* moved = std::realloc(block, size);
    if (!moved) return nullptr;
    blocks_.erase(block);
    blocks_.insert(moved);
    return moved;
  }
  void release(void* block) {
    blocks_.erase(block);
    std::free(block);
  }

  static thread_local StbMemory* current;

 private:
  StbMemory* outer_;
  std::set<void*> blocks_;
};
thread_local StbMemory* StbMemory::current = nullptr;

/// Zeros: a JPEG file may use a Huffman table that it does not have, which stb_image 2.27 takes as it finds it.
void* stb_malloc(std::size_t size) {
  const std::size_t bytes = std::max<std::size_t>(size, 1);
  void* const block = StbMemory::current->resize(nullptr, bytes);
  if (block) std::memset(block, 0, bytes);
  return block;
}
[[maybe_unused]] void* stb_realloc(void* block, std::size_t size) {
  return StbMemory::current->resize(block, std::max<std::size_t>(size, 1));
}
void stb_free(void* block) { StbMemory::current->release(block); }

}  // namespace
}  // namespace tyndall

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmisleading-indentation"
#define STB_IMAGE_IMPLEMENTATION
#define STBI_MALLOC(size) tyndall::stb_malloc(size)
#define STBI_REALLOC(block, size) tyndall::stb_realloc(block, size)
#define STBI_FREE(block) tyndall::stb_free(block)
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_HDR
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_MAX_DIMENSIONS (1 << 16)
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace tyndall {
namespace {

/// Bytes handed to stb_image on request: it takes the end of its input for zeros without end, and loops over them for ever.
struct Source {
  std::string_view bytes;
  bool must_last = false;  ///< asking for more than there is means that the file is cut off
  std::size_t position = 0;
};
struct CutOff {};

int read_bytes(void* user, char* out, int count) {
  constexpr std::size_t look_ahead = 128;  // what stb_image fetches at a time; fewer left is no fault then
  auto& source = *static_cast<Source*>(user);
  const std::size_t wanted = static_cast<std::size_t>(std::max(count, 0));
  const std::size_t got = std::min(wanted, source.bytes.size() - source.position);
  std::copy_n(source.bytes.data() + source.position, got, out);
  source.position += got;
  if (source.must_last && (got == 0 || (got < wanted && wanted != look_ahead))) throw CutOff{};
  return static_cast<int>(got);
}

void skip_bytes(void* user, int count) {
  auto& source = *static_cast<Source*>(user);
  const auto target = static_cast<std::int64_t>(source.position) + count;
  source.position =
      static_cast<std::size_t>(std::clamp<std::int64_t>(target, 0, static_cast<std::int64_t>(source.bytes.size())));
}

int at_end(void* user) {
  const auto& source = *static_cast<const Source*>(user);
  return source.position == source.bytes.size();
}

constexpr stbi_io_callbacks kCallbacks{read_bytes, skip_bytes, at_end};

/// Radiance RGBE: linear already.
Image from_floats(const float* samples, int width, int height) {
  Image image;
  image.data = image.display = {0, 0, width, height};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float>& values = image.add_channel(std::string(1, "RGB"[c])).values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = samples[3 * i + c];
  }
  return image;
}

}  // namespace

ImageSize stb_size(std::string_view bytes, const std::string& path) {
  if (has_oversized_table(bytes))
    throw Error(Failure::scene, path + ": cannot be read: a Huffman table has more than 256 codes; the file is damaged");
  StbMemory memory;  // not const: it is written through `current`
  Source source{bytes};
  ImageSize size;
  int count = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &source, &size.width, &size.height, &count))
    throw Error(
        Failure::scene,
        path + ": cannot be read: it is none of OpenEXR, PNG, PFM, Radiance HDR, JPEG, TGA, BMP, or its header is damaged");
  return size;
}

Image decode_stb(std::string_view bytes, const Encoding& encoding, const std::string& path) {
  StbMemory memory;  // not const: it is written through `current`
  Source source{bytes};
  const auto fail = [&](const std::string& reason) { throw Error(Failure::scene, path + ": cannot be read: " + reason); };
  auto [width, height] = stb_size(bytes, path);
  int count = 0;
  if (width <= 0 || height <= 0) fail("its header declares no pixels");
  constexpr std::size_t max_ratio = 2000;  // pixels a byte: beyond the densest that these formats reach
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) / max_ratio > bytes.size())
    fail("the file is too short for the size it declares");

  source = {bytes};
  const bool hdr = stbi_is_hdr_from_callbacks(&kCallbacks, &source);
  source = {bytes, true};
  const void* samples = nullptr;  // belongs to `memory`
  try {
    samples = hdr ? static_cast<void*>(stbi_loadf_from_callbacks(&kCallbacks, &source, &width, &height, &count, 3))
                  : static_cast<void*>(stbi_load_from_callbacks(&kCallbacks, &source, &width, &height, &count, 0));
  } catch (const CutOff&) {
    fail("the file is cut off");
  }
  if (!samples) fail(stbi_failure_reason());
  if (hdr) return from_floats(static_cast<const float*>(samples), width, height);
  Image image = image_from_samples(static_cast<const std::uint8_t*>(samples), width, height, count, encoding);
  std::erase_if(image.channels, [](const Channel& c) { return c.name == "A"; });
  return image;
}

}  // namespace tyndall
