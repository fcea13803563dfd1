#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <thread>

#include "cli/command.h"
#include "cli/frame_list.h"
#include "cli/log.h"
#include "cli/merge_inputs.h"
#include "cli/merge_report.h"
#include "cli/output_paths.h"
#include "cli/render_options.h"
#include "cli/save.h"
#include "cli/stop_signal.h"
#include "cli/validators.h"
#include "report/merge.h"
#include "tyndall/error.h"
#include "tyndall/frames.h"
#include "tyndall/image_attributes.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

struct MergeOptions {
  std::vector<std::string> slices;
  std::string output, deep, frames;
  MergeSettings settings;
  std::optional<double> error, watch;
  bool quiet = false;
};

std::string attribute_text(const Image& image, const std::string& name) {
  const Attribute& value = image.attributes.at(name);
  const int* number = std::get_if<int>(&value);
  return number ? std::to_string(*number) : std::get<std::string>(value);
}

void report(const Merged& merged, const MergeOptions& options) {
  const Image& image = merged.image;
  if (!options.quiet) {
    log("{}: {} x {} pixels at {}, {} from {} image(s), {} samples a pixel, seed {}\n", options.output, image.width(),
        image.height(), image.data.x0, image.data.y0, merged.images, attribute_text(image, attributes::kSamples),
        attribute_text(image, attributes::kSeed));
  }
  if (!options.quiet || !merged.complete()) log_text(as_text(merged, options.error));
}

Merged merge_once(const MergeOptions& options, const std::vector<std::string>& files) {
  Merged merged = merge_slices(files, options.settings);
  if (!options.deep.empty() && !merged.deep)
    throw Error(Failure::usage, "--deep is for slices that were rendered with --deep, all of one render; leave it out");
  save_image(merged.image, options.output);
  if (!options.deep.empty()) save_deep_image(*merged.deep, options.deep);
  report(merged, options);
  return merged;
}

/// Again whenever something has come, until all slices are there.
int merge_again_and_again(const MergeOptions& options) {
  constexpr auto kLook = std::chrono::milliseconds(100);  // for a stop
  catch_stop_signals("stopping; the picture of what has come stays\n");
  MergeInputs seen;
  for (;;) {
    MergeInputs inputs = merge_inputs(options.slices, options.output);
    if (inputs.any_there() && inputs != seen) {
      try {
        if (merge_once(options, inputs.paths).complete()) return 0;
      } catch (const Error& e) {
        if (e.failure() != Failure::scene) throw;
        log("tyndall: {}; waiting for a change\n", e.what());
      }
      seen = std::move(inputs);
    }
    const Timer waiting;
    while (waiting.seconds() < *options.watch) {
      if (stop_requested()) return stop_exit_code();
      std::this_thread::sleep_for(kLook);
    }
  }
}

int merge_one(const MergeOptions& options) {
  if (std::filesystem::path(options.output).extension() != ".exr") {
    throw Error(Failure::usage, "output " + options.output + " is not understood; give a name that ends in .exr");
  }
  check_writable(options.output, "-o");
  if (!options.deep.empty()) {
    require_deep_name(options.deep, options.output);
    check_writable(options.deep, "--deep");
  }
  if (options.watch) return merge_again_and_again(options);
  const bool complete = merge_once(options, merge_inputs(options.slices, options.output).paths).complete();
  return complete ? 0 : static_cast<int>(Failure::incomplete);
}

/// Each frame by itself; the exit code is that of the first that is not complete.
int run_merge(const MergeOptions& options) {
  if (options.frames.empty()) return merge_one(options);
  if (options.watch) throw Error(Failure::usage, "--watch is for one picture; leave it or --frames out");
  require_frame_place(options.output, "-o");
  if (!options.deep.empty()) require_frame_place(options.deep, "--deep");
  int exit_code = 0;
  for (const int frame : frames_in(options.frames)) {
    MergeOptions one = options;
    for (std::string& name : one.slices) name = with_frame(name, frame);
    one.output = with_frame(options.output, frame);
    one.deep = with_frame(options.deep, frame);
    const int code = merge_one(one);
    if (exit_code == 0) exit_code = code;
  }
  return exit_code;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("merge", "join renders of one scene: slices, other seeds, other crops");
  command->footer(
      "Pixels are averaged by their sample counts. Z, P and Zvol stay means over the samples that hit something, exactly:\n"
      "renders count those in SurfaceCount and VolumeCount. Variance becomes that of the joined mean, with its degrees of\n"
      "freedom in Dof. Slices must have the same scene hash, frame and channels; one seed may cover a pixel only once.\n"
      "The order of slices does not matter, and a merged image can be merged again. Exit code 3: they do not go together.\n"
      "All slices of one render (render --slice) give the image of the whole, bit for bit. When some are missing or damaged\n"
      "those that came are merged, the others named with the commands that render them, and the exit code is 7.\n"
      "Example: tyndall merge seed1.exr seed2.exr -o both.exr");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("slices", options->slices, "images that tyndall render or merge wrote, .exr, and folders of them")
      ->required();
  command->add_option("-o,--output", options->output, "image to write, .exr; -o whole.exr")->required();
  command->add_option(
      "--deep", options->deep,
      "deep image to write as well, .exr, of slices that were rendered with --deep [none]; --deep whole.deep.exr");
  declare_frames(*command, options->frames);
  command->add_flag("--fill-black", options->settings.fill_black,
                    "pixels that no slice holds become black, with SampleCount 0, instead of an error");
  command
      ->add_option("--error", options->error,
                   "relMSE that is wanted: the summary says how many samples more it takes [none]; --error 0.001")
      ->check(positive());
  command
      ->add_option("--watch", options->watch,
                   "seconds between looks: the picture of the slices that have come is written again and again, until all are "
                   "there [none]; --watch 30")
      ->check(positive());
  command->add_flag("--quiet", options->quiet, "no summary; errors only");
  command->callback([options, &exit_code] { exit_code = run_merge(*options); });
}

}  // namespace tyndall::cli
