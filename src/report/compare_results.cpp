#include "report/compare_results.h"

#include <fmt/core.h>

#include <cctype>
#include <cmath>

#include "report/compare_verdict.h"
#include "report/diff_json.h"
#include "report/machine.h"
#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

Json interval(const std::optional<ConfidenceInterval>& i) {
  if (!i) return {{"relative", nullptr}, {"low", nullptr}, {"high", nullptr}};
  return {{"relative", number(i->value)}, {"low", number(i->low)}, {"high", number(i->high)}};
}

Json reference_json(const Reference& r) {
  return {{"source", r.source},
          {"file", "reference.exr"},
          {"samples", r.samples},
          {"seed", r.seed},
          {"seconds", r.seconds},
          {"relmse", r.has_variance ? number(r.relmse) : Json(nullptr)},
          {"noise_subtracted", r.has_variance}};
}

Json curve_json(const VariantResult& v) {
  Json points = Json::array();
  for (const CurvePoint& p : v.curve) {
    points.push_back({{"seconds", p.seconds},
                      {"samples", p.samples},
                      {"mse", number(p.mse)},
                      {"relmse", number(p.relmse.value)},
                      {"relmse_low", number(p.relmse.low)},
                      {"relmse_high", number(p.relmse.high)}});
  }
  return points;
}

Json work_json(const std::optional<WorkParts>& work) {
  if (!work) return nullptr;
  Json j;
  for (const auto& [name, part] : kWorkParts) j[name] = number((*work).*part);
  return j;
}

Json parts_json(const std::optional<ErrorParts::Shares>& shares) {
  if (!shares) return nullptr;
  Json j;
  for (std::size_t i = 0; i < kLightParts.size(); ++i) j[kLightParts[i]] = number((*shares)[i]);
  return j;
}

Json variant_json(const VariantResult& v) {
  const auto known = [&](double value) { return v.given_up ? Json(nullptr) : number(value); };
  const auto part = [](const std::optional<ConfidenceInterval>& i, double ConfidenceInterval::*member) {
    return i ? number((*i).*member) : Json(nullptr);
  };
  Json j{{"name", v.name},
         {"options", v.options},
         {"build_seconds", v.build_seconds},
         {"samples", v.samples},
         {"least_samples", v.least_samples},
         {"most_samples", v.most_samples},
         {"seconds", v.seconds}};
  if (!v.as_rendered.empty()) j["as_rendered"] = v.as_rendered;
  j["mse"] = known(v.error.mse);
  j["relmse"] = known(v.error.relmse);
  j["relmse_trimmed"] = known(v.error.relmse_trimmed);
  j["mape"] = known(v.error.mape);
  j["smape"] = known(v.error.smape);
  if (v.error.stated) j["stated"] = stated_json(v.error);
  j["slope"] = part(v.slope, &ConfidenceInterval::value);
  j["slope_low"] = part(v.slope, &ConfidenceInterval::low);
  j["slope_high"] = part(v.slope, &ConfidenceInterval::high);
  j["slope_samples"] = part(v.slope_samples, &ConfidenceInterval::value);
  j["slope_note"] = v.slope_note();
  j["efficiency"] = interval(v.efficiency);
  j["efficiency_trimmed"] = interval(v.efficiency_trimmed);
  j["work"] = work_json(v.work);
  j["error_parts"] = parts_json(v.error_parts);
  j["mean_rgb"] = v.given_up ? Json(nullptr) : Json(v.mean_rgb);
  j["image"] = v.given_up ? Json(nullptr) : Json(picture_file(v.name));
  j["health"] = {{"non_finite", v.non_finite},
                 {"majorant_violations", v.majorant_violations},
                 {"caps_hit", v.caps_hit},
                 {"parity_errors", v.parity_errors}};
  j["checkpoints"] = curve_json(v);
  return j;
}

std::string budget_text(const RaceBudget& b) {
  return b.seconds ? fmt::format("{:g} s", *b.seconds) : fmt::format("{} samples", *b.samples);
}

std::string interval_text(const std::optional<ConfidenceInterval>& i) {
  return i ? fmt::format("{:.3g} ({:.3g} to {:.3g})", i->value, i->low, i->high) : "-";
}

/// A field of a comma-separated file [RFC 4180].
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string picture_file(const std::string& variant_name) {
  std::string file;
  for (const char c : variant_name) {
    const auto u = static_cast<unsigned char>(c);
    file += std::isalnum(u) || c == '-' || c == '_' || c == '.' || u >= 0x80 ? c : '_';
  }
  if (file.empty() || file[0] == '.') file = "_" + file;
  return file + ".exr";
}

Json compare_json(const CompareContext& context, const ComparePlan& plan, const Reference& reference,
                  const CompareResult& result) {
  Json j{{"version", version()},
         {"scene", context.scene},
         {"reference", reference_json(reference)},
         {"machine", machine_description(context.threads)}};
  j["settings"] = {{"budget", budget_text(plan.budget)}, {"seeds", plan.seeds},     {"width", context.width},
                   {"height", context.height},           {"eps", kRelativeEpsilon}, {"options", context.options},
                   {"command", context.command}};
  j["verdict"] = compare_verdict(result.variants);
  j["warnings"] = result.warnings;
  j["variants"] = Json::array();
  for (const VariantResult& v : result.variants) j["variants"].push_back(variant_json(v));
  return j;
}

std::string error_csv(const CompareResult& result) {
  std::string text = "variant,seconds,samples,mse,relmse,relmse_low,relmse_high\n";
  for (const VariantResult& v : result.variants) {
    for (const CurvePoint& p : v.curve) {
      text += fmt::format("{},{:.6g},{:g},{:.6g},{:.6g},{:.6g},{:.6g}\n", csv_field(v.name), p.seconds, p.samples, p.mse,
                          p.relmse.value, p.relmse.low, p.relmse.high);
    }
  }
  return text;
}

std::string compare_table(const CompareResult& result) {
  std::size_t width = 7;
  for (const VariantResult& v : result.variants) width = std::max(width, v.name.size());
  std::string text = fmt::format("{:<{}}  {:>8} {:>8} {:>8} {:>10} {:>7}  {:<26} {}\n", "variant", width, "build s", "seconds",
                                 "samples", "relMSE", "slope", "efficiency (95 %)", "without the worst 0.1 %");
  for (const VariantResult& v : result.variants) {
    if (v.given_up) {
      text += fmt::format("{:<{}}  {:>8.3f}  {}\n", v.name, width, v.build_seconds,
                          v.as_rendered.empty() ? "given up: one sample takes too long" : "not made: takes two samples");
      continue;
    }
    text += fmt::format("{:<{}}  {:>8.3f} {:>8.2f} {:>8.1f} {:>10.3e} {:>7}  {:<26} {}\n", v.name, width, v.build_seconds,
                        v.seconds, v.samples, v.error.relmse, v.slope ? fmt::format("{:.2f}", v.slope->value) : "-",
                        interval_text(v.efficiency), interval_text(v.efficiency_trimmed));
  }
  if (const std::string verdict = compare_verdict(result.variants); !verdict.empty()) text += verdict + "\n";
  return text;
}

}  // namespace tyndall
