// The template against the rules of Open Job Description 2023-09: https://github.com/OpenJobDescription/openjd-specifications,
// "Template Schemas".

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <set>

#include "farm/farm_job.h"
#include "tyndall/error.h"

using namespace tyndall;
using Json = nlohmann::json;

namespace {

FarmJob a_job() {
  FarmJob job;
  job.name = "hall";
  job.program = "/opt/bin/tyndall";
  job.scene = "/net/a scene.pbrt";
  job.folder = "/net/hall-farm";
  job.output = "/net/hall.exr";
  job.steps = {
      {"render",
       {{"{program}", true},
        {"render"},
        {"{scene}", true},
        {"--slice"},
        {"{slice}/16", true},
        {"-o"},
        {"{folder}/slices/slice-{slice}.exr", true}},
       16,
       8,
       std::size_t{3} << 30},
      {"merge", {{"{program}", true}, {"merge"}, {"{folder}/slices", true}, {"-o"}, {"{output}", true}}, 1, 1, 1 << 20}};
  return job;
}

void require_keys(const Json& object, const std::set<std::string>& required, std::set<std::string> optional) {
  optional.insert(required.begin(), required.end());
  for (const auto& [key, value] : object.items()) REQUIRE_MESSAGE(optional.contains(key), key);
  for (const std::string& key : required) REQUIRE_MESSAGE(object.contains(key), key);
}

void require_name(const std::string& name) {
  REQUIRE(name.size() >= 1);
  REQUIRE(name.size() <= 64);
}

void require_identifier(const std::string& name) {
  require_name(name);
  REQUIRE(std::regex_match(name, std::regex("[A-Za-z_][A-Za-z0-9_]*")));
}

/// Every {{...}} names something that there is.
void require_format_string(const std::string& text, const std::set<std::string>& known) {
  static const std::regex kUse("\\{\\{([^}]*)\\}\\}");
  for (std::sregex_iterator use(text.begin(), text.end(), kUse), end; use != end; ++use)
    REQUIRE_MESSAGE(known.contains((*use)[1].str()), text);
  const std::string rest = std::regex_replace(text, kUse, "");
  REQUIRE(rest.find("{{") == std::string::npos);
  REQUIRE(rest.find("}}") == std::string::npos);
}

std::set<std::string> require_parameters(const Json& definitions) {
  std::set<std::string> known;
  REQUIRE(definitions.size() >= 1);
  REQUIRE(definitions.size() <= 50);
  for (const Json& p : definitions) {
    require_keys(p, {"name", "type"}, {"description", "default", "objectType", "dataFlow"});
    require_identifier(p["name"]);
    REQUIRE(known.insert("Param." + p["name"].get<std::string>()).second);
    const bool path = p["type"] == "PATH";
    REQUIRE((path || p["type"] == "STRING"));
    if (!path) continue;
    REQUIRE((p["objectType"] == "FILE" || p["objectType"] == "DIRECTORY"));
    REQUIRE(std::set<std::string>{"NONE", "IN", "OUT", "INOUT"}.contains(p["dataFlow"]));
    if (p.contains("default")) REQUIRE_FALSE(p["default"].get<std::string>().starts_with("/"));
  }
  return known;
}

void require_step(const Json& step, std::set<std::string> known, const std::set<std::string>& steps_before) {
  require_keys(step, {"name", "script"}, {"dependencies", "hostRequirements", "parameterSpace"});
  require_name(step["name"]);
  for (const Json& d : step.value("dependencies", Json::array())) REQUIRE(steps_before.contains(d["dependsOn"]));
  for (const Json& a : step["hostRequirements"]["amounts"]) {
    require_keys(a, {"name"}, {"min", "max"});
    REQUIRE(a["name"].get<std::string>().starts_with("amount.worker."));
    REQUIRE(a["min"].get<double>() > 0);
  }
  if (step.contains("parameterSpace")) {
    const Json& tasks = step["parameterSpace"]["taskParameterDefinitions"];
    REQUIRE(tasks.size() >= 1);
    REQUIRE(tasks.size() <= 16);
    for (const Json& t : tasks) {
      require_keys(t, {"name", "type", "range"}, {});
      require_identifier(t["name"]);
      REQUIRE(t["type"] == "INT");
      REQUIRE(std::regex_match(t["range"].get<std::string>(), std::regex("[0-9]+(-[0-9]+)?(,[0-9]+(-[0-9]+)?)*")));
      known.insert("Task.Param." + t["name"].get<std::string>());
    }
  }
  require_keys(step["script"], {"actions"}, {});
  const Json& run = step["script"]["actions"]["onRun"];
  require_keys(run, {"command"}, {"args", "timeout", "cancelation"});
  require_format_string(run["command"], known);
  for (const Json& word : run["args"]) require_format_string(word, known);
  REQUIRE(run["cancelation"]["mode"] == "NOTIFY_THEN_TERMINATE");
  REQUIRE(run["cancelation"]["notifyPeriodInSeconds"] <= 600);
}

}  // namespace

TEST_CASE("a template keeps the rules of Open Job Description 2023-09") {
  const FarmFiles files = openjd_files(a_job());
  REQUIRE(files.files.at(0).name == "template.json");
  const Json j = Json::parse(files.files[0].text);
  require_keys(j, {"specificationVersion", "name", "steps"}, {"parameterDefinitions", "description"});
  CHECK(j["specificationVersion"] == "jobtemplate-2023-09");
  const std::set<std::string> known = require_parameters(j["parameterDefinitions"]);
  std::set<std::string> steps;
  for (const Json& step : j["steps"]) {
    require_step(step, known, steps);
    REQUIRE(steps.insert(step["name"]).second);
  }
  CHECK(steps == std::set<std::string>{"render", "merge"});
  for (const Json& value : Json::parse(files.files.at(1).text)["parameterValues"])
    CHECK(known.contains("Param." + value["name"].get<std::string>()));
}

TEST_CASE("the template's words are those of the job, with the engine's names") {
  const Json j = Json::parse(openjd_files(a_job()).files[0].text);
  const Json& render = j["steps"][0];
  CHECK(render["parameterSpace"]["taskParameterDefinitions"][0]["range"] == "1-16");
  CHECK(render["script"]["actions"]["onRun"]["command"] == "{{Param.Program}}");
  CHECK(render["script"]["actions"]["onRun"]["args"] == Json({"render", "{{Param.Scene}}", "--slice", "{{Task.Param.Slice}}/16",
                                                              "-o", "{{Param.Folder}}/slices/slice-{{Task.Param.Slice}}.exr"}));
  CHECK(j["steps"][1]["dependencies"][0]["dependsOn"] == "render");
  CHECK(render["hostRequirements"]["amounts"][1]["min"] == 3073);
}

TEST_CASE("a step in front of the others is waited for by them, in every engine") {
  FarmJob job = a_job();
  job.steps.insert(job.steps.begin(), {"learn", {{"{program}", true}, {"learn"}, {"{scene}", true}}, 1, 8, 1 << 20});
  const Json j = Json::parse(openjd_files(job).files[0].text);
  CHECK(j["steps"][1]["dependencies"][0]["dependsOn"] == "learn");
  const auto text_of = [&](const FarmFiles& files, const std::string& name) {
    for (const FarmFile& f : files.files) {
      if (f.name == name) return f.text;
    }
    return std::string();
  };
  CHECK(text_of(slurm_files(job), "submit.sh").find("afterany:${learn%%;*}\" render.sbatch") != std::string::npos);
  const std::string run = text_of(parallel_files(job), "run.sh");
  CHECK(run.find("learn.sh") < run.find("render.sh"));
}

TEST_CASE("words that are no template stay what they were, whatever they hold") {
  FarmJob job = a_job();
  job.steps[0].command.push_back({"{slice} 'and' $HOME"});
  bool found = false;
  for (const FarmFile& f : slurm_files(job).files)
    found = found || f.text.find("'{slice} '\\''and'\\'' $HOME'") != std::string::npos;
  CHECK(found);
  CHECK(openjd_files(job).files[0].text.find("\"{slice} 'and' $HOME\"") != std::string::npos);
  job.steps[0].command.push_back({"{{no}}"});
  CHECK_THROWS_AS(openjd_files(job), Error);
}

TEST_CASE("a sequence has all pairs of frames and slices as tasks") {
  FarmJob job = a_job();
  job.steps[0].command.push_back({"{folder}/slices/{frame}", true});
  for (FarmStep& step : job.steps) step.frames = {1, 5, 10, 11, 12};
  CHECK(job.steps[0].tasks() == 80);
  const Json j = Json::parse(openjd_files(job).files[0].text);
  std::set<std::string> steps;
  for (const Json& step : j["steps"]) {
    require_step(step, require_parameters(j["parameterDefinitions"]), steps);
    steps.insert(step["name"]);
    CHECK(step["parameterSpace"]["taskParameterDefinitions"][0] ==
          Json({{"name", "Frame"}, {"type", "INT"}, {"range", "1,5,10-12"}}));
  }
  CHECK(j["steps"][0]["parameterSpace"]["taskParameterDefinitions"][1]["range"] == "1-16");
  CHECK(j["steps"][0]["script"]["actions"]["onRun"]["args"].back() == "{{Param.Folder}}/slices/{{Task.Param.Frame}}");
}
