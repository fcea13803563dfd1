#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/image_decode.h"
#include "tyndall/error.h"

namespace tyndall {

float Encoding::decode(float stored) const {
  switch (kind) {
    case Kind::linear:
      return stored;
    case Kind::gamma:
      return std::pow(stored, gamma);
    case Kind::srgb:
      break;
  }
  // IEC 61966-2-1
  return stored <= 0.04045f ? stored / 12.92f : std::pow((stored + 0.055f) / 1.055f, 2.4f);
}

Encoding parse_encoding(const std::string& text, const std::string& path) {
  if (text.empty()) return {};
  if (text == "sRGB") return {.of_alpha = true};
  if (text == "linear") return {.kind = Encoding::Kind::linear};
  constexpr std::string_view prefix = "gamma ";
  if (text.starts_with(prefix)) {
    Encoding result{.kind = Encoding::Kind::gamma, .of_alpha = true};
    const char *begin = text.data() + prefix.size(), *end = text.data() + text.size();
    const auto [last, error] = std::from_chars(begin, end, result.gamma);
    if (error == std::errc() && last == end && result.gamma > 0 && std::isfinite(result.gamma)) return result;
  }
  throw Error(Failure::scene, path + ": encoding \"" + text + "\" is not known; use \"sRGB\", \"linear\" or \"gamma <value>\"");
}

template <class Integer>
Image image_from_samples(const Integer* samples, int width, int height, int count, const Encoding& encoding) {
  constexpr std::size_t levels = std::size_t{std::numeric_limits<Integer>::max()} + 1;
  std::vector<float> linear(levels), as_is(levels);
  for (std::size_t i = 0; i < levels; ++i) {
    as_is[i] = static_cast<float>(i) / static_cast<float>(levels - 1);
    linear[i] = encoding.decode(as_is[i]);
  }
  Image image;
  image.data = image.display = {0, 0, width, height};
  const bool grey = count <= 2, has_alpha = count % 2 == 0;
  const std::vector<std::string> colors = grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  const auto fill = [&](const std::string& name, std::size_t offset, const std::vector<float>& table) {
    std::vector<float>& values = image.add_channel(name).values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = table[samples[i * static_cast<std::size_t>(count) + offset]];
  };
  for (std::size_t c = 0; c < colors.size(); ++c) fill(colors[c], c, linear);
  if (has_alpha) fill("A", colors.size(), encoding.of_alpha ? linear : as_is);
  return image;
}

template Image image_from_samples(const std::uint8_t*, int, int, int, const Encoding&);
template Image image_from_samples(const std::uint16_t*, int, int, int, const Encoding&);

}  // namespace tyndall
