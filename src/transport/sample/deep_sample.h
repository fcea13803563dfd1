/// The light of one sample, and what hides what is behind, by depth.
#pragma once

#include <initializer_list>
#include <vector>

#include "transport/media/span.h"
#include "transport/sample/depth_bins.h"
#include "transport/sample/light_context.h"
#include "transport/sample/path_record.h"

namespace tyndall {

/// Kept beside a path's record, which does not know of it: LightContext::deep points to it where a deep image is made.
///
/// Light belongs where its path scatters first, or where it is emitted if it does not scatter. Of most the record tells where
/// that is: at the surface behind the media, or at the path's collision. Estimators that find light elsewhere along the
/// camera's ray say so.
class DeepSample : public EmissionSink {
 public:
  DeepSample(const DepthBins& bins, const CameraRays& camera) : bins_(bins), camera_(camera) {}

  /// Of the path's own ray: where it ends, and what media before that hide.
  void meet(const Ray& ray, const Trace& trace);
  void see_through(const LightContext& context, const Span& span);

  /// Light that media scatter at `t` along that ray. Of an estimate: in its unit, until settle() is told the factor.
  void scattered(float t, Rgb light) { scattered_at(depth_at(t), light); }
  void scattered_at(float z, Rgb light);
  void estimate(float t, Rgb light) { estimates_.push_back({depth_at(t), light}); }
  void settle(Rgb factor);
  /// Light that media of a part of its span emit comes next, to be multiplied by `factor`. Of homogeneous media all is known.
  void begin_emission(const SpanPart& part, Rgb factor);
  void emitted(float t, Rgb light) override;
  /// Light that a surface sends at depth `z`.
  void from_surface(float z, Rgb light);

  void scale(float s);

  /// One key's share of the sample.
  struct Part {
    std::uint32_t key;
    Rgb light;
    float opacity;   ///< of all that is behind the camera, this hides: mean of the channels
    float z, count;  ///< of a surface its depth and 1
  };
  /// Of the ended path, its record not yet in the user's units; all light of the record is in one of them.
  std::vector<Part> parts(const PathRecord& record) const;
  /// Of what is behind the camera, all that is hidden.
  float alpha() const;

 private:
  struct Piece {
    float z;
    Rgb light;
  };
  using Pieces = std::vector<Piece>;
  float depth_at(float t) const { return z0_ + t * dz_; }
  float distance_to(float z) const { return dz_ > 0 ? (z - z0_) / dz_ : kInfinity; }
  static Rgb rest(Rgb whole, std::initializer_list<const Pieces*> pieces);
  Part in_media(float z, Rgb light) const { return {bins_.media_key(bins_.bin_of(z)), light, 0, 0, 0}; }
  Part on_surface(float z, Rgb light) const { return {bins_.surface_key(z), light, 0, z, 1}; }
  Part at_end(Rgb light) const;

  const DepthBins& bins_;
  const CameraRays& camera_;
  float z0_ = 0, dz_ = 0;  ///< depth at the ray's origin, and how it grows
  float z_end_ = 0;
  bool hit_ = true;             ///< with no ray that leaves the camera: by what stops it
  float passing_ = 1;           ///< transmittance up to the ray's end, mean of the channels
  std::vector<float> opacity_;  ///< of media, by bin; empty: there are none
  Pieces scattered_, emitted_, surfaces_, estimates_;
  Rgb emission_factor_{1.0f};
};

}  // namespace tyndall
