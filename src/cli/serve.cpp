#include "cli/serve.h"

#include <fmt/core.h>

#include <filesystem>

#include "cli/log.h"
#include "cli/stop_signal.h"
#include "tyndall/error.h"

namespace tyndall::cli {

std::unique_ptr<LivePage> serve(const RenderOptions& options) {
  if (!options.serve) return nullptr;
  const ServeAddress address = serve_address(*options.serve);
  if (options.quiet && address.port == 0)
    throw Error(Failure::usage, "--serve without a port takes one that is free, and --quiet does not tell it; give a port");
  auto page = std::make_unique<LivePage>(LivePage::Setup{address, std::filesystem::path(options.scene).filename(),
                                                         [] { request_stop("cancelled on the page; stopping soon\n"); }});
  if (!page->is_loopback())
    log("warning: --serve {}: whoever reaches this machine there can see the render and cancel it\n", *options.serve);
  if (!options.quiet) log("the render can be seen at {}\n", page->url());
  return page;
}

std::string outcome_text(const Summary& summary) {
  return fmt::format("{} with {} samples a pixel, written to {}", summary.render.stopped ? "stopped" : "complete",
                     summary.render.samples, summary.output);
}

std::string outcome_text(const SequenceSummary& summary) {
  return fmt::format("{} frames of {} are there, as {}", summary.asked - summary.missing(), summary.asked, summary.output);
}

}  // namespace tyndall::cli
