#include "render/film_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

/// Of the brighter of two pixels, that tells them apart: more than shading does, less than another lamp.
constexpr float kLeastContrast = 0.1f;

/// Of the darkest and the brightest of some pixels.
struct Contrast {
  float least = kInfinity, most = 0;
  void add(float brightness) {
    least = std::min(least, brightness);
    most = std::max(most, brightness);
  }
  bool is_edge() const { return most - least > kLeastContrast * most; }
};

}  // namespace

PixelBounds FilmEdges::View::around() const {
  const int x = static_cast<int>(std::ceil(filter_radius.x)), y = static_cast<int>(std::ceil(filter_radius.y));
  return {pixels.x0 - x, pixels.y0 - y, pixels.x1 + x, pixels.y1 + y};
}

FilmEdges::FilmEdges(const View& view, const std::vector<float>& brightness) : pixels_(view.pixels) {
  const PixelBounds all = view.around();
  const int to_side = pixels_.x0 - all.x0, to_top = pixels_.y0 - all.y0;
  const auto contrast_around = [&](int x, int y) {
    Contrast contrast;
    for (int j = y - to_top; j <= y + to_top; ++j) {
      for (int i = x - to_side; i <= x + to_side; ++i) contrast.add(brightness[all.index(i, j)]);
    }
    return contrast;
  };
  if (std::all_of(brightness.begin(), brightness.end(), [](float b) { return b == 0; })) return;
  std::vector<bool> edges;
  for (int y = pixels_.y0; y < pixels_.y1; ++y) {
    for (int x = pixels_.x0; x < pixels_.x1; ++x) edges.push_back(contrast_around(x, y).is_edge());
  }
  if (std::find(edges.begin(), edges.end(), true) != edges.end()) edges_ = std::move(edges);
}

}  // namespace tyndall
