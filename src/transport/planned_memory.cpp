#include "transport/planned_memory.h"

#include <set>
#include <string>
#include <utility>

#include "light/cell_densities.h"
#include "light/instance_runs.h"
#include "texture/mip_map.h"
#include "transport/pixel/film_emitters.h"
#include "tyndall/error.h"
#include "tyndall/frames.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

// Bytes a primitive, from scenes of a million of each, rounded up.
constexpr std::size_t kTriangle = 130;          // positions, and the ray tracing library's tree while it is built
constexpr std::size_t kBoundaryTriangle = 300;  // kept in a tree of its own as well
constexpr std::size_t kInstance = 300;
constexpr std::size_t kLight = 200;           // with its share of the light tree while it is built
constexpr std::size_t kLightInstance = 1000;  // all lights of an instance that shares them
constexpr std::size_t kTexel = 16, kTexelOfMipMap = 22, kTexelWhileRead = 20, kTexelOfSky = 53;
constexpr std::size_t kDenseVoxel = 12;  // values, and the bricks made of them

void add_shapes(const std::vector<Shape>& shapes, ByteCount& geometry) {
  for (const Shape& shape : shapes)
    geometry.add(static_cast<double>(primitives_of(shape)),
                 static_cast<double>(shape.boundary ? kBoundaryTriangle : kTriangle));
}

double emitters_of(const std::vector<Shape>& shapes) {
  double count = 0;
  for (const Shape& shape : shapes) count += shape.emission ? static_cast<double>(primitives_of(shape)) : 0;
  return count;
}

std::vector<double> emitters_of(const std::vector<Object>& objects) {
  std::vector<double> counts;
  for (const Object& object : objects) counts.push_back(emitters_of(object.shapes));
  return counts;
}

/// Those of instances are as many as there are instances.
double emissive_surfaces_of(const Scene& scene) {
  const std::vector<double> of_object = emitters_of(scene.objects);
  double surfaces = emitters_of(scene.shapes);
  for (const Instance& instance : scene.instances) {
    if (instance.object < of_object.size()) surfaces += of_object[instance.object];
  }
  return surfaces;
}

/// The lists of pixels that emissive surfaces end in (film_emitters.h). A surface of about a pixel is in the lists of those
/// whose filters cover it.
std::size_t plan_film_search(const Scene& scene) {
  const double radius = std::max(scene.filter.radius.x, scene.filter.radius.y);
  const double surfaces = emissive_surfaces_of(scene);
  if (surfaces == 0 || !is_narrow(scene.filter)) return 0;
  const double pixels = pixels_of(scene), pixels_of_surface = (4 * radius + 1) * (4 * radius + 1);
  const double seen = std::min(surfaces, double{FilmEmitters::kMostSeen});
  const double frame = static_cast<double>(scene.film.width) * static_cast<double>(scene.film.height);
  const double blurred = std::min(seen * pixels, FilmEmitters::kMostBlurred * frame);
  const double listed = scene.camera.lens_radius > 0 ? blurred : seen * pixels_of_surface;
  ByteCount sum;
  sum.add(pixels, 2 * (sizeof(std::uint32_t) + 1));
  sum.add(listed, 2 * sizeof(FilmEmitter));
  return sum.bytes();
}

/// `shared`: instances that can share their lights do, as in shared_runs().
std::size_t plan_lights(const Scene& scene, bool shared) {
  ByteCount sum;
  sum.add(static_cast<double>(scene.lights.size()) + emitters_of(scene.shapes), kLight);
  const std::vector<double> of_object = emitters_of(scene.objects);
  if (shared)
    for (const double lights : of_object) sum.add(lights, kLight);
  for (const Instance& instance : scene.instances) {
    if (instance.object >= of_object.size()) continue;
    const double lights = of_object[instance.object];
    const bool shares = shared && lights >= kFewestShared && Similarity::of(instance.to_world);
    sum.add(shares ? 1 : lights, shares ? kLightInstance : kLight);
  }
  return sum.bytes();
}

/// Media that emit are not counted among the lights.
std::size_t plan_cells(const Scene& scene) {
  return CellDensities::most_bytes(static_cast<double>(scene.lights.size()) + emissive_surfaces_of(scene));
}

std::size_t plan_geometry(const Scene& scene) {
  ByteCount sum;
  add_shapes(scene.shapes, sum);
  for (const Object& object : scene.objects) add_shapes(object.shapes, sum);
  sum.add(static_cast<double>(scene.instances.size()), kInstance);
  return sum.bytes();
}

class Pictures {
 public:
  explicit Pictures(KeptFiles* kept) : kept_(kept) {}

  void add(const std::string& path, std::size_t bytes_a_texel) {
    if (path.empty() || !seen_.insert(path).second) return;
    ImageSize size;
    try {
      size = *get_kept<ImageSize>(kept_, {path, "size"}, [&] { return read_image_size(path); });
    } catch (const Error&) {
      return;  // the reader will report it, with its place in the scene
    }
    const double texels = static_cast<double>(size.width) * size.height;
    sum_.add(texels, static_cast<double>(bytes_a_texel));
    largest_ = std::max(largest_, texels);
  }
  std::size_t bytes() {
    sum_.add(std::exchange(largest_, 0.0), kTexelWhileRead);
    return sum_.bytes();
  }

 private:
  KeptFiles* kept_;
  std::set<std::string> seen_;
  ByteCount sum_;
  double largest_ = 0;
};

void add_pictures(const std::vector<Shape>& shapes, Pictures& pictures) {
  for (const Shape& shape : shapes)
    if (shape.emission) pictures.add(shape.emission->path, kTexel);
}

std::size_t plan_pictures(const Scene& scene, KeptFiles* kept) {
  Pictures pictures(kept);
  for (const bool mip_mapped : {true, false}) {
    for (const Texture& texture : scene.textures) {
      const auto* image = std::get_if<ImageTexture>(&texture.kind);
      if (image && is_mip_mapped(*image) == mip_mapped) pictures.add(image->path, mip_mapped ? kTexelOfMipMap : kTexel);
    }
  }
  for (const Light& light : scene.lights) {
    if (const auto* sky = std::get_if<InfiniteLight>(&light.kind)) pictures.add(sky->path, kTexelOfSky);
    if (const auto* projection = std::get_if<ProjectionLight>(&light.kind)) pictures.add(projection->path, kTexel);
  }
  add_pictures(scene.shapes, pictures);
  for (const Object& object : scene.objects) add_pictures(object.shapes, pictures);
  return pictures.bytes();
}

std::size_t plan_volumes(const Scene& scene) {
  ByteCount sum;
  for (const Medium& medium : scene.media) {
    if (const auto* grid = std::get_if<UniformGridMedium>(&medium.kind))
      sum.add(static_cast<double>(grid->density.size() + grid->Le_scale.size() + grid->temperature.size()), kDenseVoxel);
    if (const auto* grid = std::get_if<RgbGridMedium>(&medium.kind))
      sum.add(3.0 * static_cast<double>(grid->sigma_a.size() + grid->sigma_s.size() + grid->Le.size()), kDenseVoxel);
  }
  return sum.bytes();
}

}  // namespace

double pixels_of(const Scene& scene) {
  const PixelBounds& crop = scene.settings.crop.value_or(scene.film.crop);
  return static_cast<double>(std::max(crop.width(), 0)) * std::max(crop.height(), 0);
}

PlannedMemory plan_built_world(const Scene& scene, std::span<const LightStrategy> lights, KeptFiles* kept) {
  const bool shared = std::all_of(lights.begin(), lights.end(), [](LightStrategy s) { return s == LightStrategy::tree; });
  const bool cells = std::find(lights.begin(), lights.end(), LightStrategy::cells) != lights.end();
  return {.on_film = plan_film_search(scene),
          .geometry = plan_geometry(scene),
          .lights = plan_lights(scene, shared) + (cells ? plan_cells(scene) : 0),
          .textures = plan_pictures(scene, kept),
          .volumes = plan_volumes(scene)};
}

}  // namespace tyndall
