/// Portable float maps: a text header, then rows of floats from the bottom row to the top one.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "io/image_decode.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

struct PfmHeader {
  int width = 0, height = 0;
  std::size_t channels = 0, begin = 0;  ///< of the floats
  float scale = 1;
  bool little_endian = false;
};

bool is_pfm_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The numbers of the header, each after white space.
class PfmHeaderReader {
 public:
  PfmHeaderReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  template <typename Number>
  Number number(const char* what) {
    while (at_ < bytes_.size() && is_pfm_space(bytes_[at_])) ++at_;
    Number value{};
    const auto [end, error] = std::from_chars(bytes_.data() + at_, bytes_.data() + bytes_.size(), value);
    if (error != std::errc())
      throw Error(Failure::scene, path_ + ": cannot be read: its header has no " + what + "; the file is damaged");
    at_ = static_cast<std::size_t>(end - bytes_.data());
    return value;
  }
  std::size_t at() const { return at_; }

 private:
  std::string_view bytes_;
  const std::string& path_;
  std::size_t at_ = 2;  ///< after PF or Pf
};

PfmHeader pfm_header(std::string_view bytes, const std::string& path) {
  PfmHeader header;
  PfmHeaderReader reader(bytes, path);
  header.channels = bytes[1] == 'F' ? 3 : 1;
  header.width = reader.number<int>("width");
  header.height = reader.number<int>("height");
  const float scale = reader.number<float>("scale");
  if (header.width <= 0 || header.height <= 0 || header.width > kMaxImageSide || header.height > kMaxImageSide)
    throw Error(Failure::scene, path + ": cannot be read: its header declares " + std::to_string(header.width) + " x " +
                                    std::to_string(header.height) + " pixels; the file is damaged");
  if (!std::isfinite(scale) || scale == 0)
    throw Error(Failure::scene, path + ": cannot be read: the scale in its header is 0 or no number; the file is damaged");
  header.little_endian = scale < 0;
  header.scale = std::abs(scale);
  header.begin = reader.at() + 1;  // one white space
  return header;
}

float pfm_float(std::string_view bytes, std::size_t at, bool little_endian) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i)
    bits |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * (little_endian ? i : 3 - i));
  return std::bit_cast<float>(bits);
}

}  // namespace

bool is_pfm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') && is_pfm_space(bytes[2]);
}

ImageSize pfm_size(std::string_view bytes, const std::string& path) {
  const PfmHeader header = pfm_header(bytes, path);
  return {header.width, header.height};
}

Image decode_pfm(std::string_view bytes, const std::string& path) {
  const PfmHeader header = pfm_header(bytes, path);
  const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height);
  if (bytes.size() < header.begin || (bytes.size() - header.begin) / 4 < width * height * header.channels)
    throw Error(Failure::scene, path + ": cannot be read: the file is cut off");
  Image image;
  image.data = image.display = {0, 0, header.width, header.height};
  for (std::size_t c = 0; c < header.channels; ++c) {
    std::vector<float>& values = image.add_channel(header.channels == 1 ? "Y" : std::string(1, "RGB"[c])).values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t from = (height - 1 - i / width) * width + i % width;
      values[i] = header.scale * pfm_float(bytes, header.begin + 4 * (from * header.channels + c), header.little_endian);
    }
  }
  return image;
}

}  // namespace tyndall
