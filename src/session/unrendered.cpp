#include "session/unrendered.h"

#include <algorithm>

namespace tyndall {

void mark_unrendered(Image& image, std::span<const PixelBounds> tiles, int samples) {
  if (!image.find("SampleCount")) {
    for (float& v : image.add_channel("SampleCount").values) v = static_cast<float>(samples);
  }
  for (Channel& channel : image.channels) {
    if (channel.name != "SampleCount" && channel.name != "Replicate.SampleCount") continue;
    for (const PixelBounds& tile : tiles) {
      for (int y = tile.y0; y < tile.y1; ++y) {
        const auto row = static_cast<std::size_t>(y - image.data.y0) * static_cast<std::size_t>(image.width());
        std::fill_n(channel.values.begin() + static_cast<std::ptrdiff_t>(row) + (tile.x0 - image.data.x0), tile.width(), 0.0f);
      }
    }
  }
}

}  // namespace tyndall
