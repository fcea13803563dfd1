#include "cli/folder_check.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/print.h"
#include "io/file_text.h"
#include "io/pbrt_token.h"
#include "tyndall/memory.h"

namespace tyndall::cli {
namespace {

/// Whether the directive stands in it, not in a comment or a string. What cannot be read counts: its check says what is wrong.
bool has_world(const std::string& path) try {
  std::string text = read_file_text(path);
  if (text.find("WorldBegin") == std::string::npos) return false;
  pbrt::Tokenizer in(std::move(text), path);
  while (true) {
    try {
      const pbrt::Token token = in.next();
      if (token.is(pbrt::Token::Kind::end)) return false;
      if (token.is(pbrt::Token::Kind::word) && token.text == "WorldBegin") return true;
    } catch (const Error&) {
      // A broken string: the tokenizer stands behind it.
    }
  }
} catch (const Error&) {
  return true;
}

void print_row(const Verdict& verdict, std::size_t width) {
  std::string result = verdict.ok() ? "ok" : verdict.errors.front();
  if (verdict.errors.size() > 1) result += fmt::format(" (and {} more)", verdict.errors.size() - 1);
  std::string rows = fmt::format("{:{}}  {}\n", verdict.path, width, result);
  for (const Warning& w : verdict.warnings) rows += fmt::format("{:{}}  warning: {}\n", "", width, w.message);
  print_now(rows);
}

void print_counts(const std::vector<Verdict>& verdicts) {
  const auto ok = std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.ok(); });
  print("{} scenes: {} ok, {} not\n", verdicts.size(), ok, static_cast<std::ptrdiff_t>(verdicts.size()) - ok);
  std::map<std::string, int> kinds;
  for (const Verdict& verdict : verdicts)
    for (const Warning& w : verdict.warnings) ++kinds[w.message];
  for (const auto& [kind, scenes] : kinds) print("{:>5} with warning: {}\n", scenes, kind);
}

}  // namespace

Verdict verdict_on(const std::string& path, const SceneReading& how) {
  SceneCheck check = check_scene(path, how);
  Verdict verdict{path, how.frame, std::move(check.errors), std::move(check.warnings), {}, !check.frame_names.empty()};
  if (!verdict.ok()) return verdict;
  try {
    verdict.build = build(std::move(check.scene), {.max_memory = memory_limit({}), .kept = how.kept}).summary();
  } catch (const Error& e) {
    verdict.errors.push_back(e.what());
  }
  return verdict;
}

std::vector<std::string> scenes_below(const std::string& folder) {
  namespace fs = std::filesystem;
  std::vector<std::string> scenes;
  std::error_code failed;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failed);
  for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
    const std::string path = entry->path().string();
    std::error_code ignored;
    if ((path.ends_with(".pbrt") || path.ends_with(".pbrt.gz")) && entry->is_regular_file(ignored) && has_world(path))
      scenes.push_back(path);
  }
  if (failed) throw Error(Failure::scene, folder + ": cannot be listed: " + failed.message() + "; is it readable?");
  if (scenes.empty())
    throw Error(Failure::scene, folder + ": holds no scene; a scene is a .pbrt or .pbrt.gz file with a WorldBegin");
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::vector<Verdict> check_all(const std::vector<std::string>& scenes, bool show) {
  std::size_t width = 0;
  for (const std::string& scene : scenes) width = std::max(width, scene.size());
  std::vector<Verdict> verdicts;
  for (const std::string& scene : scenes) {
    verdicts.push_back(verdict_on(scene));
    if (show) print_row(verdicts.back(), width);
  }
  if (show && !scenes.empty()) print_counts(verdicts);
  return verdicts;
}

void print_json(const std::vector<Verdict>& verdicts) {
  nlohmann::ordered_json all{{"scenes", nlohmann::json::array()}};
  std::size_t ok = 0;
  for (const Verdict& verdict : verdicts) {
    nlohmann::ordered_json scene{{"scene", verdict.path}, {"ok", verdict.ok()}, {"errors", verdict.errors}};
    if (verdict.frame) scene["frame"] = *verdict.frame;
    scene["warnings"] = nlohmann::json::array();
    for (const Warning& w : verdict.warnings) {
      scene["warnings"].push_back({{"where", w.where.file.empty() ? verdict.path : w.where.str()}, {"message", w.message}});
    }
    all["scenes"].push_back(std::move(scene));
    ok += verdict.ok() ? 1 : 0;
  }
  all["ok"] = ok;
  all["not ok"] = verdicts.size() - ok;
  print("{}\n", all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace tyndall::cli
