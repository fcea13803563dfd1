/// The scene's textures, built once and evaluated at shading points.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "texture/mapping.h"
#include "texture/mip_map.h"
#include "texture/texel_image.h"
#include "tyndall/scene.h"

namespace tyndall {

class KeptFiles;  // tyndall/frames.h

/// Immutable after build_textures; safe to evaluate from any number of threads.
class Textures {
 public:
  Rgb eval(TextureId id, const TextureQuery& query) const;
  /// For scalar parameters (roughness, alpha, amounts): the mean of the channels; of an image that has transparency
  /// its alpha, as pbrt's float textures. The scale of a ScaleTexture and the amount of a MixTexture are scalars too.
  float eval_float(TextureId id, const TextureQuery& query) const;
  /// The value when it is the same everywhere.
  std::optional<Rgb> constant(TextureId id) const;
  bool is_constant(TextureId id) const { return constant(id).has_value(); }
  /// Its value depends on TextureQuery::footprint.
  bool uses_footprint(TextureId id) const { return uses_footprint_[id]; }
  std::size_t size() const { return nodes_.size(); }
  std::size_t image_count() const { return images_.size(); }
  std::size_t memory_bytes() const;  ///< of the images

 private:
  friend Textures build_textures(const std::vector<Texture>& textures, KeptFiles* kept);
  struct ImageNode {
    ImageTexture texture;  ///< to_rec709 replaced by the file's own where it states chromaticities
    std::size_t image;     ///< into images_
  };
  using Node = std::variant<ConstantTexture, ScaleTexture, MixTexture, ImageNode, CheckerboardTexture, DotsTexture,
                            BilerpTexture, DirectionMixTexture, NoiseTexture>;
  struct RgbEvaluator;
  struct FloatEvaluator;
  class Builder;
  MipMap mip_map(const ImageNode& node) const { return {*images_[node.image], coarser_[node.image]}; }

  std::vector<Node> nodes_;
  std::vector<bool> uses_footprint_;
  std::vector<std::shared_ptr<const TexelImage>> images_;
  std::vector<std::vector<TexelImage>> coarser_;  ///< of each image; none unless a texture's filter asks for them
};

/// Loads every image once (textures of the same path and encoding share it) and folds what is constant.
/// Images are taken from `kept` and put there.
/// Throws Error (scene) at the texture's place: an image that cannot be read, an unknown or a circular reference.
Textures build_textures(const std::vector<Texture>& textures, KeptFiles* kept = nullptr);

}  // namespace tyndall
