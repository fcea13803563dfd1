/// The page of --serve.
#pragma once

#include <memory>
#include <string>

#include "cli/render_options.h"
#include "cli/sequence_summary.h"
#include "serve/live_page.h"

namespace tyndall::cli {

/// Served from now on, its address told on stderr; null when it was not asked for. Throws Error: usage for an address that
/// cannot be, run_time for one that is taken.
std::unique_ptr<LivePage> serve(const RenderOptions& options);

/// What a page is told at the end.
std::string outcome_text(const Summary& summary);
std::string outcome_text(const SequenceSummary& summary);

}  // namespace tyndall::cli
