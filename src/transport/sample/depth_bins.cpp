#include "transport/sample/depth_bins.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tyndall {
namespace {

struct Depths {
  float near = kInfinity, far = 0;

  void add(float z) {
    near = std::min(near, std::max(z, 0.0f));
    far = std::max(far, z);
  }
};

/// Of the corners, between which depths along an axis lie; of distances from a point the nearest may be anywhere in the box.
void add_box(const CameraRays& camera, const Bounds3& box, Depths& depths) {
  for (int corner = 0; corner < 8; ++corner)
    depths.add(camera.depth(
        {(corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y, (corner & 4) ? box.max.z : box.min.z}));
  if (!camera.is_spherical()) return;
  Vec3 nearest;
  for (int k = 0; k < 3; ++k) nearest[k] = std::clamp(camera.center()[k], box.min[k], box.max[k]);
  depths.add(camera.depth(nearest));
}

bool is_finite_box(const Bounds3& box) { return is_finite(box.min) && is_finite(box.max); }

Depths depths_of_media(const BuiltWorld& world) {
  Depths depths;
  const auto unbounded = world.camera_media.unbounded();
  for (MediumId id = 0; id < world.media.size(); ++id) {
    Bounds3 box = overlap(reach_of(id, world.geometry.groups(), unbounded), world.media[id].bounds());
    if (box.empty()) continue;
    if (!is_finite_box(box)) {
      box = world.geometry.bounds();
      box.expand(world.camera.center());
    }
    add_box(world.camera, box, depths);
  }
  return depths;
}

}  // namespace

DepthBins::DepthBins(const BuiltWorld& world, int count) : near_(kInfinity), far_(kInfinity), count_(count) {
  const Depths depths = depths_of_media(world);
  if (!(depths.near < depths.far)) return;
  near_ = depths.near;
  far_ = depths.far;
}

float DepthBins::edge(int bin) const {
  if (bin <= 0) return 0;
  if (bin > count_ + 1) return kInfinity;
  if (bin == 1 || !std::isfinite(far_)) return near_;
  return bin == count_ + 1 ? far_
                           : static_cast<float>(near_ + (double{far_} - near_) * (bin - 1) / static_cast<double>(count_));
}

/// By the edges themselves, whatever rounding makes of the division.
int DepthBins::bin_of(float z) const {
  if (!(z >= near_)) return 0;
  if (z >= far_) return count_ + 1;
  int bin = 1 + std::clamp(static_cast<int>((double{z} - near_) / (double{far_} - near_) * count_), 0, count_ - 1);
  while (z < edge(bin)) --bin;
  while (z >= edge(bin + 1)) ++bin;
  return bin;
}

/// The bits of positive floats are in their order; exponent and 4 bits more are a 16th of a doubling.
std::uint32_t DepthBins::surface_key(float z) const {
  const std::uint32_t place = std::bit_cast<std::uint32_t>(std::max(z, 0.0f)) >> 19;
  return media_key(bin_of(z)) + 1 + place;
}

}  // namespace tyndall
