#include "report/regress_suite.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "tyndall/error.h"

using namespace tyndall;

namespace {

namespace fs = std::filesystem;

/// A fresh folder with the files given; scenes need no content to be listed.
std::string folder_with(const std::vector<std::pair<std::string, std::string>>& files) {
  const fs::path folder = fs::current_path() / "suite_test";
  fs::remove_all(folder);
  fs::create_directory(folder);
  for (const auto& [name, text] : files) std::ofstream(folder / name) << text;
  return folder;
}

std::string message_for(const std::string& settings) {
  return read_suite(folder_with({{"a.pbrt", ""}, {"a.json", settings}})).cases.at(0).fault;
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a suite lists its scenes by name; settings are optional") {
  const auto folder =
      folder_with({{"b.pbrt", ""}, {"a.pbrt", ""}, {"a.json", R"({"spp": 8, "aovs": ["Albedo", "Z"]})"}, {"a.exr", ""}});
  const RegressSuite suite = read_suite(folder + "/");
  REQUIRE(suite.cases.size() == 2);
  CHECK(suite.cases[0].name == "a");
  CHECK(suite.cases[0].spp == 8);
  CHECK(suite.cases[1].spp == RegressCase{}.spp);
  CHECK(suite.cases[0].aovs == std::vector<std::string>{"Albedo", "Z"});
  CHECK(suite.reference_path(suite.cases[1]) == folder + "/b.exr");
}

TEST_CASE("every setting is read") {
  const auto folder =
      folder_with({{"a.pbrt", ""}, {"a.json", R"({"about": "x", "spp": 1, "runs": 3, "reference_runs": 5, "aovs": ["N"],
    "seed": 7, "bytes": true, "timeout": 1.5, "options": ["--max-depth", "2"]})"}});
  const RegressCase c = read_suite(folder).cases.at(0);
  CHECK(c.about == "x");
  CHECK(c.spp == 1);
  CHECK(c.runs == 3);
  CHECK(c.reference_runs == 5);
  CHECK(c.aovs == std::vector<std::string>{"N"});
  CHECK(c.seed == 7);
  CHECK(c.bytes);
  CHECK(c.timeout == 1.5);
  CHECK(c.options == std::vector<std::string>{"--max-depth", "2"});
}

TEST_CASE("settings that cannot be meant are errors that name the file and the key") {
  for (const char* bad :
       {R"({"ssp": 8})", R"({"spp": 0})", R"({"spp": "8"})", R"({"spp": 8.5})", R"({"runs": 1})", R"({"timeout": 0})",
        R"({"bytes": 1})", R"({"aovs": ["Depth"]})", R"({"aovs": ["Variance"]})", R"({"aovs": ["N", "N"]})", R"({"aovs": "N"})",
        R"({"options": ["--seed", "3"]})", R"({"options": ["--spp=3"]})", R"({"options": ["--adaptive"]})",
        R"({"options": ["--error-max", "1"]})", R"({"seed": -1})"}) {
    const std::string message = message_for(bad);
    const std::string text = bad;
    CHECK_MESSAGE(mentions(message, "a.json: \"" + text.substr(2, text.find('"', 2) - 2) + "\""), bad, " gives ", message);
  }
  CHECK(mentions(message_for("[1]"), "no JSON object"));
  CHECK(mentions(message_for("{\n  \"spp\": 8,\n  \"runs\" 4}"), "a.json:3:10: is no JSON from here on"));
  CHECK(mentions(message_for(""), "a.json:1:1: is no JSON"));
  CHECK(mentions(message_for(R"({"spp": 1e999})"), "a.json: cannot be read: number overflow"));
  CHECK(mentions(message_for(R"({"timeout": -1e999})"), "'-1e999'"));
  CHECK(mentions(message_for(R"({"spp": 8, "runs": 2, "spp": 9})"), "a.json: \"spp\" is there twice"));
  CHECK(mentions(message_for(R"({"options": "--max-depth 3"})"), "[\"--max-depth\", \"8\"]"));
  CHECK(message_for("{}").empty());
}

TEST_CASE("a folder that is no suite is an error") {
  CHECK_THROWS_WITH_AS(read_suite(folder_with({})), doctest::Contains("holds no scene"), Error);
  CHECK_THROWS_WITH_AS(read_suite("no/such/folder"), doctest::Contains("no/such/folder: "), Error);
}

TEST_CASE("a broken case leaves the others as they are") {
  const RegressSuite suite = read_suite(folder_with({{"a.pbrt", ""}, {"b.json", "{}"}, {"c.pbrt", ""}, {"c.json", "{"}}));
  REQUIRE(suite.cases.size() == 3);
  CHECK(suite.cases[0].fault.empty());
  CHECK(mentions(suite.cases[1].fault, "b.json: has no scene"));
  CHECK(mentions(suite.cases[2].fault, "c.json:1:2: is no JSON"));
}

TEST_CASE("a filter is a part of the name or a glob") {
  RegressSuite suite{"s", {}};
  for (const char* name : {"fog_thick", "fog_thin", "lamp"}) suite.cases.push_back({.name = name});
  CHECK(select_cases(suite, "") == std::vector<std::size_t>{0, 1, 2});
  CHECK(select_cases(suite, "thin") == std::vector<std::size_t>{1});
  CHECK(select_cases(suite, "fog_*") == std::vector<std::size_t>{0, 1});
  CHECK(select_cases(suite, "[lf]*p") == std::vector<std::size_t>{2});
  CHECK_THROWS_WITH_AS(select_cases(suite, "thi?"), doctest::Contains("fog_thick, fog_thin, lamp"), Error);
}
