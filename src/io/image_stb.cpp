#include <algorithm>
#include <cstdint>
#include <memory>

#include "io/image_decode.h"
#include "tyndall/error.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmisleading-indentation"
#define STB_IMAGE_IMPLEMENTATION
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

struct Free {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// Bytes handed to stb_image on request: it takes the end of its input for zeros, so we notice when it is passed.
struct Source {
  std::string_view bytes;
  std::size_t position = 0;
  bool exhausted = false;
};

int read_bytes(void* user, char* out, int count) {
  constexpr std::size_t look_ahead = 128;  // what stb_image fetches at a time; fewer left is no fault then
  auto& source = *static_cast<Source*>(user);
  const std::size_t wanted = static_cast<std::size_t>(std::max(count, 0));
  const std::size_t got = std::min(wanted, source.bytes.size() - source.position);
  std::copy_n(source.bytes.data() + source.position, got, out);
  source.position += got;
  if (got == 0 || (got < wanted && wanted != look_ahead)) source.exhausted = true;
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

Image decode_stb(std::string_view bytes, const Encoding& encoding, const std::string& path) {
  Source source{bytes};
  const auto fail = [&](const std::string& reason) { throw Error(Failure::scene, path + ": cannot be read: " + reason); };
  int width = 0, height = 0, count = 0;
  if (!stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, &count))
    fail("it is none of OpenEXR, PNG, Radiance HDR, JPEG, TGA, BMP, or its header is damaged");
  if (width <= 0 || height <= 0) fail("its header declares no pixels");
  constexpr std::size_t max_ratio = 2000;  // pixels a byte: beyond the densest that these formats reach
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) / max_ratio > bytes.size())
    fail("the file is too short for the size it declares");

  source = {bytes};
  const bool hdr = stbi_is_hdr_from_callbacks(&kCallbacks, &source);
  source = {bytes};
  const std::unique_ptr<void, Free> samples(
      hdr ? static_cast<void*>(stbi_loadf_from_callbacks(&kCallbacks, &source, &width, &height, &count, 3))
          : static_cast<void*>(stbi_load_from_callbacks(&kCallbacks, &source, &width, &height, &count, 0)));
  if (!samples) fail(stbi_failure_reason());
  if (source.exhausted) fail("the file is cut off");
  if (hdr) return from_floats(static_cast<const float*>(samples.get()), width, height);
  return image_from_samples(static_cast<const std::uint8_t*>(samples.get()), width, height, count, encoding);
}

}  // namespace tyndall
