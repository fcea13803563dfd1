/// Participating media ready to render: coefficients at a point, and majorants along a ray for tracking.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "tyndall/math.h"
#include "tyndall/scene.h"

namespace tyndall {

class KeptFiles;  // tyndall/frames.h

/// What a medium does at a point.
struct Coefficients {
  Rgb sigma_a, sigma_s;  ///< 1/world unit
  Rgb Le;                ///< radiance scale: emission is sigma_a * Le per world unit
  Rgb sigma_t() const { return sigma_a + sigma_s; }
};

/// The same of what light passes.
struct PointOptics {
  Rgb sigma_a, sigma_s;  ///< 1/world unit
};

struct MediumBuildOptions {
  bool sanitize = false;  ///< voxels that are NaN or infinite become 0 instead of an error
  /// Bytes that a volume file may take while it is read and after; one that would take more is refused.
  std::size_t most_memory = std::numeric_limits<std::size_t>::max();
  bool float_bricks = false;  ///< keep voxels as 32-bit floats instead of 16-bit steps of each brick's range
  KeptFiles* kept = nullptr;  ///< media of files are taken from it
  double unit = 1;            ///< one length here is so many of the user's, in which messages are
};

struct MediumData;  // medium_data.h, for tracking

/// One medium. Immutable; safe to use from any number of threads. Its address may change by a move, its data's not.
class ParticipatingMedium {
 public:
  explicit ParticipatingMedium(std::shared_ptr<const MediumData> data);
  ParticipatingMedium(ParticipatingMedium&&) noexcept;
  ParticipatingMedium& operator=(ParticipatingMedium&&) noexcept;
  ~ParticipatingMedium();

  /// At world-space `p`; grids are interpolated trilinearly.
  Coefficients at(Vec3 p) const;
  /// The same without emission, whose grids are not read.
  PointOptics optics_at(Vec3 p) const;
  bool emissive() const;
  bool scatters() const;  ///< false: sigma_s is 0 everywhere
  bool homogeneous() const;
  const Phase& phase() const;
  float albedo() const;  ///< of single scattering, mean of the channels; of grids with channels where those are alike
  /// Extinction of the clearest channel over the mean of all, at least: 1 of grey media, 0 of grids with channels of their own.
  float clearest_channel() const { return clearest_channel_; }
  /// World-space box around all non-zero density: infinite for a homogeneous medium, empty for an empty grid.
  Bounds3 bounds() const;
  /// Largest extinction coefficient of any channel anywhere, 1/world unit.
  float sigma_maj() const;
  std::size_t memory_bytes() const;

  const MediumData& data() const { return *data_; }

 private:
  std::shared_ptr<const MediumData> data_;  ///< that of a file may be kept for another scene
  float clearest_channel_;
};

/// Load and prepare `medium`. Appends to `notes` what was chosen or changed ("smoke.vdb: density grid "density", ...").
/// Throws Error (scene) when a file or grid cannot be used.
ParticipatingMedium build_medium(const Medium& medium, const MediumBuildOptions& options, std::vector<std::string>& notes);

}  // namespace tyndall
