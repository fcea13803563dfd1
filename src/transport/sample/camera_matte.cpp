#include "transport/sample/camera_matte.h"

#include <cmath>

#include "transport/media/transmittance_walk.h"

namespace tyndall {
namespace {

constexpr int kLooks = 8;

float extinction(const ParticipatingMedium& medium, Vec3 p) {
  const PointOptics c = medium.optics_at(p);
  return mean(c.sigma_a + c.sigma_s);
}

}  // namespace

void CameraMatte::meet(const Trace& trace) {
  if (trace.hit) shape_ = trace.hit->shape;
}

void CameraMatte::see_through(const LightContext& context, const Span& span) {
  if (span.empty()) return;
  Rng rng = context.sampler.side_stream();
  TransmittanceWalk walk(span_method(context), span, rng, context.counters.tracking);
  for (const SpanPart& part : span.parts) {
    const float T = mean(walk.to(part.t1));
    share(part, span.ray, transmittance_ - T, rng);
    transmittance_ = T;
  }
}

/// What a medium hides is the integral of T sigma_t, estimated by strata; of an endless part, which has one medium or uniform
/// ones, at its beginning.
void CameraMatte::share(const SpanPart& part, const Ray& ray, float opacity, Rng& rng) {
  if (part.media.size() == 1) return media_.push_back({part.media[0], opacity});
  SmallVector<double, 4> hidden;
  for (std::size_t i = 0; i < part.media.size(); ++i) hidden.push_back(0);
  const bool endless = std::isinf(part.t1);
  const double step = endless ? 0 : (double{part.t1} - part.t0) / kLooks;
  double T = 1, all = 0;
  for (int look = 0; look < (endless ? 1 : kLooks); ++look) {
    const auto t = static_cast<float>(part.t0 + step * (look + double{rng.uniform()}));
    double sigma_t = 0;
    for (const ParticipatingMedium* medium : part.media) sigma_t += double{extinction(*medium, ray.at(t))};
    const double next = T * std::exp(-sigma_t * (endless ? 1 : step));
    for (std::size_t i = 0; i < part.media.size() && sigma_t > 0; ++i)
      hidden[i] += (T - next) * double{extinction(*part.media[i], ray.at(t))} / sigma_t;
    all += T - next;
    T = next;
  }
  for (std::size_t i = 0; i < part.media.size(); ++i) {
    const double part_of_all = all > 0 ? hidden[i] / all : 1.0 / static_cast<double>(part.media.size());
    media_.push_back({part.media[i], static_cast<float>(part_of_all) * opacity});
  }
}

}  // namespace tyndall
