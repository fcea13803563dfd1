#include "session/scene_hash.h"

#include <filesystem>
#include <map>
#include <memory>

#include "math/stream_hash.h"
#include "session/scene_fields.h"
#include "tyndall/frames.h"

namespace tyndall {
namespace {

/// Values without padding whose bytes are what they mean.
template <typename T>
inline constexpr bool kPlain = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>;
template <>
inline constexpr bool kPlain<Vec2> = sizeof(Vec2) == 2 * sizeof(float);
template <>
inline constexpr bool kPlain<Vec3> = sizeof(Vec3) == 3 * sizeof(float);
template <>
inline constexpr bool kPlain<Rgb> = sizeof(Rgb) == 3 * sizeof(float);
template <typename T, std::size_t N>
inline constexpr bool kPlain<std::array<T, N>> = kPlain<T>;

std::uint64_t hash_file(const std::string& path) {
  const auto fail = [&](const std::string& what) {
    throw Error(Failure::scene, path + ": " + what + "; put it back, it is part of the scene");
  };
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) fail("is no regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail("cannot be opened any more");
  StreamHash bytes;
  std::vector<unsigned char> buffer(std::size_t{1} << 18);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) bytes.add(buffer.data(), count);
  if (std::ferror(file.get())) fail("cannot be read to its end");
  return bytes.value();
}

/// Walks the scene; every struct without an `add` of its own gives all its fields (scene_fields.h).
class SceneHasher {
 public:
  explicit SceneHasher(KeptFiles* kept) : kept_(kept) {}

  template <typename T>
  void add(const T& value) {
    if constexpr (kPlain<T>) {
      bytes_.add(&value, sizeof value);
    } else {
      std::apply([this](const auto&... field) { (this->add(field), ...); }, fields(value));
    }
  }
  std::uint64_t value() const { return bytes_.value(); }

  // Sizes, indices and presence go first, so that what follows is unambiguous.
  void add(bool value) { add(static_cast<unsigned char>(value)); }
  void add(const std::string& text) {
    add(text.size());
    bytes_.add(text.data(), text.size());
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(values.size());
    if constexpr (kPlain<T>) {
      bytes_.add(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) add(value);
    }
  }
  template <typename T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <typename... Kinds>
  void add(const std::variant<Kinds...>& value) {
    add(value.index());
    std::visit([this](const auto& kind) { this->add(kind); }, value);
  }
  void add(const Transform& transform) { add(transform.matrix()); }

  /// HG by its g alone, as when it was the only one: images of those days can still be merged.
  void add(const Phase& phase) {
    if (!std::holds_alternative<HenyeyGreenstein>(phase)) add(phase.index());
    std::visit(
        [this](const auto& kind) {
          for (const float p : kind.parameters()) this->add(p);
        },
        phase);
  }

  // Structs of which not everything counts. Each names all its fields: a new one must be given its place.
  void add(const Location&) {}
  void add(const RenderSettings&) {}  // how to render, not what; scene_hash_text adds the depth
  void add(const ImageTexture& texture) {
    const auto& [wrap, filter, max_anisotropy, path, mapping, scale, invert, encoding, to_rec709, is_data] = texture;
    add_all(wrap, filter, FileContent{path}, mapping, scale, invert, encoding, to_rec709);
    if (is_data) add(is_data);
    if (filter == ImageTexture::Filter::elliptical) add(max_anisotropy);
  }
  // What came later counts where it is used, so that images of scenes without it can still be merged.
  void add(const Material& material) {
    const auto& [kind, name, where, displacement, normal_map, displacement_scale] = material;
    add(kind);
    if (displacement || normal_map || displacement_scale != Material().displacement_scale)
      add_all(displacement, normal_map, displacement_scale);
  }
  void add(const DielectricMaterial& material) {
    const auto& [eta, roughness, eta_rgb] = material;
    add_all(eta, roughness);
    if (eta_rgb) add(eta_rgb);
  }
  void add(const VdbMedium& medium) {
    const auto& [path, density, temperature, flame, density_given, temperature_given, scale, offset, Le_scale, Le, emission] =
        medium;
    add_all(FileContent{path}, density, temperature, flame, density_given, temperature_given, scale, offset, Le_scale, Le);
  }
  void add(const Medium& medium) {
    const auto& [kind, optics, to_world, name, where, group] = medium;
    add_all(kind, optics, to_world);
    add_group(group);
  }
  void add(const Light& light) {
    const auto& [kind, where, group] = light;
    add(kind);
    add_group(group);
  }
  void add(const InfiniteLight& light) {
    const auto& [to_world, L, path, to_rec709, illuminance, portal] = light;
    add_all(to_world, L, FileContent{path}, to_rec709, illuminance);
    if (portal) add(*portal);  // images from before there were portals can still be merged
  }
  void add(const GoniometricLight& light) {
    const auto& [to_world, I, path, power] = light;
    add_all(to_world, I, FileContent{path}, power);
  }
  void add(const ProjectionLight& light) {
    const auto& [to_world, I, path, fov, power] = light;
    add_all(to_world, I, FileContent{path}, fov, power);
  }
  void add(const AreaLight& light) {
    const auto& [L, path, to_rec709, power, two_sided, group] = light;
    add_all(L, FileContent{path}, to_rec709, power, two_sided);
    add_group(group);
  }
  void add(const Shape& shape) {
    const auto& [kind, to_world, reverse_orientation, material, emission, boundary, alpha, where, name] = shape;
    add_all(kind, to_world, reverse_orientation, material, emission, boundary, alpha);
  }
  void add(const Object& object) {
    const auto& [name, shapes] = object;
    add(shapes);
  }
  void add(const Camera& camera) {
    const auto& [kind, to_world, fov, window, aspect, lens_radius, focal_distance, medium, lenses] = camera;
    add_all(kind, to_world, fov, window, aspect, lens_radius, focal_distance, medium);
    if (lenses) add(*lenses);
  }
  void add(const Film& film) {
    const auto& [width, height, crop, filename, imaging_ratio, max_component, gbuffer, from_rec709, chromaticities] = film;
    add_all(width, height, imaging_ratio, max_component, from_rec709, chromaticities);
  }
  void add(const Scene& scene) {
    const auto& [camera, film, filter, settings, textures, materials, media, boundaries, lights, shapes, objects, instances,
                 source] = scene;
    add_all(camera, film, filter, textures, materials, media, boundaries, lights, shapes, objects, instances);
  }

 private:
  /// Stands for what is in the file; "" for none.
  struct FileContent {
    const std::string& path;
  };
  void add(const FileContent& file) {
    add(!file.path.empty());
    if (file.path.empty()) return;
    const auto [entry, is_new] = files_.try_emplace(file.path, 0);
    if (is_new) entry->second = *get_kept<std::uint64_t>(kept_, {file.path, "hash"}, [&] { return hash_file(file.path); });
    add(entry->second);
  }
  /// Images whose channels are not the same do not go together.
  void add_group(const std::string& group) {
    if (!group.empty()) add(group);
  }
  template <typename... T>
  void add_all(const T&... values) {
    (add(values), ...);
  }

  KeptFiles* kept_;
  StreamHash bytes_;
  std::map<std::string, std::uint64_t> files_;  ///< by path: many textures may name one
};

}  // namespace

std::uint64_t hash_scene(const Scene& scene, KeptFiles* kept) {
  SceneHasher hasher(kept);
  hasher.add(scene);
  return hasher.value();
}

std::uint64_t hash_names(const Scene& scene) {
  StreamHash hash;
  const auto add = [&](const auto& named) {
    for (const auto& one : named) hash.add(one.name.data(), one.name.size() + 1);  // with the 0 that ends it
  };
  add(scene.shapes);
  for (const Object& object : scene.objects) add(object.shapes);
  add(scene.objects);
  add(scene.materials);
  add(scene.media);
  return hash.value();
}

std::string scene_hash_text(std::uint64_t scene_hash, const RenderSettings& settings) {
  // All settings by name, so that a new one is asked: does it change what the right picture is? Only the depth does.
  const auto& [spp, time, error, error_max, adaptive, max_depth, seed, threads, lights, candidates, shadow_rays, splitting,
               media, distance, emission, guiding, joint, reuse, budget, transmittance, aovs, deep_bins, crop, slice,
               reproducible] = settings;
  return hex_text(hash(scene_hash, static_cast<std::uint64_t>(max_depth)));
}

}  // namespace tyndall
