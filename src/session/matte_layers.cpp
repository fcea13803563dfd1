#include "session/matte_layers.h"

#include "math/stream_hash.h"
#include "tyndall/utf8.h"

namespace tyndall {
namespace {

std::string name_or_number(const std::string& name, const char* kind, std::size_t number) {
  return name.empty() ? kind + ("." + std::to_string(number)) : name;
}

void add_name(MatteNames& names, const std::string& name) {
  const std::string valid = valid_utf8(name);
  names.emplace_back(valid, matte_id(valid));
}

/// Nobody sees it: what has it needs no name.
bool is_invisible(const Scene& scene, MaterialId material) {
  return std::holds_alternative<InterfaceMaterial>(scene.materials[material].kind);
}

/// Names of shapes, from which place on; those of an object by its own.
class ShapeNames {
 public:
  explicit ShapeNames(const Scene& scene) : scene_(scene) {}

  std::size_t add(const Shape& shape, const std::string& otherwise) {
    if (!is_invisible(scene_, shape.material)) add_name(names, shape.name.empty() ? otherwise : shape.name);
    return names.size() - 1;
  }
  MatteNames names;

 private:
  const Scene& scene_;
};

MatteNames object_names(const Scene& scene, std::vector<std::size_t>& index) {
  ShapeNames names(scene);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    index.push_back(names.add(scene.shapes[i], name_or_number({}, "shape", i + 1)));
  std::vector<std::vector<std::size_t>> of_objects;
  for (const Object& object : scene.objects) {
    auto& places = of_objects.emplace_back();
    for (const Shape& shape : object.shapes) places.push_back(names.add(shape, object.name));
  }
  for (const Instance& instance : scene.instances)
    index.insert(index.end(), of_objects[instance.object].begin(), of_objects[instance.object].end());
  return std::move(names.names);
}

/// Material 0 is there before the scene names any.
MatteNames material_names(const BuiltWorld& world, std::vector<std::size_t>& index) {
  const auto& materials = world.scene.materials;
  MatteNames names;
  std::vector<std::size_t> of_materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!is_invisible(world.scene, static_cast<MaterialId>(i)))
      add_name(names, name_or_number(materials[i].name, "material", i));
    of_materials.push_back(names.size() - 1);
  }
  for (const PlacedShape& placed : world.geometry.placed()) index.push_back(of_materials[placed.shape->material]);
  return names;
}

MatteNames medium_names(const Scene& scene, std::vector<std::size_t>& index) {
  MatteNames names;
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    index.push_back(i);
    add_name(names, name_or_number(scene.media[i].name, "medium", i + 1));
  }
  return names;
}

}  // namespace

MatteLayers::MatteLayers(const BuiltWorld& world, const std::vector<Aov>& aovs) : world_(world) {
  for (const Aov aov : aovs) {
    if (!is_matte(aov)) continue;
    Layer& layer = layers_.emplace_back(Layer{aov, {}, {}});
    if (aov == Aov::crypto_object) layer.names = object_names(world.scene, layer.index);
    if (aov == Aov::crypto_material) layer.names = material_names(world, layer.index);
    if (aov == Aov::crypto_medium) layer.names = medium_names(world.scene, layer.index);
  }
}

void MatteLayers::add(FilmBuffer& film, const FilmBuffer::SamplePlace& at, const CameraMatte& matte, float weight) const {
  for (const Layer& layer : layers_) {
    const auto cover = [&](std::size_t of, float coverage) {
      film.add_matte(at, layer.aov, {layer.names[layer.index[of]].second, coverage}, weight);
    };
    if (layer.aov != Aov::crypto_medium) {
      if (const auto shape = matte.shape()) cover(*shape, matte.transmittance());
      continue;
    }
    for (const CameraMatte::Share& share : matte.media())
      cover(static_cast<std::size_t>(share.medium - world_.media.data()), share.opacity);
  }
}

void MatteLayers::describe(Image& image) const {
  for (const Layer& layer : layers_) describe_mattes(image, name_of_aov(layer.aov), layer.names);
}

std::string MatteLayers::identity() const {
  StreamHash hash;
  for (const Layer& layer : layers_) {
    const std::string names = manifest_text(layer.names);
    hash.add(names.data(), names.size());
  }
  return layers_.empty() ? "none" : std::to_string(hash.value());
}

}  // namespace tyndall
