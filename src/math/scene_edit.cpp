#include "tyndall/scene_edit.h"

#include <utility>

namespace tyndall {
namespace {

template <typename Named>
std::optional<std::uint32_t> find_named(const std::vector<Named>& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return static_cast<std::uint32_t>(i);
  return std::nullopt;
}

template <typename Named>
void require_new(const std::vector<Named>& list, const std::string& what, const std::string& name) {
  if (name.empty() || !find_named(list, name)) return;
  throw Error(Failure::usage, "a " + what + " \"" + name + "\" is there already; choose another name");
}

template <typename Named>
std::uint32_t require_named(const std::vector<Named>& list, const std::string& what, std::string_view name) {
  if (const auto found = name.empty() ? std::nullopt : find_named(list, name)) return *found;
  std::string known;
  for (const Named& n : list)
    if (!n.name.empty()) known += (known.empty() ? "" : ", ") + n.name;
  throw Error(Failure::usage, "no " + what + " is called \"" + std::string(name) + "\"; " +
                                  (known.empty() ? "none has a name" : "choose from " + known));
}

/// The faces of a box, seen from outside counter-clockwise; corners as Bounds3::corner numbers them.
TriangleMesh box_mesh(const Bounds3& bounds) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(bounds.corner(i));
  mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return mesh;
}

}  // namespace

MediumId add_medium(Scene& scene, Medium medium, const Bounds3& bounds) {
  require_new(scene.media, "medium", medium.name);
  const Vec3 extent = bounds.extent();
  if (!(extent.x > 0 && extent.y > 0 && extent.z > 0))
    throw Error(Failure::usage, "the box of a medium has no volume; move its corners apart");
  Shape box{.kind = box_mesh(bounds), .to_world = medium.to_world, .where = medium.where};
  const auto id = static_cast<MediumId>(scene.media.size());
  scene.media.push_back(std::move(medium));
  box.boundary = static_cast<BoundaryId>(scene.boundaries.size());
  scene.boundaries.push_back({.inside = id, .outside = {}});
  box.material = static_cast<MaterialId>(scene.materials.size());
  scene.materials.push_back({InterfaceMaterial{}, "", box.where});
  scene.shapes.push_back(std::move(box));
  return id;
}

MediumId medium_named(const Scene& scene, std::string_view name) { return require_named(scene.media, "medium", name); }

MaterialId add_diffuse_material(Scene& scene, std::string name, Rgb reflectance) {
  require_new(scene.materials, "material", name);
  const auto texture = static_cast<TextureId>(scene.textures.size());
  scene.textures.push_back({ConstantTexture{reflectance}, {}});
  scene.materials.push_back({DiffuseMaterial{.reflectance = texture}, std::move(name), {}});
  return static_cast<MaterialId>(scene.materials.size() - 1);
}

MaterialId material_named(const Scene& scene, std::string_view name) {
  return require_named(scene.materials, "material", name);
}

}  // namespace tyndall
