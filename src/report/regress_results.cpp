#include "report/regress_results.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "report/machine.h"
#include "tyndall/render.h"
#include "tyndall/utf8.h"

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kStatuses{CaseStatus::pass,  CaseStatus::updated, CaseStatus::fresh, CaseStatus::fail,
                               CaseStatus::crash, CaseStatus::timeout, CaseStatus::error, CaseStatus::stopped};

bool is_good(CaseStatus status) {
  return status == CaseStatus::pass || status == CaseStatus::updated || status == CaseStatus::fresh;
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  const int length = std::snprintf(nullptr, 0, format, values...);
  std::string text(static_cast<std::size_t>(length), ' ');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

Json test_json(const LayerTest& t) {
  Json j{{"what", t.what}, {"same", t.same}, {"verdict", t.verdict}};
  if (t.blocks == 0) return j;
  j["alarms"] = t.alarms;
  j["blocks"] = t.blocks;
  j["worst_p"] = t.worst_p;
  j["mean_difference"] = t.mean_difference;
  j["mean_error"] = t.mean_error;
  j["uniformity_p"] = t.uniformity_p;
  return j;
}

Json case_json(const CaseResult& c) {
  Json j{{"name", c.name},       {"status", name_of(c.status)}, {"seconds", c.seconds},
         {"samples", c.samples}, {"message", c.message},        {"tests", Json::array()}};
  for (const LayerTest& t : c.tests) j["tests"].push_back(test_json(t));
  return j;
}

/// What XML 1.0 can hold, quoted; control characters, which it cannot, become blanks.
std::string xml(const std::string& text) {
  std::string quoted;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (const std::size_t length = utf8_length(text, i); length > 1) {
      const std::string character = text.substr(i, length);
      quoted += character == "\xef\xbf\xbe" || character == "\xef\xbf\xbf" ? "?" : character;  // U+FFFE, U+FFFF
      i += length - 1;
      continue;
    }
    switch (c) {
      case '&':
        quoted += "&amp;";
        break;
      case '<':
        quoted += "&lt;";
        break;
      case '>':
        quoted += "&gt;";
        break;
      case '"':
        quoted += "&quot;";
        break;
      default: {
        const auto code = static_cast<unsigned char>(c);
        quoted += code < 0x20 ? ' ' : code < 0x7f ? c : '?';  // a child's last words may be no UTF-8
      }
    }
  }
  return quoted;
}

std::string junit_case(const CaseResult& c, const std::string& suite) {
  std::string text =
      formatted("  <testcase classname=\"%s\" name=\"%s\" time=\"%.3f\"", xml(suite).c_str(), xml(c.name).c_str(), c.seconds);
  if (is_good(c.status)) return text + "/>\n";
  const std::string kind = c.status == CaseStatus::fail ? "failure" : c.status == CaseStatus::stopped ? "skipped" : "error";
  text += ">\n    <" + kind;
  if (kind != "skipped") text += " type=\"" + name_of(c.status) + "\"";
  text += " message=\"" + xml(c.message) + "\">";
  for (const LayerTest& t : c.tests) {
    if (!t.same) text += "\n" + xml(t.what + ": " + t.verdict);
  }
  return text + "</" + kind + ">\n  </testcase>\n";
}

/// Of the layer's channels the one furthest off for its error, for the table: a channel that is nearly black may be off
/// by many per cent and mean nothing.
double telling_difference(const LayerTest& t) {
  std::size_t furthest = 0;
  const auto significance = [&](std::size_t k) {
    return t.mean_error[k] > 0 ? std::abs(t.mean_difference[k]) / t.mean_error[k] : 0;
  };
  for (std::size_t k = 1; k < 3; ++k) {
    if (significance(k) > significance(furthest)) furthest = k;
  }
  return t.mean_difference[furthest];
}

}  // namespace

Json regress_json(const SuiteResult& result) {
  Json j{{"version", version()}, {"suite", result.suite}, {"seed", result.seed}};
  j["machine"] = machine_description(result.jobs);
  j["seconds"] = result.seconds;
  j["family_level"] = result.family_level;
  const auto good = std::count_if(result.cases.begin(), result.cases.end(), [](const auto& c) { return is_good(c.status); });
  j["passed"] = good;
  const auto stopped = static_cast<std::ptrdiff_t>(result.count(CaseStatus::stopped));
  j["failed"] = static_cast<std::ptrdiff_t>(result.cases.size()) - good - stopped;
  j["stopped"] = stopped;
  j["cases"] = Json::array();
  for (const CaseResult& c : result.cases) j["cases"].push_back(case_json(c));
  return j;
}

std::string regress_junit(const SuiteResult& result) {
  const std::size_t fail = result.count(CaseStatus::fail), skipped = result.count(CaseStatus::stopped);
  const std::size_t errors =
      result.count(CaseStatus::crash) + result.count(CaseStatus::timeout) + result.count(CaseStatus::error);
  const std::string counts = formatted("tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" skipped=\"%zu\" time=\"%.3f\"",
                                       result.cases.size(), fail, errors, skipped, result.seconds);
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"" + xml(result.suite) +
                     "\" " + counts + ">\n";
  for (const CaseResult& c : result.cases) text += junit_case(c, result.suite);
  return text + "</testsuite>\n</testsuites>\n";
}

std::string regress_head(std::size_t width) {
  return formatted("%-*s  %-7s  %7s  %6s  %8s  %8s  ", static_cast<int>(width), "case", "status", "seconds", "spp", "mean %",
                   "worst p") +
         "what\n";
}

std::string regress_row(const CaseResult& c, std::size_t width) {
  const std::size_t letters = utf8_count(c.name);  // printf pads by bytes
  std::string row = c.name + std::string(width - std::min(width, letters), ' ') +
                    formatted("  %-7s  %7.1f  %6d", name_of(c.status).c_str(), c.seconds, c.samples);
  if (c.tests.empty()) {
    row += formatted("  %8s  %8s", "", "");
  } else {
    double worst = 1;
    for (const LayerTest& t : c.tests) worst = std::min(worst, t.worst_p);
    row += formatted("  %+8.3f  %8.1e", 100 * telling_difference(c.tests.front()), worst);
  }
  return row + "  " + (c.status == CaseStatus::pass ? std::to_string(c.tests.size()) + " tests" : c.message) + "\n";
}

std::string regress_summary(const SuiteResult& result) {
  std::string text;
  for (const CaseStatus status : kStatuses) {
    const std::size_t count = result.count(status);
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name_of(status);
  }
  return text + formatted(" in %.0f s", result.seconds);
}

}  // namespace tyndall
