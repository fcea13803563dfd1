/// Transmittance to several places of one span, in one pass.
#pragma once

#include <algorithm>

#include "transport/media/span.h"
#include "volume/tracking.h"

namespace tyndall {

/// Unbiased estimates of the transmittance from the span's origin, to distances that are asked for in increasing order.
class TransmittanceWalk {
 public:
  TransmittanceWalk(const TransmittanceMethod& method, const Span& span, const Rng& rng, TrackingStats& stats)
      : method_(method), span_(span), rng_(rng), stats_(stats) {}

  Rgb to(float t) {
    for (const SpanPart& part : span_.parts) {
      const float t0 = std::max(part.t0, passed_), t1 = std::min(part.t1, t);
      if (!(t0 < t1) || is_black(T_)) continue;
      T_ *= transmittance(method_, part.view(), span_.ray, t0, t1, rng_, stats_);
    }
    passed_ = t;
    return T_;
  }

 private:
  TransmittanceMethod method_;
  const Span& span_;
  Rng rng_;
  TrackingStats& stats_;
  Rgb T_{1.0f};
  float passed_ = 0;
};

}  // namespace tyndall
