#include "cli/compare_options.h"

#include <fmt/core.h>

#include "cli/validators.h"
#include "cli/variants.h"
#include "tyndall/denoise.h"

namespace tyndall::cli {
namespace {

RaceBudget budget_of(const CompareOptions& o) {
  if (o.spp) return {.seconds = std::nullopt, .samples = o.spp};
  return {.seconds = o.time.value_or(20), .samples = std::nullopt};
}

CompareFilter denoiser(int threads) {
  return {.name = "denoised", .option = "--denoise", .aovs = denoise_aovs(), .apply = [threads](const Image& image) {
            return denoise(image, {.threads = threads}).image;
          }};
}

/// A variant may not be called as another one is once it is filtered.
void require_filtered_names(const ComparePlan& plan) {
  for (const CompareVariant& v : plan.variants) {
    for (const CompareVariant& other : plan.variants) require_own_files(v.name, other.name + " " + plan.filter.name);
  }
}

}  // namespace

void declare(CLI::App& command, CompareOptions& o) {
  declare_scene(command, o.scene);
  command
      .add_option(
          "--variants", o.variants,
          "what to compare: " + preset_names() +
              ", or \"name:--lights power\"; several separated by commas; the "
              "first is what the others are measured by [lights]; --variants \"a:--lights power, b:--lights tree-binary\"")
      ->expected(1)
      ->take_all();
  auto* time =
      command.add_option("--time", o.time, "seconds that each variant renders for each seed [20]; --time 5")->check(positive());
  command.add_option("--spp", o.spp, "samples a pixel for each variant and seed, instead of --time [none]; --spp 64")
      ->check(CLI::Range(1, kMostSamples))
      ->excludes(time);
  command.add_option("--seeds", o.seeds, "runs of each variant; the intervals come from their spread [5]; --seeds 10")
      ->check(CLI::Range(5, 1000));
  command.add_option("--seed", o.seed, "of the first run; the others count up [1]; --seed 100")->check(whole_number());
  auto* reference = command.add_option("--reference", o.reference,
                                       "image that errors are measured against; with channels Variance.R .. its own noise is "
                                       "taken off [rendered]; --reference best.exr");
  command
      .add_option("--reference-error", o.reference_error,
                  "estimated relMSE at which the rendered reference is good enough [0.001]; --reference-error 1e-4")
      ->check(positive())
      ->excludes(reference);
  command
      .add_option("--reference-time", o.reference_time,
                  "seconds to render the reference for, at most [half as long as all runs together; with --spp no limit]; "
                  "--reference-time 600")
      ->check(positive())
      ->excludes(reference);
  command.add_option("-o,--output", o.folder,
                     "folder for index.html, results.json, error.csv and the images [compare-report]; -o report");
  command.add_option("--threads", o.threads, "threads [the Integrator's, else 0: one a core]; --threads 2")
      ->check(CLI::Range(0, kMostThreads));
  declare(command, o.methods);
  declare(command, o.picture);
  declare_memory(command, o.max_memory);
  declare_progress(command, o.progress);
  command.add_flag("--denoise", o.denoise, "each variant a second time, denoised, its time the render's and the denoiser's");
  command.add_flag("--quiet", o.quiet, "no progress, notes or table; errors only");
  command.add_flag("--json", o.json, "results.json on stdout too");
  command.footer("Options of render hold for all variants and for the reference. What is written: see docs/comparing.md.");
}

std::string common_options(const CompareOptions& o) {
  std::string text;
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) text += (text.empty() ? "--" : " --") + option + " " + value;
  };
  for (std::size_t i = 0; i < strategy_axes().size(); ++i) add(std::string(strategy_axes()[i].option), o.methods.strategies[i]);
  if (o.methods.candidates) add("candidates", std::to_string(*o.methods.candidates));
  if (o.methods.splitting) add("splitting", fmt::format("{}", *o.methods.splitting));
  if (o.methods.shadow_rays) add("shadow-rays", std::to_string(*o.methods.shadow_rays));
  add("crop", o.picture.crop);
  add("resolution", o.picture.resolution);
  if (o.picture.max_depth) add("max-depth", std::to_string(*o.picture.max_depth));
  const auto add_flag = [&](bool given, const char* option) {
    if (given) text += (text.empty() ? "" : " ") + std::string(option);
  };
  add_flag(o.picture.sanitize, "--sanitize");
  add_flag(o.denoise, "--denoise");
  return text;
}

ComparePlan plan_of(const CompareOptions& o, const RenderSettings& base) {
  ComparePlan plan{.variants = parse_variants(o.variants.empty() ? std::vector<std::string>{"lights"} : o.variants, base),
                   .budget = budget_of(o),
                   .seeds = {},
                   .filter = o.denoise ? denoiser(base.threads) : CompareFilter()};
  if (o.denoise) require_filtered_names(plan);
  if (o.denoise && o.spp == 1)
    throw Error(Failure::usage, "--denoise needs two samples a pixel, to tell noise from picture; give --spp 2 or more");
  for (int i = 0; i < o.seeds; ++i) plan.seeds.push_back(o.seed + static_cast<std::uint64_t>(i));
  return plan;
}

}  // namespace tyndall::cli
