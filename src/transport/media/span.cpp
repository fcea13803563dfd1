#include "transport/media/span.h"

#include <cassert>

#include "volume/phase/phase.h"

namespace tyndall {

const SpanPart& Span::part_at(float t) const {
  assert(!parts.empty());
  const SpanPart* found = &parts.front();
  for (const SpanPart& part : parts) {
    if (part.t0 <= t) found = &part;
  }
  return *found;
}

float mean_cosine(const Span& span) {
  float sum = 0, weight = 0;
  for (const SpanPart& part : span.parts) {
    for (const ParticipatingMedium* medium : part.media) {
      if (!medium->scatters()) continue;
      sum += mean_cosine(medium->phase());
      weight += 1;
    }
  }
  return weight > 0 ? sum / weight : 0.0f;
}

Span make_span(const SpanWalk::Context& context, const MediaState& start, const Ray& ray, const Trace& trace,
               std::uint64_t& parity_errors) {
  Span span{.ray = ray, .t_end = trace.t_end, .parts = {}, .end = {}};
  SpanWalk walk(context, start, trace.crossings, span.t_end);
  while (const auto interval = walk.next())
    span.parts.push_back({*interval, walk.state(), walk.state().bounds(context.groups)});
  span.end = walk.state();
  parity_errors += walk.parity_errors();
  if (span.t_end == kInfinity && span.end.in_any_group()) ++parity_errors;
  return span;
}

}  // namespace tyndall
