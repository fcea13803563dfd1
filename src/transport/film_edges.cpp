#include "transport/film_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

/// Relative to the brighter of two pixels: more than shading varies, less than another light does.
constexpr float kLeastContrast = 0.1f;

}  // namespace

PixelBounds FilmEdges::View::around() const {
  const int x = static_cast<int>(std::ceil(filter_radius.x)), y = static_cast<int>(std::ceil(filter_radius.y));
  return {pixels.x0 - x, pixels.y0 - y, pixels.x1 + x, pixels.y1 + y};
}

FilmEdges::FilmEdges(const View& view, const std::vector<float>& brightness) : pixels_(view.pixels) {
  if (std::all_of(brightness.begin(), brightness.end(), [](float b) { return b == 0; })) return;
  const PixelBounds all = view.around();
  const int to_side = pixels_.x0 - all.x0, to_top = pixels_.y0 - all.y0;
  // By columns and then across them: reads go as the sides of what a filter sees, not as its area.
  const auto columns_around = [&](int y) {
    std::vector<Contrast> columns;
    for (int x = all.x0; x < all.x1; ++x) {
      Contrast& column = columns.emplace_back();
      for (int j = y - to_top; j <= y + to_top; ++j) column.add({brightness[all.index(x, j)], brightness[all.index(x, j)]});
    }
    return columns;
  };
  std::vector<bool> edges;
  for (int y = pixels_.y0; y < pixels_.y1; ++y) {
    const auto columns = columns_around(y);
    for (auto from = columns.begin(); from + 2 * to_side != columns.end(); ++from) {
      Contrast contrast;
      std::for_each(from, from + 2 * to_side + 1, [&](const Contrast& column) { contrast.add(column); });
      edges.push_back(contrast.is_edge());
    }
  }
  if (std::find(edges.begin(), edges.end(), true) != edges.end()) edges_ = std::move(edges);
}

bool Contrast::is_edge() const { return most - least > kLeastContrast * most; }

void FilmEdges::add(const View& view, const std::vector<char>& edges) {
  if (std::all_of(edges.begin(), edges.end(), [](char e) { return e == 0; })) return;
  pixels_ = view.pixels;
  edges_.resize(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) edges_[i] = edges_[i] || edges[i];
}

}  // namespace tyndall
