#include "cli/render_options.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

#include "cli/frame_list.h"
#include "cli/option_values.h"
#include "cli/validators.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/denoise.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

constexpr int kUsualDeepBins = 16;

/// AOVs by name, several names for some.
std::vector<std::string> aovs_in(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');) {
    if (name.empty()) continue;
    const auto named = aovs_named(name);
    names.insert(names.end(), named.begin(), named.end());
  }
  return names;
}

void set_samples(const RenderOptions& options, RenderSettings& settings) {
  if (options.spp) settings.spp = *options.spp;
  if (options.time) settings.time = *options.time;
  if (options.error) settings.error = *options.error;
  if (options.error_max) settings.error_max = *options.error_max;
  if (options.adaptive) settings.adaptive = *options.adaptive;
  // A limit of time or error alone leaves the number of samples open.
  if (!options.spp && (options.time || options.error || options.error_max)) settings.spp = std::numeric_limits<int>::max();
}

void set_slice(const RenderOptions& options, RenderSettings& settings) {
  if (options.slice.empty()) return;
  const auto numbers = integers(options.slice, '/');
  if (numbers.size() != 2) refuse_value("--slice", options.slice, "I/N, such as 3/16");
  settings.slice = SliceChoice{numbers[0], numbers[1]};
  if (!options.reference.empty()) throw Error(Failure::usage, "--slice has no --error-log: a part's error is not the whole's");
  sample_range(settings);  // throws for what cannot be
}

}  // namespace

void declare_progress(CLI::App& command, std::string& progress) {
  command
      .add_option("--progress", progress, "bar, line, json or none, on stderr [bar on a terminal, else line]; --progress json")
      ->check(CLI::IsMember({"auto", "bar", "line", "json", "none"}));
}

void declare_memory(CLI::App& command, std::optional<double>& max_memory) {
  command
      .add_option("--max-memory", max_memory,
                  "GB: a scene that is estimated to need more is refused before it is built [what the machine, or a "
                  "container's limit, allows]; --max-memory 8")
      ->check(positive());
}

void declare_scene(CLI::App& command, std::string& scene) {
  command.add_option("scene", scene, "scene file, .pbrt or .pbrt.gz")->required();
}

void declare_task(CLI::App& command, RenderOptions& o) {
  declare_scene(command, o.scene);
  command.add_option("-o,--output", o.output,
                     "image to write, .exr, .png or .pfm [the Film's name, else SCENE.exr]; -o plume.exr");
  command.add_option("--spp", o.spp, "samples a pixel, at most [the Sampler's, else 16]; --spp 256")
      ->check(CLI::Range(1, kMostSamples));
  command
      .add_option("--time", o.time,
                  "seconds to render for, at most; without --spp the samples are as many as that gives [none]; --time 60")
      ->check(positive());
  command.add_option("--threads", o.threads, "threads [0: one a core]; --threads 2")->check(CLI::Range(0, kMostThreads));
  command.add_option("--seed", o.seed, "of the random numbers [0, with --frames the frame]; --seed 7")->check(whole_number());
  declare(command, o.picture);
  declare(command, o.methods);
  command.add_option("--aov", o.aovs,
                     "extra channels of an .exr image, comma-separated: " + join(aov_names(), ", ") +
                         "; Denoise: all that tyndall denoise takes; Cryptomatte: all mattes [none]; --aov Albedo,N");
  command
      .add_option_function<std::string>("--light-group",
                                        [](const std::string&) {
                                          throw Error(Failure::usage,
                                                      "--light-group cannot be: lights have no names in the scene format; "
                                                      "give them \"string lightgroup\" in the scene");
                                        })
      ->group("");  // not listed: it is told to those who look for it
  command.add_flag("--reproducible", o.reproducible, "leave dates and times out of the image header");
  declare_frames(command, o.frames);
  declare_progress(command, o.progress);
}

namespace {

void declare_end(CLI::App& command, RenderOptions& o) {
  command
      .add_option("--error", o.error,
                  "stop when the estimated relMSE, mean of variance / (mean^2 + 0.01), is below this; looked at when "
                  "there is the work of 32, 40, 48, 56, 64, 72 ... samples a pixel, with --no-adaptive of 64, 128, 256 ... "
                  "[none]; --error 0.001")
      ->check(positive());
  command
      .add_option("--error-max", o.error_max,
                  "stop when the estimated relMSE of no part of the picture, a block of 8 x 8 pixels with those around it, is "
                  "above this; beside --error both must hold; looked at as often, and samples go where it takes them "
                  "[none]; --error-max 0.01")
      ->check(positive());
  command.add_flag_function(
      "--adaptive,!--no-adaptive", [&o](std::int64_t times) { o.adaptive = times > 0; },
      "more samples where the error is, after 8 everywhere; --spp is then the most that a pixel gets [with "
      "--error or --error-max, else not]; --adaptive");
  command.add_option(
      "--slice", o.slice,
      "only the I-th of N slices of the samples, of which --spp is the number of all; tyndall merge adds them up to the "
      "same image, bit for bit [all samples]; --slice 3/16");
}

void declare_more_pictures(CLI::App& command, RenderOptions& o) {
  auto* deep = command.add_option("--deep", o.deep,
                                  "deep image to write as well, .exr: light and opacity by depth, for compositing in smoke "
                                  "[none]; --deep plume.deep.exr");
  command
      .add_option("--deep-bins", o.deep_bins,
                  "of equal depth through the media, in which the deep image tells their light apart [16]; --deep-bins 64")
      ->check(CLI::Range(1, kMostDeepBins))
      ->needs(deep);
  auto* denoise = command.add_flag("--denoise", o.denoise,
                                   "take the noise away at the end; an .exr keeps the picture as rendered in noisy.R .G .B");
  command
      .add_option("--preview-every", o.preview_every,
                  "seconds between denoised pictures written to the output while it renders, at 4, 8, 16 ... samples [none]; "
                  "--preview-every 30")
      ->check(positive())
      ->needs(denoise);
}

void declare_viewers(CLI::App& command, RenderOptions& o) {
  command.add_option(
      "--display", o.display,
      "HOST:PORT of a viewer that speaks tev's protocol: it is shown the picture at 1, 2, 4 ... samples and at the "
      "end [none]; --display 127.0.0.1:14158");
  command
      .add_option("--serve", o.serve,
                  "PORT or HOST:PORT of a page that shows the render as it goes to browsers of this machine, or of those that "
                  "reach HOST [none; without a port one that is free]; --serve 8080")
      ->expected(0, 1);
}

void declare_records(CLI::App& command, RenderOptions& o) {
  auto* reference = command.add_option("--reference", o.reference,
                                       "image that the error is measured against for --error-log; --reference best.exr");
  auto* log = command.add_option("--error-log", o.error_log,
                                 "file that gets a line of JSON at 1, 2, 4, 8 ... samples and at the end: seconds, samples, "
                                 "errors; --error-log error.jsonl");
  reference->needs(log);
  log->needs(reference);
  command
      .add_option("--checkpoint", o.checkpoint,
                  "seconds between saves to OUTPUT.checkpoint, which --resume goes on from; removed when the render is "
                  "complete [none]; --checkpoint 60")
      ->check(positive());
  command.add_flag(
      "--resume", o.resume,
      "go on from OUTPUT.checkpoint if there is one: the same bits as an unbroken render; an interrupt saves there again");
}

}  // namespace

void declare(CLI::App& command, RenderOptions& o) {
  declare_task(command, o);
  declare_end(command, o);
  declare_more_pictures(command, o);
  declare_viewers(command, o);
  declare_records(command, o);
  declare(command, o.image);
  declare_memory(command, o.max_memory);
  command.add_flag("--quiet", o.quiet, "no progress, notes or summary; errors only");
  command.add_flag("--json", o.json, "summary as JSON on stdout");
}

void apply(const RenderOptions& o, Scene& scene) {
  RenderSettings& s = scene.settings;
  set_samples(o, s);
  if (o.threads) s.threads = *o.threads;
  if (o.seed) s.seed = *o.seed;
  s.reproducible = s.reproducible || o.reproducible;
  set_slice(o, s);
  if (!o.deep.empty()) s.deep_bins = o.deep_bins.value_or(kUsualDeepBins);
  apply(o.methods, s);
  apply(o.picture, scene);
  if (!o.aovs.empty()) s.aovs = aovs_in(o.aovs);
  for (const std::string& name : s.aovs) {
    const auto known = aov_names();
    if (std::find(known.begin(), known.end(), name) == known.end()) refuse_value("--aov", name, join(known, ", "));
  }
}

namespace {

/// A slice holds exact sums, in one place.
void require_exact(const ImageOptions& image, const std::string& path) {
  const ExrSettings exr = image_format(image, path).exr;
  const bool exact = !exr.half && !is_lossy(exr.compression);
  if (std::filesystem::path(path).extension() != ".exr")
    refuse_value("output", path, "a name that ends in .exr: a slice holds exact sums");
  if (!exact || exr.parts)
    throw Error(Failure::usage, "--slice keeps exact sums, in one part; leave --half, --parts and lossy --compression out");
}

/// Ids are names, of which every bit counts.
void require_exact_mattes(const ImageOptions& image, const std::string& path, const std::vector<std::string>& aovs) {
  const bool mattes = std::any_of(aovs.begin(), aovs.end(), is_matte_layer);
  if (mattes && is_lossy(image_format(image, path).exr.compression))
    throw Error(Failure::usage, "mattes are ids, which lossy --compression would change; leave it, or Crypto of --aov, out");
}

}  // namespace

void require_end(const RenderSettings& settings) {
  if (settings.adaptive.value_or(false) && !settings.error && !settings.error_max && !settings.time)
    throw Error(Failure::usage, "--adaptive says where samples go, not how many; give --error, --error-max or --time with it");
}

void require_deep_name(const std::string& deep, const std::string& output) {
  if (std::filesystem::path(deep).extension() != ".exr") refuse_value("--deep", deep, "a name that ends in .exr");
  if (std::filesystem::path(deep).lexically_normal() == std::filesystem::path(output).lexically_normal())
    throw Error(Failure::usage, "--deep " + deep + " is the flat image's name too; give another");
}

std::string output_path(const RenderOptions& options, const Scene& scene) {
  namespace fs = std::filesystem;
  std::string path = options.output;
  const std::string named = fs::path(scene.film.filename).filename();
  if (path.empty() && is_written_image(named)) path = named;
  if (path.empty()) {
    fs::path name = fs::path(options.scene).filename();
    while (name.extension() == ".gz" || name.extension() == ".pbrt") name = name.stem();
    path = name.string() + ".exr";
  }
  require_image_name(path, "output");
  image_format(options.image, path);  // throws for what does not fit
  const bool shown = options.serve || !options.display.empty();
  if (!options.aovs.empty() && !shown && fs::path(path).extension() != ".exr")
    throw Error(Failure::usage, path + ": --aov makes channels of .exr images; give a name that ends so, or leave it out");
  if (scene.settings.slice) require_exact(options.image, path);
  require_exact_mattes(options.image, path, scene.settings.aovs);
  if (!options.deep.empty()) require_deep_name(options.deep, path);
  return path;
}

}  // namespace tyndall::cli
