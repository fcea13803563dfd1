#include "report/regress_suite.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "report/regress_reference.h"
#include "tyndall/error.h"
#include "tyndall/settings.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Options of render that the suite itself sets, that end a render at no fixed number of samples, that write further files,
/// render a part of the picture's samples, or filter it, which leaves pixels without variances of their own.
constexpr std::array kTaken{"-o",          "--output",   "--seed",        "--spp",        "--aov",          "--threads",
                            "--json",      "--quiet",    "--time",        "--progress",   "--reproducible", "--error",
                            "--error-max", "--adaptive", "--no-adaptive", "--max-memory", "--denoise",      "--deep",
                            "--slice",     "--frames",   "--resume",      "--serve",      "--display",      "--checkpoint"};

[[noreturn]] void bad(const std::string& path, const std::string& what) { throw Error(Failure::scene, path + ": " + what); }

int whole_number(const nlohmann::json& value, int lowest, int highest) {
  if (!value.is_number_integer()) throw Error(Failure::scene, "must be a whole number");
  const auto number = value.get<std::int64_t>();
  if (number < lowest || number > highest) {
    throw Error(Failure::scene, "must be from " + std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return static_cast<int>(number);
}

std::string text(const nlohmann::json& value) {
  if (!value.is_string()) throw Error(Failure::scene, "must be a text in quotes");
  return value.get<std::string>();
}

std::vector<std::string> texts(const nlohmann::json& value, const std::string& example) {
  if (!value.is_array()) throw Error(Failure::scene, "must be a list of texts, such as " + example);
  std::vector<std::string> list;
  for (const nlohmann::json& entry : value) list.push_back(text(entry));
  return list;
}

/// Sample counts and variances are no means of samples, and are there anyway; mattes hold names.
std::vector<std::string> aov_list(const nlohmann::json& value) {
  const auto known = aov_names();
  std::vector<std::string> list = texts(value, "[\"Albedo\", \"N\"]");
  for (const std::string& name : list) {
    const bool testable = name != "Variance" && name != "SampleCount" && name != "Denoise" && !name.starts_with("Crypto");
    if (!testable || std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(Failure::scene,
                  "holds \"" + name + "\", which is no AOV that can be tested; choose from those of render --help");
    }
    if (std::count(list.begin(), list.end(), name) > 1)
      throw Error(Failure::scene, "holds \"" + name + "\" twice; name it once");
  }
  return list;
}

std::vector<std::string> option_list(const nlohmann::json& value) {
  std::vector<std::string> list = texts(value, "[\"--max-depth\", \"8\"]");
  for (const std::string& option : list) {
    const std::string name = option.substr(0, option.find('='));
    if (std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end()) {
      throw Error(Failure::scene, "holds " + name + ", which regress sets itself or cannot test; take it out");
    }
  }
  return list;
}

double seconds(const nlohmann::json& value) {
  if (!value.is_number() || !(value.get<double>() > 0) || value.get<double>() > 1e6) {
    throw Error(Failure::scene, "must be a number of seconds above 0, at most 1000000");
  }
  return value.get<double>();
}

bool yes_or_no(const nlohmann::json& value) {
  if (!value.is_boolean()) throw Error(Failure::scene, "must be true or false");
  return value.get<bool>();
}

void set(RegressCase& c, const std::string& key, const nlohmann::json& value) {
  constexpr int kMost = 1 << 20;
  if (key == "about")
    c.about = text(value);
  else if (key == "spp")
    c.spp = whole_number(value, 1, kMost);
  else if (key == "runs")
    c.runs = whole_number(value, 2, 1000);
  else if (key == "reference_runs")
    c.reference_runs = whole_number(value, 2, 1000);
  else if (key == "aovs")
    c.aovs = aov_list(value);
  else if (key == "seed")
    c.seed = static_cast<std::uint64_t>(whole_number(value, 0, kMost));
  else if (key == "bytes")
    c.bytes = yes_or_no(value);
  else if (key == "timeout")
    c.timeout = seconds(value);
  else if (key == "options")
    c.options = option_list(value);
  else
    throw Error(Failure::scene,
                "is no setting; known are about, spp, runs, reference_runs, aovs, seed, bytes, timeout, options");
}

/// "file:line:column" of a byte, counted from 1.
std::string place(const std::string& path, const std::string& text, std::size_t byte) {
  const std::string_view before = std::string_view(text).substr(0, byte > 0 ? byte - 1 : 0);
  const std::size_t line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;  // npos + 1 = 0
  return path + ":" + std::to_string(line) + ":" + std::to_string(column);
}

/// The object in a settings file. JSON readers take the last of two equal keys, and the first was meant as well.
nlohmann::json read_object(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  std::set<std::string> keys;
  std::string twice;
  const auto see_key = [&](int depth, nlohmann::json::parse_event_t event, const nlohmann::json& key) {
    const bool own = event == nlohmann::json::parse_event_t::key && depth == 1;
    if (own && !keys.insert(key.get<std::string>()).second) twice = key.get<std::string>();
    return true;
  };
  nlohmann::json settings;
  try {
    settings = nlohmann::json::parse(text, see_key);
  } catch (const nlohmann::json::parse_error& e) {
    bad(place(path, text, e.byte), "is no JSON from here on; write settings as {\"spp\": 64, \"aovs\": [\"N\"]}");
  } catch (const nlohmann::json::exception& e) {  // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
    const std::string_view what = e.what();
    bad(path, "cannot be read: " + std::string(what.substr(what.find("] ") + 2)) + "; give a number that the setting can have");
  }
  if (!settings.is_object()) bad(path, "is no JSON object; write settings as {\"spp\": 64}");
  if (!twice.empty()) bad(path, "\"" + twice + "\" is there twice; keep one");
  return settings;
}

void read_settings(const std::string& path, RegressCase& c) {
  if (!fs::exists(path)) return;
  const nlohmann::json settings = read_object(path);
  for (const auto& [key, value] : settings.items()) {
    try {
      set(c, key, value);
    } catch (const Error& e) {
      bad(path, "\"" + key + "\" " + e.what());
    }
  }
}

RegressCase read_case(const std::string& folder, const std::string& name) {
  RegressCase c{.name = name};
  try {
    read_settings(folder + "/" + name + ".json", c);
  } catch (const Error& e) {
    c.fault = e.what();
  }
  return c;
}

/// Settings or a reference that belong to no scene are a slip of the pen in one of the names, or their scene was lost. Other
/// images may be what scenes show.
bool lacks_scene(const fs::path& file) {
  if (fs::exists(fs::path(file).replace_extension(".pbrt"))) return false;
  if (file.extension() == ".json") return true;
  const bool is_told = fs::exists(fs::path(file).replace_extension(".json"));
  return file.extension() == ".exr" && !is_told && is_reference(file);
}

RegressCase case_without_scene(const fs::path& file) {
  RegressCase c{.name = file.stem()};
  c.fault = file.string() + ": has no scene beside it; name it like its .pbrt, or remove it";
  return c;
}

}  // namespace

RegressSuite read_suite(const std::string& folder) {
  std::error_code problem;
  RegressSuite suite{folder, {}};
  while (suite.folder.size() > 1 && suite.folder.back() == '/') suite.folder.pop_back();
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    const fs::path path = entry.path();
    if (lacks_scene(path)) suite.cases.push_back(case_without_scene(path));
    if (path.extension() == ".pbrt") suite.cases.push_back(read_case(suite.folder, path.stem()));
  }
  if (problem) bad(folder, problem.message() + "; give the folder of a suite");
  if (suite.cases.empty()) bad(folder, "holds no scene; a suite is a folder of NAME.pbrt files");
  std::sort(suite.cases.begin(), suite.cases.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return suite;
}

std::vector<std::size_t> select_cases(const RegressSuite& suite, const std::string& filter) {
  const bool glob = filter.find_first_of("*?[") != std::string::npos;
  std::vector<std::size_t> chosen;
  std::string names;
  for (std::size_t i = 0; i < suite.cases.size(); ++i) {
    const std::string& name = suite.cases[i].name;
    names += (names.empty() ? "" : ", ") + name;
    const bool matches = glob ? fnmatch(filter.c_str(), name.c_str(), 0) == 0 : name.find(filter) != std::string::npos;
    if (matches) chosen.push_back(i);
  }
  if (chosen.empty()) throw Error(Failure::usage, "--filter " + filter + " matches no case; the suite has " + names);
  return chosen;
}

}  // namespace tyndall
