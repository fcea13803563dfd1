/// What is searched for on the film before the first sample.
#pragma once

#include <vector>

#include "session/pixel_block.h"
#include "session/pixel_sample.h"
#include "transport/pixel/film_emitters.h"
#include "transport/pixel/film_search.h"

namespace tyndall {

class SearchedFilm {
 public:
  /// Nothing, of no pixel.
  SearchedFilm() = default;
  /// Depends on no sample.
  explicit SearchedFilm(const FilmSearch& search);

  /// Nothing outside of the pixels that were searched.
  PixelFilm of(PixelPlace p) const;
  /// Of a block's pixels, in their order.
  std::vector<PixelFilm> of(const PixelBlock& block) const;

 private:
  PixelBounds pixels_{};
  FilmPoints points_;
  FilmPeaks peaks_;
  FilmEmitters emitters_;
};

}  // namespace tyndall
