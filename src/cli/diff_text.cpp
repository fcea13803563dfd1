#include "cli/diff_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/diff_json.h"
#include "tyndall/relative_error.h"

namespace tyndall::cli {
namespace {

std::string channel_table(const ImageDiff& diff, std::size_t width) {
  std::string text = fmt::format("  {:{}}  {:>11}  {:>11}  {:>11}  {:>24}  {:>10}  at pixel\n", "channel", width, "mean",
                                 "reference", "bias", "95 % interval of bias", "max error");
  for (const ChannelDiff& c : diff.channels) {
    const std::string interval = fmt::format("{:.3e} .. {:.3e}", c.bias - c.margin(), c.bias + c.margin());
    text += fmt::format("  {:{}}  {:>11.6g}  {:>11.6g}  {:>+11.3e}  {:>24}  {:>10.4g}  {}\n", c.name, width, c.mean,
                        c.reference_mean, c.bias, interval, c.largest, c.equal ? "(equal)" : fmt::format("({}, {})", c.x, c.y));
  }
  return text;
}

std::string row(const std::string& name, std::size_t width, const ErrorMetrics& e) {
  return fmt::format("  {:{}}  {:>11.4g}  {:>11.4g}  {:>11.4g}", name, width, e.mse, e.relmse, e.relmse_trimmed);
}

std::string stated_text(const ErrorMetrics& e, std::size_t width) {
  const StatedErrors& stated = *e.stated;
  return fmt::format(
      "  {:{}}  {:>11}  {:>11.4g}  {:>11.4g}  stated: the true one is {:.3g} times that, trimmed {:.3g} times;\n"
      "  {:{}}  {:>11}  {:>11}  {:>11}  {:.1f} % of the values are within two standard errors\n",
      "", width, "", stated.relmse, stated.relmse_trimmed, e.relmse / stated.relmse, e.relmse_trimmed / stated.relmse_trimmed,
      "", width, "", "", "", 100 * stated.within_two);
}

std::string group_table(const ImageDiff& diff, std::size_t width) {
  std::string text = fmt::format("  {:{}}  {:>11}  {:>11}  {:>11}  {:>11}  {:>11}\n", "group", width, "MSE", "relMSE",
                                 "trimmed", "MAPE", "SMAPE");
  for (const GroupDiff& g : diff.groups) {
    text += row(g.name, width, g.errors) + fmt::format("  {:>11.4g}  {:>11.4g}\n", g.errors.mape, g.errors.smape);
    if (!g.without_noise) continue;
    text += row("", width, *g.without_noise) + "  without the reference's noise\n";
    if (g.without_noise->stated) text += stated_text(*g.without_noise, width);
  }
  return text +
         fmt::format(
             "  {:{}}  (relative errors add {:g} to the reference; trimmed: relMSE without the worst {:g} % of pixels)\n", "",
             width, kRelativeEpsilon, 100 * kTrimmedFraction);
}

std::string flip_text(const ImageDiff& diff, std::size_t width, double pixels_per_degree) {
  return fmt::format(
      "  {:{}}  LDR {:.6f}, HDR {:.6f} (mean; {:.3g} pixels a degree, {} exposure{} from {:+.1f} to {:+.1f} stops)\n", "FLIP",
      width, diff.flip_ldr->mean(), diff.flip_hdr->mean(), pixels_per_degree, diff.flip_hdr->exposures,
      diff.flip_hdr->exposures == 1 ? "" : "s", diff.flip_hdr->start_exposure, diff.flip_hdr->stop_exposure);
}

/// The verdict of the test is long, and once is enough.
bool is_said(const std::string& verdict, const Judgement& judgement) {
  return std::any_of(judgement.reasons.begin(), judgement.reasons.end(),
                     [&](const std::string& reason) { return reason.find(verdict) != std::string::npos; });
}

}  // namespace

std::string as_text(const ImageDiff& diff, const Judgement& judgement, const DiffOptions& options) {
  std::string text = fmt::format("{}\n  against {}\n", options.image, options.reference);
  if (!diff.primaries.empty())
    text += fmt::format("  warning: {}; their numbers are compared as if they were of the same colours\n", diff.primaries);
  if (diff.windows.empty()) {
    std::size_t width = 7;  // of "channel"
    for (const ChannelDiff& c : diff.channels) width = std::max(width, c.name.size());
    if (!diff.channels.empty()) text += channel_table(diff, width) + group_table(diff, width);
    if (diff.flip_hdr) text += flip_text(diff, width, options.settings.flip_settings.pixels_per_degree);
    if (diff.test && !is_said(diff.test->verdict, judgement))
      text += fmt::format("  {:{}}  {}\n", "test", width, diff.test->verdict);
  }
  text += fmt::format("{} by {}\n", judgement.same ? "same" : "differs", judgement.criterion);
  for (const std::string& reason : judgement.reasons) text += fmt::format("  {}\n", reason);
  return text;
}

std::string as_json(const ImageDiff& diff, const Judgement& judgement, const DiffOptions& options) {
  nlohmann::ordered_json j{{"image", options.image}, {"reference", options.reference}};
  j.update(diff_json(diff, judgement, options.settings));
  return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace tyndall::cli
