#include "report/page_picture.h"

#include <zlib.h>

#include <bit>
#include <cmath>

#include "tyndall/error.h"

namespace tyndall {
namespace {

/// value / 2^shift, ties to even.
std::uint32_t shift_rounded(std::uint32_t value, int shift) {
  const std::uint32_t kept = value >> shift, lost = value & ((1u << shift) - 1), half = 1u << (shift - 1);
  return kept + (lost > half || (lost == half && (kept & 1)) ? 1 : 0);
}

std::string planes_of_halves(const Image& image) {
  const auto pixels = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::string bytes(6 * pixels, '\0');
  std::size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, ++i) {
      const Rgb color = image.rgb(x, y);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint16_t half = to_half(color[static_cast<int>(k)]);
        bytes[2 * k * pixels + i] = static_cast<char>(half >> 8);
        bytes[(2 * k + 1) * pixels + i] = static_cast<char>(half & 0xff);
      }
    }
  }
  return bytes;
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                               bytes.size(), Z_DEFAULT_COMPRESSION);
  if (status != Z_OK) throw Error(Failure::run_time, "report: a picture does not fit into memory; render a smaller one");
  out.resize(size);
  return out;
}

}  // namespace

std::uint16_t to_half(float value) {
  constexpr std::uint32_t kLargest = 0x7bff, kInfinite = 0x7c00, kNan = 0x7e00;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000, mantissa = bits & 0x7fffff;
  const int exponent = static_cast<int>((bits >> 23) & 0xff) - 127;
  const auto with_sign = [sign](std::uint32_t magnitude) { return static_cast<std::uint16_t>(sign | magnitude); };

  if (std::isnan(value)) return with_sign(kNan);
  if (std::isinf(value)) return with_sign(kInfinite);
  if (exponent > 15) return with_sign(kLargest);
  if (exponent < -25) return with_sign(0);
  if (exponent < -14) return with_sign(shift_rounded(mantissa | 0x800000, -1 - exponent));  // in units of 2^-24
  const std::uint32_t half = shift_rounded((static_cast<std::uint32_t>(exponent + 15) << 23) | mantissa, 13);
  return with_sign(half < kInfinite ? half : kLargest);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string encode_picture(const Image& image) {
  if (image.width() <= 0 || image.height() <= 0) throw Error(Failure::usage, "report: a picture has no pixels; leave it out");
  return base64(deflated(planes_of_halves(image)));
}

}  // namespace tyndall
