/// Emissive surfaces, by the pixels whose filters see a part of them.
///
/// Where an emitter ends within a pixel one of the filter's samples hits it and the next does not: in a picture of bright
/// emitters that is most of the noise. Such a pixel therefore draws film positions on its emitters' images instead
/// (visible_emitters.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "transport/pixel/film_search.h"
#include "transport/pixel/filter_cells.h"
#include "tyndall/image.h"

namespace tyndall {

/// A primitive of an emissive shape.
struct FilmEmitter {
  std::uint32_t shape, primitive;  ///< of Geometry::placed()
  float share;                     ///< probability that its pixel draws it

  LightId light(const BuiltWorld& world) const { return world.first_light[shape] + primitive; }
};

/// The emitters that a pixel draws: all of the directly visible emission of these, and of no other, is found that way where
/// their images hold the ray.
struct PixelEmitters {
  std::span<const FilmEmitter> emitters;  ///< shares add up to 1
  int positions = 0;                      ///< film positions a sample
  const FilterCells* cells = nullptr;     ///< by which they are drawn; outlive this

  bool empty() const { return emitters.empty(); }
  /// One by its share; `u` in [0, 1) is made anew of what is left of it. Not when empty.
  const FilmEmitter& draw(float& u) const;
};

/// The camera's own ray, which counts nothing of what is drawn instead.
class DrawnEmission {
 public:
  /// `lens`: in the unit disk. What is referred to outlives this.
  DrawnEmission(const PixelEmitters& emitters, Vec2 film, Vec2 lens) : emitters_(emitters), film_(film), lens_(lens) {}
  /// Whether what it sees of a light is.
  bool holds(const BuiltWorld& world, LightId light) const;

 private:
  const PixelEmitters& emitters_;
  Vec2 film_, lens_;
};

class FilmEmitters {
 public:
  /// In the picture. More would take seconds to process, and are triangles of larger things rather than bulbs.
  static constexpr std::size_t kMostSeen = 1'000'000;
  /// Of a frame that a lens blurs, entries of all lists for each of its pixels. Emitters that add the least noise for each of
  /// theirs are left to the filter.
  static constexpr double kMostBlurred = 8;

  FilmEmitters() = default;
  /// Of the pixels that are rendered: none where settings or the camera rule it out, or no emitter ends in any.
  explicit FilmEmitters(const FilmSearch& search);
  PixelEmitters of(int x, int y) const;

 private:
  PixelBounds pixels_;
  std::vector<std::uint32_t> begin_;     ///< of each pixel's emitters, and the end of the last's; empty without any
  std::vector<std::uint8_t> positions_;  ///< by pixel, likewise
  std::vector<FilmEmitter> emitters_;
  std::optional<FilterCells> cells_;
};

}  // namespace tyndall
