/// Pictures compared bit for bit.
#pragma once

#include <algorithm>
#include <cstring>

#include "tyndall/image.h"

namespace tyndall::test {

/// Whether R, G and B of `part` are what `whole`, which holds all of its pixels, has in the same places of the frame.
inline bool same_pixels(const Image& part, const Image& whole) {
  const int x0 = part.data.x0 - whole.data.x0, y0 = part.data.y0 - whole.data.y0;
  bool same = true;
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) same = same && part.rgb(x, y) == whole.rgb(x + x0, y + y0);
  }
  return same;
}

/// Whether two pictures have the same windows, channels and bits, NaN among them.
inline bool same_bits(const Image& a, const Image& b) {
  const auto same = [](const Channel& x, const Channel& y) {
    return x.name == y.name && x.values.size() == y.values.size() &&
           std::memcmp(x.values.data(), y.values.data(), x.values.size() * sizeof(float)) == 0;
  };
  return a.data == b.data && a.display == b.display &&
         std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(), same);
}
/// And the same header.
inline bool same_bits_and_header(const Image& a, const Image& b) { return same_bits(a, b) && a.attributes == b.attributes; }

}  // namespace tyndall::test
