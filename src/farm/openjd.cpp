#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <cctype>
#include <regex>

#include "farm/farm_job.h"
#include "report/shell_quote.h"
#include "tyndall/error.h"
#include "tyndall/frames.h"

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestName = 64;
constexpr int kSecondsToSave = 120;

/// Format strings have no escape for their braces.
const std::string& without_braces(const std::string& text) {
  if (text.find("{{") == std::string::npos && text.find("}}") == std::string::npos) return text;
  throw Error(Failure::usage, "openjd cannot hold \"" + text + "\": {{ and }} are its own; rename it");
}

std::string format_string(const FarmWord& word) {
  if (!word.is_template) return without_braces(word.text);
  static const std::regex kSlice("\\{slice\\}"), kFrame("\\{frame\\}"), kName("\\{([a-z])([a-z]+)\\}");
  std::string text = std::regex_replace(word.text, kSlice, "{{Task.Param.Slice}}");
  text = std::regex_replace(text, kFrame, "{{Task.Param.Frame}}");
  std::smatch name;
  while (std::regex_search(text, name, kName)) {
    const auto capital = static_cast<char>(std::toupper(static_cast<unsigned char>(name[1].str()[0])));
    text = name.prefix().str() + "{{Param." + capital + name[2].str() + "}}" + name.suffix().str();
  }
  return text;
}

Json amount(const char* name, std::size_t least) { return {{"name", name}, {"min", least}}; }

Json step_json(const FarmStep& step, const std::string& before) {
  Json j = {{"name", step.name}};
  if (!before.empty()) j["dependencies"] = {{{"dependsOn", before}}};
  j["hostRequirements"]["amounts"] = {amount("amount.worker.vcpu", static_cast<std::size_t>(step.threads)),
                                      amount("amount.worker.memory", (step.memory >> 20) + 1)};
  // Tasks are all pairs of the two.
  Json parameters = Json::array();
  if (!step.frames.empty()) parameters.push_back({{"name", "Frame"}, {"type", "INT"}, {"range", frames_text(step.frames)}});
  if (step.slices > 1 || !step.frames.empty())
    parameters.push_back({{"name", "Slice"}, {"type", "INT"}, {"range", fmt::format("1-{}", step.slices)}});
  if (!parameters.empty()) j["parameterSpace"]["taskParameterDefinitions"] = parameters;
  Json& run = j["script"]["actions"]["onRun"];
  run["command"] = format_string(step.command.front());
  for (std::size_t i = 1; i < step.command.size(); ++i) run["args"].push_back(format_string(step.command[i]));
  run["cancelation"] = {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", kSecondsToSave}};
  return j;
}

Json path_parameter(const char* name, const char* kind, const char* flow, const char* about) {
  return {{"name", name}, {"type", "PATH"}, {"objectType", kind}, {"dataFlow", flow}, {"description", about}};
}

Json template_of(const FarmJob& job) {
  Json j = {{"specificationVersion", "jobtemplate-2023-09"}, {"name", without_braces(job.name.substr(0, kLongestName))}};
  j["parameterDefinitions"] = {
      {{"name", "Program"}, {"type", "STRING"}, {"default", job.program}, {"description", "Tyndall on the workers"}},
      path_parameter("Scene", "FILE", "IN", "the scene; the files it names lie where it says"),
      path_parameter("Folder", "DIRECTORY", "INOUT", "slices and checkpoints, shared by all workers"),
      path_parameter("Output", "FILE", "OUT", "the picture")};
  std::string before;
  for (const FarmStep& step : job.steps) {
    j["steps"].push_back(step_json(step, before));
    before = step.name;
  }
  return j;
}

/// Defaults of paths must be relative to the template, so their values come beside it.
Json values_of(const FarmJob& job) {
  Json values = Json::array();
  for (const auto& [name, value] : {std::pair("Scene", job.scene), {"Folder", job.folder}, {"Output", job.output}})
    values.push_back({{"name", name}, {"value", value}});
  return {{"parameterValues", values}};
}

}  // namespace

FarmFiles openjd_files(const FarmJob& job) {
  if (!job.engine_options.empty())
    throw Error(Failure::usage, "openjd takes no --engine-option: it is the farm's own program that has options");
  return {{{"template.json", template_of(job).dump(2) + "\n"}, {"parameter_values.json", values_of(job).dump(2) + "\n"}},
          "deadline bundle submit " + shell_quoted(job.folder) + "   (or your farm's own program)"};
}

}  // namespace tyndall
