#include "session/film_sums.h"

#include <algorithm>

namespace tyndall {

void FilmSums::copy(const FilmSums& from, std::size_t first, std::size_t count, std::size_t to) {
  std::copy_n(from.high_.data() + first, count, high_.data() + to);
  std::copy_n(from.low_.data() + first, count, low_.data() + to);
}

void FilmSums::clear(std::size_t first, std::size_t count) {
  std::fill_n(high_.data() + first, count, 0.0);
  std::fill_n(low_.data() + first, count, 0.0f);
}

}  // namespace tyndall
