/// One pass of a render over its frame: tiles, progress, and what it takes to undo it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "session/film_buffer.h"
#include "tyndall/render.h"

namespace tyndall {

struct RenderPass {
  /// Pixels a side of a tile: small enough to balance, also in small frames, large enough for coherent memory.
  static constexpr int kTile = 16, kSmallTile = 8;
  static constexpr int kSmallFrame = 128 * 128;

  /// So many for every pixel of `frame`; `pass_watch` must outlive the pass.
  RenderPass(const PixelBounds& frame, int samples_a_pixel, const RenderJob::PassWatch& pass_watch)
      : crop(frame),
        side(std::int64_t{frame.width()} * frame.height() <= kSmallFrame ? kSmallTile : kTile),
        x0(frame.x0 - frame.x0 % side),
        y0(frame.y0 - frame.y0 % side),
        across((frame.x1 - x0 + side - 1) / side),
        down((frame.y1 - y0 + side - 1) / side),
        count(samples_a_pixel),
        samples(static_cast<std::uint64_t>(frame.size()) * static_cast<std::uint64_t>(samples_a_pixel)),
        watch(pass_watch),
        finished(tiles(), 0) {}

  std::size_t tiles() const { return static_cast<std::size_t>(across) * static_cast<std::size_t>(down); }
  PixelBounds tile(std::size_t i) const {
    const int x = x0 + static_cast<int>(i % static_cast<std::size_t>(across)) * side;
    const int y = y0 + static_cast<int>(i / static_cast<std::size_t>(across)) * side;
    return {std::max(x, crop.x0), std::max(y, crop.y0), std::min(x + side, crop.x1), std::min(y + side, crop.y1)};
  }
  /// So many samples more are done, of all pixels together.
  void tell(std::size_t more) {
    if (!watch || more == 0) return;
    const std::scoped_lock lock(mutex);
    samples_done += more;
    if (!watch(static_cast<double>(samples_done) / static_cast<double>(samples) * count)) given_up = true;
  }

  PixelBounds crop;
  int side, x0, y0, across, down, count;  ///< tiles begin at multiples of `side`, so that each holds whole PixelBlocks
  std::uint64_t samples;                  ///< of all pixels together
  const RenderJob::PassWatch& watch;
  std::mutex mutex;
  std::uint64_t samples_done = 0;
  std::atomic<bool> given_up{false};
  std::vector<char> finished;    ///< by tile
  std::vector<FilmTile> before;  ///< sums by tile, to undo the pass; empty: not kept
};

}  // namespace tyndall
