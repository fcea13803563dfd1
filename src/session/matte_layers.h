/// Names of objects, materials and media of a world, and the ids that mattes know them by.
#pragma once

#include <string>
#include <vector>

#include "session/aov.h"
#include "session/film_buffer.h"
#include "transport/sample/camera_matte.h"
#include "transport/world/built_world.h"
#include "tyndall/cryptomatte.h"

namespace tyndall {

/// Of the layers that are asked for. An object is called by the name of its shape, else of the Object that the shape is in,
/// else "shape.N", the N-th of the scene; a material and a medium by their names, else "material.N" and "medium.N". What of a
/// name is no UTF-8 becomes U+FFFD.
class MatteLayers {
 public:
  MatteLayers(const BuiltWorld& world, const std::vector<Aov>& aovs);

  bool empty() const { return layers_.empty(); }
  /// What a sample's camera ray sees: its surface with the coverage that media leave of it, each medium with its own.
  void add(FilmBuffer& film, const FilmBuffer::SamplePlace& at, const CameraMatte& matte, float weight) const;
  /// Adds to the header what it says of them.
  void describe(Image& image) const;
  /// Changes where any name does.
  std::string identity() const;

 private:
  struct Layer {
    Aov aov;
    MatteNames names;                ///< in the order of what they are names of
    std::vector<std::size_t> index;  ///< into names, by placed shape or medium
  };

  const BuiltWorld& world_;
  std::vector<Layer> layers_;
};

}  // namespace tyndall
