#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/command.h"
#include "cli/log.h"
#include "cli/print.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

void print_description(const Description& d) {
  print("{}: {}\n", d.path, d.kind);
  std::size_t width = 0;
  for (const Property& p : d.properties) width = std::max(width, p.name.size());
  std::string subject;
  for (const Property& p : d.properties) {
    if (p.subject != subject) print("  {}\n", p.subject);
    subject = p.subject;
    print("    {:{}}  {}\n", p.name, width, p.value);
  }
}

nlohmann::ordered_json as_json(const Description& d) {
  nlohmann::ordered_json j;
  j["path"] = d.path;
  j["kind"] = d.kind;
  j["properties"] = nlohmann::json::array();
  for (const Property& p : d.properties) {
    j["properties"].push_back({{"subject", p.subject}, {"name", p.name}, {"value", p.value}});
  }
  return j;
}

/// Describes every file it can; a broken one does not keep the others from being shown.
int run_info(const std::vector<std::string>& files, bool json) {
  int exit_code = 0;
  auto all = nlohmann::ordered_json::array();
  for (const std::string& file : files) {
    std::optional<Description> d;
    try {
      d = describe(file);
    } catch (const Error& e) {
      log("tyndall: {}\n", e.what());
      exit_code = static_cast<int>(e.failure());
      continue;
    }
    if (json) {
      all.push_back(as_json(*d));
    } else {
      print_description(*d);
    }
  }
  if (json) print("{}\n", all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  return exit_code;
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("info", "what a .vdb, .nvdb, .exr (or other image) or .pbrt holds");
  auto files = std::make_shared<std::vector<std::string>>();
  auto json = std::make_shared<bool>(false);
  command->add_option("files", *files, "files to describe")->required();
  command->add_flag("--json", *json, "as JSON on stdout");
  command->callback([files, json, &exit_code] { exit_code = run_info(*files, *json); });
}

}  // namespace tyndall::cli
