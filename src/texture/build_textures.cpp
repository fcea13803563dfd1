#include <map>

#include "math/cie.h"
#include "texture/textures.h"
#include "tyndall/error.h"
#include "tyndall/frames.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

std::vector<TextureId> inputs(const Texture& texture) {
  if (const auto* t = std::get_if<ScaleTexture>(&texture.kind)) return {t->texture, t->scale};
  if (const auto* t = std::get_if<MixTexture>(&texture.kind)) return {t->first, t->second, t->amount};
  if (const auto* t = std::get_if<CheckerboardTexture>(&texture.kind)) return {t->first, t->second};
  if (const auto* t = std::get_if<DotsTexture>(&texture.kind)) return {t->inside, t->outside};
  if (const auto* t = std::get_if<DirectionMixTexture>(&texture.kind)) return {t->first, t->second};
  return {};
}

/// Inputs before the textures that use them; refuses unknown and circular references. Iterative: chains may be long.
std::vector<TextureId> evaluation_order(const std::vector<Texture>& textures) {
  enum class State { unseen, open, done };
  std::vector<State> state(textures.size(), State::unseen);
  std::vector<TextureId> order, stack;
  for (TextureId root = 0; root < textures.size(); ++root) {
    stack.push_back(root);
    while (!stack.empty()) {
      const TextureId id = stack.back();
      if (state[id] != State::unseen) {
        if (state[id] == State::open) order.push_back(id);
        state[id] = State::done;
        stack.pop_back();
        continue;
      }
      state[id] = State::open;
      for (TextureId input : inputs(textures[id])) {
        if (input >= textures.size())
          throw Error(textures[id].where, "texture refers to number " + std::to_string(input) + " of " +
                                              std::to_string(textures.size()) + "; refer to an existing texture");
        if (state[input] == State::open)
          throw Error(textures[id].where, "texture refers to itself through its inputs; break the circle");
        if (state[input] == State::unseen) stack.push_back(input);
      }
    }
  }
  return order;
}

bool asks_for_footprint(const Texture& texture) {
  const auto* image = std::get_if<ImageTexture>(&texture.kind);
  return image ? is_mip_mapped(*image) : std::holds_alternative<NoiseTexture>(texture.kind);
}

}  // namespace

class Textures::Builder {
 public:
  Builder(const std::vector<Texture>& textures, KeptFiles* kept) : textures_(textures), kept_(kept) {
    result_.nodes_.resize(textures.size());
    result_.uses_footprint_.resize(textures.size());
  }

  Textures build() {
    for (TextureId id : evaluation_order(textures_)) {
      result_.nodes_[id] = make_node(textures_[id]);
      result_.uses_footprint_[id] = asks_for_footprint(textures_[id]);
      for (const TextureId input : inputs(textures_[id]))
        if (result_.uses_footprint_[input]) result_.uses_footprint_[id] = true;
      if (foldable(id)) result_.nodes_[id] = ConstantTexture{result_.eval(id, {})};
    }
    return std::move(result_);
  }

 private:
  /// Loaded images by path and encoding, with the matrix that the file's chromaticities give.
  struct Loaded {
    std::size_t index;
    std::optional<std::array<float, 9>> to_rec709;
  };

  Node make_node(const Texture& texture) {
    if (const auto* image = std::get_if<ImageTexture>(&texture.kind)) return image_node(*image, texture.where);
    return std::visit(
        [](const auto& kind) -> Node {
          if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, ImageTexture>)
            return ConstantTexture{};
          else
            return kind;
        },
        texture.kind);
  }

  Node image_node(const ImageTexture& texture, const Location& where) {
    // The same file may be read as colours and as numbers.
    const auto key = std::pair(texture.path, texture.encoding + (texture.is_data ? " data" : ""));
    auto found = loaded_.find(key);
    if (found == loaded_.end()) found = loaded_.emplace(key, load(texture, where)).first;
    ImageNode node{texture, found->second.index};
    if (auto& coarser = result_.coarser_[node.image]; coarser.empty() && is_mip_mapped(texture))
      coarser = coarser_levels(*result_.images_[node.image]);
    if (found->second.to_rec709) node.texture.to_rec709 = *found->second.to_rec709;
    return node;
  }

  Loaded load(const ImageTexture& texture, const Location& where) try {
    const KeptFiles::Use use{texture.path, "texture " + texture.encoding};
    const auto kept = get_kept<KeptImage>(kept_, use, [&]() -> KeptImage {
      const Image image = read_image(texture.path, texture.encoding.empty() ? "sRGB" : texture.encoding);
      return {TexelImage::from(image, texture.path), image.chromaticities};
    });
    Loaded loaded{result_.images_.size(), {}};
    if (kept->chromaticities && !texture.is_data) loaded.to_rec709 = rec709_from(*kept->chromaticities, true);
    result_.images_.emplace_back(kept, &kept->texels);
    result_.coarser_.emplace_back();
    return loaded;
  } catch (const Error& error) {
    throw Error(where, error.what());
  }

  bool foldable(TextureId id) const {
    const std::vector<TextureId> ids = inputs(textures_[id]);
    for (TextureId input : ids)
      if (!result_.is_constant(input)) return false;
    if (const auto* t = std::get_if<CheckerboardTexture>(&textures_[id].kind))
      return *result_.constant(t->first) == *result_.constant(t->second);
    if (const auto* t = std::get_if<DotsTexture>(&textures_[id].kind))
      return *result_.constant(t->inside) == *result_.constant(t->outside);
    if (const auto* t = std::get_if<DirectionMixTexture>(&textures_[id].kind))
      return *result_.constant(t->first) == *result_.constant(t->second);
    return !ids.empty();
  }

  struct KeptImage {
    TexelImage texels;
    std::optional<Chromaticities> chromaticities;
  };

  const std::vector<Texture>& textures_;
  KeptFiles* kept_;
  std::map<std::pair<std::string, std::string>, Loaded> loaded_;
  Textures result_;
};

Textures build_textures(const std::vector<Texture>& textures, KeptFiles* kept) {
  return Textures::Builder(textures, kept).build();
}

}  // namespace tyndall
