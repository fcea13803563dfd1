/// What a render can do without.
#pragma once

#include <array>
#include <cstdint>

#include "session/decision.h"
#include "session/pixel_sample.h"
#include "session/resolved_settings.h"
#include "transport/sample/counters.h"

namespace tyndall {

struct Technique {
  bool open;  ///< to be decided
  /// To a decision with a budget what another one says of it.
  void (*copy)(const Decision& from, Decision& to);
  std::uint64_t Counters::*use;  ///< counts what it does: 0 where it makes no difference
  bool doubted = false;          ///< whether looks without it may miss noise that it leaves
};
using Techniques = std::array<Technique, 4>;

Techniques techniques(const OpenChoices& open, const SampleContext& context);

/// `all` without those that are open: plain path tracing, where all are. With a budget that nothing has measured.
Decision without_open(const Techniques& techniques, const Decision& all);

}  // namespace tyndall
