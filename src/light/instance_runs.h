/// Which emissive shapes are instances that share what their object has.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "light/lights.h"
#include "math/similarity.h"

namespace tyndall {

/// Consecutive emissive shapes: those of one instance.
struct InstanceRun {
  std::size_t begin, end;
  Similarity to_world;
};

/// Of objects with at least this many lights; of fewer, sharing would save little and cost a transform a query.
inline constexpr std::size_t kFewestShared = 16;

/// Those that share, in order. Others are as good as shapes of the scene: instances that shear or scale unevenly, which
/// changes what matters to whom; objects that stand only once; and objects some of whose shapes are given by power
/// and others by radiance, which do not scale alike.
std::vector<InstanceRun> shared_runs(std::span<const EmitterShape> shapes);

}  // namespace tyndall
