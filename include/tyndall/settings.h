/// How to render: every option of the command line and the Integrator line, with its default and bounds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/slice.h"

namespace tyndall {

/// How one light is chosen for next-event estimation. Methods: docs/methods.md.
enum class LightStrategy { uniform, power, exhaustive, tree, tree_binary, cycles_rule, lightcuts, cells };
/// What stands for a segment of a ray in media when its light is chosen: a tracked collision, the point of the ray closest to
/// the lights, the integral of 1/r^2 along it, or that times transmittance, scattering and phase function. `automatic`:
/// product, or vertex where BudgetStrategy::measured finds that this pays.
enum class MediaStrategy { automatic, vertex, closest, integral, product };
/// How the distance at which a ray's light is gathered is sampled: at tracked collisions, equi-angular toward the light [Kulla
/// and Fajardo 2012], both with MIS, or equi-angular times a coarse profile of the medium. `automatic`: profile, on the
/// camera's segment with tracked collisions as well; with MediaStrategy::vertex, which knows no other, tracking.
/// MediaStrategy::product then chooses lights as vertex does where they all are far from a dense segment.
enum class DistanceStrategy { automatic, tracking, equiangular, both, profile };
/// How the volume emission of media reaches what it illuminates: by scattered rays that pass through it, which surfaces guide
/// toward it (GuidingStrategy), or by next-event estimation toward it as well, with MIS: the cells of a medium that emit are
/// then lights among the others, unless it is homogeneous and unbounded. `automatic`: they are sought from a path's first
/// vertex and along the camera's segment, and left to rays after that; with MediaStrategy::product, in worlds built for it,
/// else by paths, and also where BudgetStrategy::measured finds that seeking does not pay. `lights` seeks them everywhere,
/// which takes longer.
enum class EmissionStrategy { automatic, paths, lights };
/// Where paths go from the first surface, and from later ones where media emit: as it scatters, or also toward grids and clouds
/// that scatter or emit much light, with MIS; and from collisions toward what suns spread around them in media that scatter
/// forward. `automatic`: the latter with MediaStrategy::product, the former with what stands for other programs' methods. Not
/// toward homogeneous media, and not in single scattering.
enum class GuidingStrategy { automatic, off, media };
/// Whether rays are also drawn close to point and spot lights in media, with MIS: a collision draws the next one near lights
/// that reach it, and a pinhole's pixel takes film positions near the images of those that its filter covers. The pixel also
/// aims at small emissive surfaces that it sees, in media or not. `automatic`: they are with MediaStrategy::product, and not
/// with what stands for other programs' methods. Not with LightStrategy::exhaustive.
enum class JointStrategy { automatic, off, points };
/// Whether paths of neighbouring pixels share the light that they find beyond their first bounce, weighted by MIS: where a ray
/// meets a diffuse surface after its first bounce or collides in a medium, what is scattered there, and where it leaves the
/// scene, what environments send from there, is seen by up to 64 pixels of a block of 8 x 8, whose noise is then correlated.
/// `automatic`: they do with MediaStrategy::product, and not with what stands for other programs' methods, nor with AOV
/// Replicate, which is there for filters. Never in scenes with alpha, whose surfaces let different rays through.
enum class ReuseStrategy { automatic, off, pixels };
/// How many lights are asked at a path's first vertex and along its first segment, where `candidates` and `shadow_rays` are not
/// set: fixed numbers, or those that make variance x cost least as measured in a few blocks of the picture before it is
/// rendered. Of MediaStrategy, EmissionStrategy, ReuseStrategy and GuidingStrategy what is `automatic` is then measured too,
/// and whether paths that share do so beyond collisions in grids. `automatic`: measured with MediaStrategy::product, fixed with
/// what stands for other programs' methods. Single scattering has fixed numbers.
enum class BudgetStrategy { automatic, fixed, measured };
/// Estimator of transmittance along shadow rays.
enum class TransmittanceStrategy { residual, ratio, delta, raymarch };

/// Of RenderSettings::deep_bins.
inline constexpr int kMostDeepBins = 256;

/// That can be asked for; the largest int stands for as many as a limit of time or error leaves room for.
inline constexpr int kMostSamples = 1 << 30;

/// No stop is looked for within a path.
inline constexpr int kMostBounces = 1 << 20;

/// Threads, and lights that are asked at a vertex.
inline constexpr int kMostThreads = 4096, kMostLights = 4096;

struct RenderSettings {
  int spp = 64;                  ///< samples a pixel, 1 to kMostSamples
  std::optional<double> time{};  ///< seconds; stops at the first pass end after it, if spp have not been reached before
  /// relMSE (mean of variance / (mean^2 + 0.01), from the render's own replicates) to stop below; if not `adaptive` looked at
  /// when the samples are 64, 128, 256 ...
  std::optional<double> error{};
  /// The same of the worst part of the picture, a block of 8 x 8 pixels pooled with those around it
  /// (RenderReport::worst_relmse); beside `error`, both must hold. If `adaptive`, samples go where it takes them.
  std::optional<double> error_max{};
  /// More samples where the error is, after 8 everywhere; `spp` is then the most that a pixel gets, and numbers of samples
  /// stand for the work of as many everywhere. Ends at `error` and `error_max`, looked at when they are 32, 40, 48, 56, 64, 72,
  /// 80 ..., at `time`, or at the last multiple of 8 that `spp` holds. Not of slices. Unset: in render() with `error` or
  /// `error_max`.
  std::optional<bool> adaptive{};
  int max_depth = 5;  ///< bounces a path, counted as pbrt's volpath; 0 to kMostBounces
  std::uint64_t seed = 0;
  int threads = 0;                             ///< 0: all cores, to kMostThreads
  LightStrategy lights = LightStrategy::tree;  ///< one that the World was built with
  /// Candidates at a vertex or along a segment in media, 0 to kMostLights; 0: as many as splitting makes clusters, one without
  /// a tree. Exhaustive takes all lights and traces all; lightcuts takes the cut's, at most so many, 0 or unset: 1,000. Unset:
  /// as `budget` has it, later 1 to 4.
  std::optional<int> candidates{};
  /// Of the candidates, are traced, 0 to kMostLights; 0: every one. Unset: likewise, later 1 or 2; with lightcuts all.
  std::optional<int> shadow_rays{};
  /// Clusters of the light tree that are predicted worse than this are split, in [0, 1]; 0: none, 1: down to single lights. Up
  /// to 15 clusters are made, or as many as there are candidates if those are more; with 0 candidates there is no limit. Not
  /// used by strategies without a wide tree. Unset: 0.5 where there is no limit; elsewhere, at points, what may hold a light
  /// that is so near that it deserves a candidate is split.
  std::optional<float> splitting{};
  MediaStrategy media = MediaStrategy::automatic;
  DistanceStrategy distance = DistanceStrategy::automatic;
  EmissionStrategy emission = EmissionStrategy::automatic;
  GuidingStrategy guiding = GuidingStrategy::automatic;
  JointStrategy joint = JointStrategy::automatic;
  ReuseStrategy reuse = ReuseStrategy::automatic;
  BudgetStrategy budget = BudgetStrategy::automatic;
  TransmittanceStrategy transmittance = TransmittanceStrategy::raymarch;
  std::vector<std::string> aovs{};  ///< names from aov_names()
  /// A deep image is made beside the flat one (deep_image.h), with so many bins in depth through the media, 1 to 256. A of the
  /// flat one is then what was marched, as in the deep one. Unset: none is made.
  std::optional<int> deep_bins{};
  std::optional<PixelBounds> crop{};
  /// Of the samples only these, to be merged with the other slices. `spp` are those of all slices; `time` is that of each.
  std::optional<SliceChoice> slice{};
  bool reproducible = false;  ///< leave times and dates out of the image header
};

/// A choice between methods that give the same picture: an option of the command line and of the Integrator line.
struct StrategyAxis {
  std::string_view option;              ///< "lights"
  std::string_view about;               ///< for --help
  std::vector<std::string_view> names;  ///< of the strategies, as on the command line: "tree-binary" ...
  bool (*set)(RenderSettings& settings, std::string_view name);  ///< false: no strategy has this name
  std::string_view (*get)(const RenderSettings& settings);
};
/// All of them. What lists or reads strategies goes through here, so a new row is known everywhere.
const std::vector<StrategyAxis>& strategy_axes();

std::string_view name_of(LightStrategy strategy);
std::string_view name_of(TransmittanceStrategy strategy);
/// Every AOV that `aovs` accepts: "Albedo", "N", ...
std::vector<std::string_view> aov_names();

}  // namespace tyndall
