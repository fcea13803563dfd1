/// Samples of a block of pixels, from their paths to the film.
#pragma once

#include "session/film_buffer.h"
#include "session/matte_layers.h"
#include "session/pixel_block.h"
#include "session/pixel_sample.h"
#include "session/searched_film.h"

namespace tyndall {

/// Of a pixel in a pass: [begin, end).
struct SampleSpan {
  int begin, end;
  float share = 1;  ///< FilmBuffer::SamplePlace::share of each
};

class BlockRender {
 public:
  /// What all blocks share, and where their samples go. All must outlive this.
  struct Shared {
    const SampleContext& context;
    const MatteLayers& mattes;
    const SearchedFilm& searched;
    int first_sample;  ///< number of the render's first
    FilmBuffer& film;
  };
  explicit BlockRender(const Shared& shared) : shared_(shared) {}

  /// What a thread has to itself.
  struct Scratch {
    PixelGroup& group;
    Counters& counters;
  };
  /// The pixels of the block around `corner` that are in `tile`, several threads at once for several tiles.
  void render(PixelPlace corner, const PixelBounds& tile, SampleSpan samples, const Scratch& scratch) const;

 private:
  SampleKey key_of(PixelPlace p, int sample) const;
  void render_apart(const PixelBlock& block, SampleSpan samples, const Scratch& scratch) const;
  void render_shared(const PixelBlock& block, SampleSpan samples, const Scratch& scratch) const;
  void add_to_film(const Scratch& scratch, float share) const;
  void add_seen(const PixelSample& sample, const FilmBuffer::SamplePlace& at) const;

  Shared shared_;
};

}  // namespace tyndall
