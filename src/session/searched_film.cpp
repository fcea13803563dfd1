#include "session/searched_film.h"

namespace tyndall {

SearchedFilm::SearchedFilm(const FilmSearch& search)
    : pixels_(search.pixels), points_(film_points(search)), peaks_(film_peaks(search)), emitters_(search) {}

PixelFilm SearchedFilm::of(PixelPlace p) const {
  if (!pixels_.contains(p.x, p.y)) return PixelFilm();
  return {points_.of(p.x, p.y), peaks_.of(p.x, p.y), emitters_.of(p.x, p.y)};
}

std::vector<PixelFilm> SearchedFilm::of(const PixelBlock& block) const {
  std::vector<PixelFilm> films;
  films.reserve(block.pixels().size());
  for (const PixelPlace p : block.pixels()) films.push_back(of(p));
  return films;
}

}  // namespace tyndall
