/// Every light of a scene: choose one for a point, sample a direction toward it, and evaluate the densities of both.
///
/// The three steps of next-event estimation are a selector's `select` (pmf), `sample` (pdf, 1/sr) and the caller's
/// shadow ray. For a scattered ray that finds a light by itself, the selector's `pmf` and `pdf` (or `environment_pdf`)
/// give the probabilities with which the first two steps would have found the same.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "light/light_place.h"
#include "light/selection.h"
#include "light/volume_emitter.h"
#include "tyndall/math.h"
#include "tyndall/scene.h"
#include "tyndall/settings.h"

namespace tyndall {

class KeptFiles;  // tyndall/frames.h
class Textures;

struct LightSample {
  Vec3 wi;                          ///< unit, toward the light
  float distance;                   ///< infinity for distant and infinite lights
  Rgb L;                            ///< radiance that arrives when nothing is in between; delta lights: irradiance facing them
  float pdf;                        ///< 1/sr; 1 for delta lights
  bool delta;                       ///< no scattered ray can find it
  std::optional<LightId> volume{};  ///< a point of a medium that emits, of this light: it counts if the medium is there
};

/// What the render side knows of an emissive primitive that its ray hit.
struct EmitterHit {
  Vec3 p;
  Vec3 ng;  ///< unit, as the geometry orients it; one-sided lights emit on its side
  Vec2 uv;
  float distance;  ///< from the query point
};

/// An emissive shape as placed in the world. `to_world` is the whole transform, an instance's included.
struct EmitterShape {
  const Shape* shape;
  Transform to_world;
  const Instance* instance = nullptr;  ///< whose shape it is; those of one instance follow each other
};

/// Triangles or patches of a mesh; 1 of other shapes.
std::size_t primitives_of(const Shape& shape);

struct LightBuildOptions {
  std::vector<LightStrategy> strategies{LightStrategy::tree};  ///< a selector is built for each
  const Textures* textures = nullptr;        ///< read for the alpha of emissive shapes; null: opaque. Must outlive the lights
  int threads = 0;                           ///< to build with; 0: one a core
  std::span<const VolumeEmitter> volumes{};  ///< pieces of media that emit; their ids are consecutive
  KeptFiles* kept = nullptr;                 ///< images and profiles are taken from it
};

/// For the summary of a build.
struct LightStats {
  std::size_t lights = 0, emitters = 0, infinite = 0;  ///< all; primitives of emissive shapes; environments
  std::size_t shared = 0;                              ///< of the primitives, those that instances of an object share
  std::size_t points = 0;                              ///< lights without extent, those at infinity included
  std::size_t dark = 0;                                ///< lights without power, which are never chosen
  double power = 0;                                    ///< W, mean of the channels, all lights
};

/// What a selector costs.
struct SelectorStats {
  LightStrategy strategy = LightStrategy::tree;
  double seconds = 0;  ///< to build
  std::size_t memory_bytes = 0;
};

/// Immutable after build_lights; every query may be made from any number of threads.
class Lights {
 public:
  struct Parts;
  Lights();  ///< no lights
  explicit Lights(std::unique_ptr<const Parts> parts);
  ~Lights();
  Lights(Lights&&) noexcept;
  Lights& operator=(Lights&&) noexcept;

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  /// How many lights sample() gives anything of: not of even skies, which are left to scattered rays; with or
  /// without media that emit.
  std::size_t sought(bool with_volumes = true) const;
  /// Throws Error (usage) for a strategy that the lights were not built with. `with_volumes`: media that emit are chosen too.
  const LightSelector& selector(LightStrategy strategy, bool with_volumes = true) const;
  std::span<const SelectorStats> selectors() const;  ///< in the order asked for

  /// A direction from `p` toward the light. Nothing when it cannot contribute there, and for volumes: theirs need the medium.
  /// Environments are sampled by what exceeds their mean (Environment::sample): the rest is left to scattered rays.
  std::optional<LightSample> sample(LightId light, Vec3 p, Vec2 u) const;
  /// 1/sr: density with which sample() at `p` gives the direction of `hit`. 0 for lights without a surface.
  float pdf(LightId light, Vec3 p, const EmitterHit& hit) const;
  /// Radiance that leaves the emitter at `hit` along `wo`. Opacity is not in it: a hit has passed that test.
  Rgb emitted(LightId light, const EmitterHit& hit, Vec3 wo) const;

  /// Narrow sources at infinity, the brightest first: distant lights, and suns of maps. And, in fluence, what else comes from
  /// infinity but through portals.
  struct Far {
    std::vector<FarCone> suns;
    float rest = 0;
  };
  const Far& far() const;

  std::span<const LightId> infinite() const;             ///< lights that rays leaving the scene see
  Rgb environment(LightId light, const Ray& ray) const;  ///< radiance arriving at the ray's origin from its direction
  /// 1/sr, of sample() at the ray's origin giving its direction.
  float environment_pdf(LightId light, const Ray& ray) const;

  /// The light that is primitive 0 of the emitter shape (in the order given to build_lights); primitive i follows at +i.
  LightId first_light(std::size_t emitter_shape) const;
  /// The light that is the first of LightBuildOptions::volumes, the others follow.
  LightId first_volume() const;
  double power(LightId light) const;  ///< W, mean of the channels
  LightPlace place(LightId light) const;
  /// Position of a light without extent that has one: point, spot, goniometric, projection; nothing for any other. The scene's
  /// light sources, these among them, are the first.
  std::optional<Vec3> point(LightId light) const;
  /// Encloses all lights of surfaces and points, and portals; empty where all are at infinity. Media that emit are not in it.
  const Bounds3& near_box() const;
  double near_power() const;         ///< W, of all that are not at infinity
  const Bounds3& point_box() const;  ///< of those that have a point() alone
  const LightStats& stats() const;
  std::size_t memory_bytes() const;  ///< selectors included

 private:
  std::unique_ptr<const Parts> parts_;
};

/// `shapes` are the placed shapes that have `emission`, `scene_bounds` encloses everything that can be hit. Instances of
/// one object share its lights' geometry and their part of the light tree, see instance_runs.h for which.
/// Copies what it needs of the scene. Throws Error (scene) when an image cannot be read or used.
Lights build_lights(const Scene& scene, std::span<const EmitterShape> shapes, const Bounds3& scene_bounds,
                    const LightBuildOptions& options = {});

}  // namespace tyndall
