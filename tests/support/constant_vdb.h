/// A .vdb file of density 1 in a box, for as long as the object lives.
#pragma once

#include <string>

#include "tyndall/math.h"

namespace tyndall::test {

class ConstantVdb {
 public:
  /// Voxels of side `voxel` centred within `bounds`; a dense float grid called "density", background 0.
  ConstantVdb(const Bounds3& bounds, float voxel);
  ~ConstantVdb();
  ConstantVdb(const ConstantVdb&) = delete;
  ConstantVdb& operator=(const ConstantVdb&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace tyndall::test
