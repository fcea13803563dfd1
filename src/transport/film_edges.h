/// Pixels that contain the outline of an emissive surface, as the camera sees it.
///
/// There one of the filter's samples hits the surface and the next does not: in a picture of bright emitters that is most of
/// the noise.
#pragma once

#include <algorithm>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/math.h"

namespace tyndall {

/// The darkest and the brightest of some places.
struct Contrast {
  float least = kInfinity, most = 0;
  void add(const Contrast& other) {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
  }
  bool is_edge() const;
};

class FilmEdges {
 public:
  struct View {
    PixelBounds pixels;
    Vec2 filter_radius;
    /// Those whose centers tell about `pixels`: some lie outside of the frame.
    PixelBounds around() const;
  };

  FilmEdges() = default;
  /// `brightness`: of the directly visible emission at the center of each pixel of `view.around()`, row by row, in any unit.
  FilmEdges(const View& view, const std::vector<float>& brightness);
  bool at(int x, int y) const { return !edges_.empty() && edges_[pixels_.index(x, y)]; }

  /// Pixels that are edges besides: those of `view.pixels` that are not 0, row by row.
  void add(const View& view, const std::vector<char>& edges);

 private:
  PixelBounds pixels_;
  std::vector<bool> edges_;  ///< empty without any
};

}  // namespace tyndall
