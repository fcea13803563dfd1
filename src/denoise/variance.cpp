#include "denoise/variance.h"

namespace tyndall {
void pool_variance(Halves& halves, int radius, ThreadPool& pool) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto raw = [&](int x, int y) { return halves.raw_variance(c, x, y); };
    halves.variance[c] = box_mean(make_plane(halves.width(), halves.height(), pool, raw), radius, pool);
  }
}

}  // namespace tyndall
