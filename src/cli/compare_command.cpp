#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "cli/command.h"
#include "cli/compare_options.h"
#include "cli/log.h"
#include "cli/notes.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/progress_display.h"
#include "cli/save.h"
#include "cli/stop_signal.h"
#include "report/compare_results.h"
#include "report/page.h"
#include "tyndall/io.h"
#include "tyndall/memory.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

World build_for(Scene scene, const ComparePlan& plan, const RenderSettings& base, const CompareOptions& o) {
  const BuildSettings settings{
      .sanitize = o.picture.sanitize, .threads = base.threads, .max_memory = memory_limit(o.max_memory)};
  return build(std::move(scene), with_needs_of(plan, base, settings));
}

Reference make_reference(const World& world, RenderSettings settings, const ComparePlan& plan, const CompareOptions& o,
                         ProgressDisplay& display) {
  settings.seed = kReferenceSeed;
  ReferenceGoal goal{.relmse = o.reference_error};
  if (o.reference_time) {
    goal.seconds = *o.reference_time;
  } else if (plan.budget.seconds) {
    goal.seconds = 0.5 * *plan.budget.seconds * static_cast<double>(plan.variants.size() * plan.seeds.size());
  }
  display.begin("reference");
  return render_reference(world, settings, goal,
                          {.progress = [&](const Progress& p) { display.show(p); }, .stop = &stop_requested()});
}

CompareResult run_plan(const World& world, const ComparePlan& plan, const Reference& reference, ProgressDisplay& display) {
  display.begin(fmt::format("{} variants, {} seeds", plan.variants.size(), plan.seeds.size()));
  const Timer watch;
  const auto progress = [&](double fraction) {
    const double seconds = watch.seconds();
    display.show({.samples_done = 0,
                  .fraction = fraction,
                  .seconds = seconds,
                  .remaining = seconds * (1 - fraction) / std::max(fraction, 1e-9)});
  };
  CompareResult result = compare(world, plan, reference, {.progress = progress, .stop = &stop_requested()});
  display.finish();
  return result;
}

void warn_of_reference(const Reference& reference, const CompareOptions& o, CompareResult& result) {
  if (o.reference.empty() && reference.relmse > o.reference_error) {
    result.warnings.insert(
        result.warnings.begin(),
        fmt::format("the reference reached relMSE {:.2g} and not {:.2g} in the time it had; its noise is taken "
                    "off the errors, but --reference-time gives it more",
                    reference.relmse, o.reference_error));
  }
  if (!reference.has_variance) {
    result.warnings.insert(result.warnings.begin(),
                           "the reference has no variance channels: its noise, if any, is in every error");
  }
}

void write_report(const std::string& folder, const nlohmann::ordered_json& results, const Reference& reference,
                  const CompareResult& result) {
  make_folder(folder);
  std::vector<PagePicture> pictures{{"", "reference", reference.image}};
  for (const VariantResult& v : result.variants) {
    if (!v.given_up) pictures.push_back({"", v.name, v.image});
  }
  for (const VariantResult& v : result.variants) {
    if (!v.sample_counts.channels.empty())
      pictures.push_back({"", v.name + " samples", v.sample_counts, PagePicture::Kind::samples});
  }
  write_file(error_csv(result), folder + "/error.csv");
  write_file(results.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n", folder + "/results.json");
  write_file(compare_page(results, pictures), folder + "/index.html");
  write_exr(reference.image, folder + "/reference.exr");
  for (const VariantResult& v : result.variants) {
    if (!v.given_up) write_exr(v.image, folder + "/" + picture_file(v.name));
  }
}

/// Interrupted before anything could be reported: a folder that was made for it goes again.
int give_up(const std::string& folder) {
  std::error_code ignored;
  std::filesystem::remove(folder, ignored);  // only if it is empty
  log("tyndall: stopped before a seed was complete: no report\n");
  return stop_exit_code();
}

void print_result(const CompareOptions& o, const CompareResult& result, const nlohmann::ordered_json& results) {
  if (!o.quiet) {
    for (const std::string& w : result.warnings) log("warning: {}\n", w);
    const std::string table = fmt::format("{}{}/index.html\n", compare_table(result), o.folder);
    o.json ? log_text(table) : print_text(table);
  }
  if (o.json) print("{}\n", results.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

int exit_code_of(const CompareResult& result) {
  if (stop_requested()) return stop_exit_code();
  return result.variants.front().given_up ? static_cast<int>(Failure::incomplete) : 0;
}

int run_compare(const CompareOptions& o, const std::string& command) {
  SceneFile file = read_scene(o.scene);
  apply(o.picture, file.scene);
  apply(o.methods, file.scene.settings);
  RenderSettings base = file.scene.settings;
  if (o.threads) base.threads = *o.threads;
  limit_image_threads(base.threads);
  base.reproducible = true;
  base.adaptive = false;  // but for variants that ask for it
  base.aovs = {"Variance"};
  const ComparePlan plan = plan_of(o, base);
  std::optional<Reference> reference;
  if (!o.reference.empty()) reference = read_reference(o.reference);
  make_folder(o.folder);
  const World world = build_for(std::move(file.scene), plan, base, o);
  if (reference) reference->require_fit(world, base, plan.seeds);
  if (!o.quiet) log_text(notes_text(o.scene, file.warnings, world.summary()));

  catch_stop_signals("stopping; what is complete is reported; press again to quit at once\n");
  ProgressDisplay display(o.quiet ? "none" : o.progress);
  if (!reference) reference = make_reference(world, base, plan, o, display);
  if (reference->stopped) return give_up(o.folder);
  CompareResult result = run_plan(world, plan, *reference, display);
  if (result.variants.empty()) return give_up(o.folder);
  warn_of_reference(*reference, o, result);

  const CompareContext context{.scene = o.scene,
                               .options = common_options(o),
                               .command = command,
                               .width = reference->image.width(),
                               .height = reference->image.height(),
                               .threads = base.threads};
  const auto results = compare_json(context, plan, *reference, result);
  save_report(o.folder, [&](const std::string& folder) { write_report(folder, results, *reference, result); });
  print_result(o, result, results);
  return exit_code_of(result);
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code, const std::string& command_line) {
  auto* command = app.add_subcommand("compare", "methods side by side on one scene: error against time, as a report");
  auto options = std::make_shared<CompareOptions>();
  declare(*command, *options);
  command->callback([options, &exit_code, command_line] { exit_code = run_compare(*options, command_line); });
}

}  // namespace tyndall::cli
