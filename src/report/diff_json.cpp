#include "report/diff_json.h"

#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

Json as_json(const ChannelDiff& c) {
  return {{"name", c.name},
          {"mean", c.mean},
          {"reference_mean", c.reference_mean},
          {"bias", c.bias},
          {"bias_low", c.bias - c.margin()},
          {"bias_high", c.bias + c.margin()},
          {"bias_interval_from", c.error_from_variance ? "variances" : "pixels"},
          {"max_error", c.largest},
          {"x", c.x},
          {"y", c.y},
          {"equal", c.equal}};
}

Json as_json(const GroupDiff& g) {
  Json j{{"name", g.name}, {"channels", g.channels}};
  j.update(errors_json(g.errors));
  if (g.without_noise) {
    const ErrorMetrics& e = *g.without_noise;
    j["without_reference_noise"] = {{"mse", e.mse}, {"relmse", e.relmse}, {"relmse_trimmed", e.relmse_trimmed}};
    if (e.stated) j["stated"] = stated_json(e);
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

void add_findings(const ImageDiff& diff, const DiffSettings& settings, Json& j) {
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
    j["flip"] = {{"pixels_per_degree", settings.flip_settings.pixels_per_degree},
                 {"ldr", diff.flip_ldr->mean()},
                 {"hdr", diff.flip_hdr->mean()},
                 {"start_exposure", diff.flip_hdr->start_exposure},
                 {"stop_exposure", diff.flip_hdr->stop_exposure},
                 {"exposures", diff.flip_hdr->exposures}};
  }
  j["test"] = diff.test ? as_json(*diff.test, settings.test) : Json(nullptr);
}

}  // namespace

Json errors_json(const ErrorMetrics& e) {
  return {{"mse", e.mse}, {"relmse", e.relmse}, {"relmse_trimmed", e.relmse_trimmed}, {"mape", e.mape}, {"smape", e.smape}};
}

Json stated_json(const ErrorMetrics& e) {
  const StatedErrors& stated = *e.stated;
  return {{"relmse", stated.relmse},
          {"relmse_trimmed", stated.relmse_trimmed},
          {"true_over_stated", e.relmse / stated.relmse},
          {"true_over_stated_trimmed", e.relmse_trimmed / stated.relmse_trimmed},
          {"within_two", stated.within_two}};
}

Json diff_json(const ImageDiff& diff, const Judgement& judgement, const DiffSettings& settings) {
  Json j{{"same", judgement.same}, {"criterion", judgement.criterion}};
  j["reasons"] = judgement.reasons;
  j["width"] = diff.data.width();
  j["height"] = diff.data.height();
  j["eps"] = kRelativeEpsilon;
  j["chromaticities_differ"] = diff.primaries.empty() ? Json(nullptr) : Json(diff.primaries);
  if (diff.windows.empty()) add_findings(diff, settings, j);
  return j;
}

}  // namespace tyndall
