#include "report/regress_results.h"

#include <doctest/doctest.h>

using namespace tyndall;

namespace {

SuiteResult mixed_result() {
  SuiteResult result{.suite = "my <suite>", .seed = 7, .seconds = 3, .family_level = 1e-3, .cases = {}};
  result.cases.push_back({.name = "good", .status = CaseStatus::pass, .seconds = 1, .samples = 256, .message = "fine"});
  result.cases.back().tests.push_back({.what = "RGB", .same = true, .verdict = "same", .blocks = 192, .worst_p = 0.02});
  result.cases.back().tests.push_back({.what = "bytes", .same = true});
  result.cases.push_back({.name = "off", .status = CaseStatus::fail, .message = "mean is \"off\" & more <\x01\xff>"});
  result.cases.back().tests.push_back({.what = "A", .verdict = "3 < 4"});
  result.cases.push_back({.name = "dead", .status = CaseStatus::crash, .message = "Segmentation fault"});
  result.cases.push_back({.name = "unseen", .status = CaseStatus::stopped});
  return result;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("results.json counts and lists the cases") {
  const auto j = regress_json(mixed_result());
  CHECK(j["suite"] == "my <suite>");
  CHECK(j["seed"] == 7);
  CHECK(j["passed"] == 1);
  CHECK(j["failed"] == 2);
  CHECK(j["stopped"] == 1);
  CHECK(j["machine"]["threads"] >= 1);
  CHECK(j["machine"]["memory_gib"] > 0.1);
  CHECK(j["cases"][0]["tests"][0]["blocks"] == 192);
  CHECK(j["cases"][0]["tests"][0]["mean_difference"].size() == 3);
  CHECK_FALSE(j["cases"][0]["tests"][1].contains("blocks"));
  CHECK(j["cases"][2]["status"] == "crash");
}

TEST_CASE("JUnit tells failures from errors and quotes what XML cannot hold") {
  const std::string xml = regress_junit(mixed_result());
  CHECK(has(xml, "<testsuite name=\"my &lt;suite&gt;\" tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"1\""));
  CHECK(has(xml, "name=\"good\" time=\"1.000\"/>"));
  CHECK(has(xml, "<failure type=\"fail\" message=\"mean is &quot;off&quot; &amp; more &lt; ?&gt;\">\nA: 3 &lt; 4</failure>"));
  CHECK(has(xml, "<error type=\"crash\" message=\"Segmentation fault\"></error>"));
  CHECK(has(xml, "<skipped message=\"\"></skipped>"));
}

TEST_CASE("letters beyond ASCII keep their form in JUnit and their column in the table") {
  SuiteResult result{.suite = "s", .cases = {}};
  result.cases.push_back(
      {.name = "h\xc3\xb6hle", .status = CaseStatus::error, .message = "\xe2\x82\xac \xc3 \xc0\x80 \xed\xa0\x80"});
  const std::string xml = regress_junit(result);
  CHECK(has(xml, "name=\"h\xc3\xb6hle\""));
  CHECK(has(xml, "message=\"\xe2\x82\xac ? ?? ???\""));
  CHECK(regress_row(result.cases[0], 8).find("error") == regress_head(8).find("status") + 1);  // one letter of two bytes
}

TEST_CASE("rows of the table stand under its head") {
  const SuiteResult result = mixed_result();
  const std::string head = regress_head(10), row = regress_row(result.cases[0], 10), bare = regress_row(result.cases[2], 10);
  CHECK(row.find("2 tests") == head.find("what"));
  CHECK(bare.find("Segmentation") == head.find("what"));
  CHECK(row.find("pass") == head.find("status"));
  CHECK(regress_summary(result) == "1 pass, 1 fail, 1 crash, 1 stopped in 3 s");
}
