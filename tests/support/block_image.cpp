#include "support/block_image.h"

#include <cstddef>

namespace tyndall::test {

Image block_image(const Image& image, int side) {
  const auto width = static_cast<std::size_t>(image.width()), edge = static_cast<std::size_t>(side);
  Image means;
  means.data = means.display = {0, 0, image.width() / side, image.height() / side};
  for (const char* name : {"R", "G", "B"}) {
    auto& values = means.add_channel(name).values;
    const auto& from = image.find(name)->values;
    for (std::size_t p = 0; p < from.size(); ++p)
      values[p / width / edge * (width / edge) + p % width / edge] += from[p] / static_cast<float>(side * side);
  }
  return means;
}

}  // namespace tyndall::test
