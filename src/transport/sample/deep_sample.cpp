#include "transport/sample/deep_sample.h"

#include <algorithm>
#include <cmath>

#include "transport/media/transmittance_walk.h"
#include "volume/homogeneous.h"

namespace tyndall {
namespace {

/// Of light whose place is told by what the others leave: smaller parts of it are their rounding.
constexpr float kRounding = 1e-5f;

float largest(Rgb c) { return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)}); }

}  // namespace

void DeepSample::meet(const Ray& ray, const Trace& trace) {
  z0_ = camera_.depth(ray.o);
  dz_ = camera_.depth(ray.o + ray.d) - z0_;
  hit_ = trace.hit.has_value();
  z_end_ = hit_ ? camera_.depth(trace.hit->p) : kInfinity;
}

/// Of unbounded media up to infinity, where nothing is left.
void DeepSample::see_through(const LightContext& context, const Span& span) {
  if (span.empty()) return;
  opacity_.assign(static_cast<std::size_t>(bins_.count()) + 2, 0.0f);
  TransmittanceWalk walk(span_method(context), span, context.sampler.side_stream(), context.counters.tracking);
  const int first = bins_.bin_of(depth_at(span.parts.front().t0));
  for (int bin = first; bin <= bins_.count() + 1; ++bin) {
    const float edge = distance_to(bins_.edge(bin + 1));
    const bool last = !(edge < span.parts.back().t1);
    const float T = mean(walk.to(last ? span.parts.back().t1 : edge));
    opacity_[static_cast<std::size_t>(bin)] = passing_ - T;
    passing_ = T;
    if (last) return;
  }
}

void DeepSample::scattered_at(float z, Rgb light) {
  if (!is_black(light)) scattered_.push_back({z, light});
}

void DeepSample::settle(Rgb factor) {
  for (const Piece& piece : estimates_) scattered_at(piece.z, factor * piece.light);
  estimates_.clear();
}

void DeepSample::begin_emission(const SpanPart& part, Rgb factor) {
  emission_factor_ = factor;
  if (!all_homogeneous(part.view())) return;
  const UniformOptics media = sum_of(part.view());
  float t = part.t0;
  for (int bin = bins_.bin_of(depth_at(t)); bin <= bins_.count() + 1 && t < part.t1; ++bin) {
    const float end = std::min(std::max(distance_to(bins_.edge(bin + 1)), t), part.t1);
    const Rgb light = media.transmittance(double{t} - part.t0) * media.emitted(double{end} - t);
    if (!is_black(light)) emitted_.push_back({bins_.edge(bin), factor * light});
    t = end;
  }
}

void DeepSample::emitted(float t, Rgb light) {
  if (!is_black(light)) emitted_.push_back({depth_at(t), emission_factor_ * light});
}

void DeepSample::from_surface(float z, Rgb light) {
  if (!is_black(light)) surfaces_.push_back({z, light});
}

void DeepSample::scale(float s) {
  for (auto* pieces : {&scattered_, &emitted_, &surfaces_}) {
    for (Piece& piece : *pieces) piece.light *= s;
  }
}

float DeepSample::alpha() const { return hit_ ? 1.0f : 1 - passing_; }

/// What is left of `whole`; nothing where that is but the rounding of the pieces.
Rgb DeepSample::rest(Rgb whole, std::initializer_list<const Pieces*> pieces) {
  Rgb left = whole;
  for (const Pieces* some : pieces) {
    for (const Piece& piece : *some) left += piece.light * -1.0f;
  }
  return largest(left) <= kRounding * largest(whole) ? Rgb() : left;
}

DeepSample::Part DeepSample::at_end(Rgb light) const {
  Part part = hit_ ? on_surface(z_end_, light) : Part{bins_.surface_key(kInfinity), light, 0, 0, 0};
  if (hit_) part.opacity = passing_;
  return part;
}

std::vector<DeepSample::Part> DeepSample::parts(const PathRecord& record) const {
  std::vector<Part> parts;
  for (std::size_t bin = 0; bin < opacity_.size(); ++bin) {
    if (opacity_[bin] != 0) parts.push_back({bins_.media_key(static_cast<int>(bin)), {}, opacity_[bin], 0, 0});
  }
  for (const Pieces* pieces : {&scattered_, &emitted_}) {
    for (const Piece& piece : *pieces) parts.push_back(in_media(piece.z, piece.light));
  }
  for (const Piece& piece : surfaces_) parts.push_back(on_surface(piece.z, piece.light));
  const Rgb by_media = rest(record.volume_direct + record.volume_indirect, {&scattered_});
  if (!is_black(by_media)) parts.push_back(in_media(record.z_volume, by_media));
  const Rgb end = rest(record.surface_direct + record.surface_indirect + record.emission, {&emitted_, &surfaces_});
  if (hit_ || !is_black(end)) parts.push_back(at_end(end));
  return parts;
}

}  // namespace tyndall
