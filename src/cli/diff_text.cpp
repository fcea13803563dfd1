#include "cli/diff_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInterval = 1.96;  // standard errors to either side: 95 %

std::string channel_table(const ImageDiff& diff, std::size_t width) {
  std::string text = fmt::format("  {:{}}  {:>11}  {:>11}  {:>11}  {:>24}  {:>10}  at pixel\n", "channel", width, "mean",
                                 "reference", "bias", "95 % interval of bias", "max error");
  for (const ChannelDiff& c : diff.channels) {
    const double margin = kInterval * c.bias_error;
    const std::string interval = fmt::format("{:.3e} .. {:.3e}", c.bias - margin, c.bias + margin);
    text += fmt::format("  {:{}}  {:>11.6g}  {:>11.6g}  {:>+11.3e}  {:>24}  {:>10.4g}  {}\n", c.name, width, c.mean,
                        c.reference_mean, c.bias, interval, c.largest, c.equal ? "(equal)" : fmt::format("({}, {})", c.x, c.y));
  }
  return text;
}

std::string row(const std::string& name, std::size_t width, const ErrorMetrics& e) {
  return fmt::format("  {:{}}  {:>11.4g}  {:>11.4g}  {:>11.4g}", name, width, e.mse, e.relmse, e.relmse_trimmed);
}

std::string group_table(const ImageDiff& diff, std::size_t width) {
  std::string text = fmt::format("  {:{}}  {:>11}  {:>11}  {:>11}  {:>11}  {:>11}\n", "group", width, "MSE", "relMSE",
                                 "trimmed", "MAPE", "SMAPE");
  for (const GroupDiff& g : diff.groups) {
    text += row(g.name, width, g.errors) + fmt::format("  {:>11.4g}  {:>11.4g}\n", g.errors.mape, g.errors.smape);
    if (g.without_noise) text += row("", width, *g.without_noise) + "  without the reference's noise\n";
  }
  return text +
         fmt::format(
             "  {:{}}  (relative errors add {:g} to the reference; trimmed: relMSE without the worst {:g} % of pixels)\n", "",
             width, kRelativeEps, 100 * kTrimmedFraction);
}

std::string flip_text(const ImageDiff& diff, std::size_t width, double pixels_per_degree) {
  return fmt::format(
      "  {:{}}  LDR {:.6f}, HDR {:.6f} (mean; {:.3g} pixels a degree, {} exposure{} from {:+.1f} to {:+.1f} stops)\n", "FLIP",
      width, diff.flip_ldr->mean(), diff.flip_hdr->mean(), pixels_per_degree, diff.flip_hdr->exposures,
      diff.flip_hdr->exposures == 1 ? "" : "s", diff.flip_hdr->start_exposure, diff.flip_hdr->stop_exposure);
}

Json as_json(const ErrorMetrics& e) {
  return {{"mse", e.mse}, {"relmse", e.relmse}, {"relmse_trimmed", e.relmse_trimmed}, {"mape", e.mape}, {"smape", e.smape}};
}

Json as_json(const ChannelDiff& c) {
  const double margin = kInterval * c.bias_error;
  return {{"name", c.name},
          {"mean", c.mean},
          {"reference_mean", c.reference_mean},
          {"bias", c.bias},
          {"bias_low", c.bias - margin},
          {"bias_high", c.bias + margin},
          {"bias_interval_from", c.error_from_variance ? "variances" : "pixels"},
          {"max_error", c.largest},
          {"x", c.x},
          {"y", c.y},
          {"equal", c.equal}};
}

Json as_json(const GroupDiff& g) {
  Json j{{"name", g.name}, {"channels", g.channels}};
  j.update(as_json(g.errors));
  if (g.without_noise) {
    const ErrorMetrics& e = *g.without_noise;
    j["without_reference_noise"] = {{"mse", e.mse}, {"relmse", e.relmse}, {"relmse_trimmed", e.relmse_trimmed}};
  }
  return j;
}

Json as_json(const std::vector<BadValues>& bad) {
  Json j = Json::array();
  for (const BadValues& v : bad) {
    j.push_back(
        {{"channel", v.channel}, {"in", v.in_reference ? "reference" : "image"}, {"count", v.count}, {"x", v.x}, {"y", v.y}});
  }
  return j;
}

Json as_json(const ImageTest& test, const ImageTestSettings& settings) {
  const BlockDifference& w = test.worst_block;
  Json j{{"same", test.same},
         {"verdict", test.verdict},
         {"family_level", settings.family_level},
         {"block_size", settings.block_size},
         {"blocks", test.blocks},
         {"alarms", test.alarms},
         {"block_level", test.block_level}};
  j["worst_block"] = {
      {"x", w.x}, {"y", w.y}, {"channel", std::string(1, "RGB"[w.channel])}, {"t", w.welch.t}, {"p", w.welch.p}};
  for (std::size_t k = 0; k < 3; ++k) {
    j["means"].push_back(
        {{"relative_bias", test.relative_bias[k]}, {"relative_error", test.relative_error[k]}, {"p", test.means[k].p}});
  }
  j["mean_level"] = test.mean_level;
  j["small_p"] = test.small_p;
  j["uniformity_p"] = test.uniformity_p;
  j["uniformity_level"] = test.uniformity_level;
  return j;
}

void add_findings(const ImageDiff& diff, const DiffOptions& options, Json& j) {
  j["only_in_image"] = diff.only_in_image;
  j["only_in_reference"] = diff.only_in_reference;
  j["non_finite"] = as_json(diff.non_finite);
  j["negative_variances"] = as_json(diff.negative_variances);
  j["channels"] = Json::array();
  for (const ChannelDiff& c : diff.channels) j["channels"].push_back(as_json(c));
  j["groups"] = Json::array();
  for (const GroupDiff& g : diff.groups) j["groups"].push_back(as_json(g));
  j["flip"] = nullptr;
  if (diff.flip_hdr) {
    j["flip"] = {{"pixels_per_degree", options.settings.flip_settings.pixels_per_degree},
                 {"ldr", diff.flip_ldr->mean()},
                 {"hdr", diff.flip_hdr->mean()},
                 {"start_exposure", diff.flip_hdr->start_exposure},
                 {"stop_exposure", diff.flip_hdr->stop_exposure},
                 {"exposures", diff.flip_hdr->exposures}};
  }
  j["test"] = diff.test ? as_json(*diff.test, options.settings.test) : Json(nullptr);
}

/// The verdict of the test is long, and once is enough.
bool is_said(const std::string& verdict, const Judgement& judgement) {
  return std::any_of(judgement.reasons.begin(), judgement.reasons.end(),
                     [&](const std::string& reason) { return reason.find(verdict) != std::string::npos; });
}

}  // namespace

std::string as_text(const ImageDiff& diff, const Judgement& judgement, const DiffOptions& options) {
  std::string text = fmt::format("{}\n  against {}\n", options.image, options.reference);
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
  Json j{
      {"image", options.image}, {"reference", options.reference}, {"same", judgement.same}, {"criterion", judgement.criterion}};
  j["reasons"] = judgement.reasons;
  j["width"] = diff.data.width();
  j["height"] = diff.data.height();
  j["eps"] = kRelativeEps;
  if (diff.windows.empty()) add_findings(diff, options, j);
  return j.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tyndall::cli
