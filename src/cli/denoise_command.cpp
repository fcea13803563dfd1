#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/image_options.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/save.h"
#include "tyndall/denoise.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

struct DenoiseOptions {
  std::string image, output;
  ImageOptions format;
  DenoiseSettings settings;
  bool quiet = false, json = false;
};

constexpr const char* kDenoiseFooter =
    "The image must be one that was rendered with --aov Denoise, or merged of such: what is missing is named, with what its\n"
    "absence costs. R G B are denoised, noisy.R .G .B as they were, Mse.R .G .B the squared error expected of R G B.\n"
    "Exit codes: 0 done, 2 usage, 3 the image cannot be read or has no replicates, 4 the result cannot be written.\n"
    "Example: tyndall denoise hall.exr -o clean.exr";

nlohmann::ordered_json as_json(const DenoiseOptions& o, const Denoised& d) {
  return {{"output", o.output},
          {"width", d.image.width()},
          {"height", d.image.height()},
          {"seconds", d.report.seconds},
          {"noisy_relmse", d.report.noisy_relmse},
          {"relmse", d.report.relmse},
          {"missing", d.report.missing}};
}

void check_options(const DenoiseOptions& o) {
  require_image_name(o.output, "-o");
  check_writable(o.output, "-o");
}

int run_denoise(const DenoiseOptions& o) {
  check_options(o);
  const ImageFormat format = image_format(o.format, o.output);
  limit_image_threads(o.settings.threads);
  const Image image = read_image(o.image);
  require_fit(format, image, o.image);
  const Denoised denoised = denoise(image, o.settings, o.image);
  save_image(denoised.image, o.output, format);
  if (!o.quiet) {
    for (const std::string& missing : denoised.report.missing) log("{}: has no {}\n", o.image, missing);
    log("{}: {}x{}, denoised in {:.2f}s, estimated relMSE {:.3g} before and {:.3g} after\n", o.output, denoised.image.width(),
        denoised.image.height(), denoised.report.seconds, denoised.report.noisy_relmse, denoised.report.relmse);
  }
  if (o.json) print("{}\n", as_json(o, denoised).dump(2));
  return 0;
}

}  // namespace

void add_denoise(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("denoise", "take the noise away from an image that was rendered before");
  command->footer(kDenoiseFooter);
  auto options = std::make_shared<DenoiseOptions>();
  command->add_option("image", options->image, "rendered image, .exr")->required();
  command->add_option("-o,--output", options->output, "image to write, .exr, .png or .pfm; -o clean.exr")->required();
  command->add_flag("--components", options->settings.components,
                    "the channels of the light split are denoised as well, in place of staying as rendered");
  command->add_option("--threads", options->settings.threads, "threads [0: one a core]; --threads 2")
      ->check(CLI::Range(0, kMostThreads));
  declare(*command, options->format);
  command->add_flag("--quiet", options->quiet, "no summary; errors only");
  command->add_flag("--json", options->json, "summary as JSON on stdout");
  command->callback([options, &exit_code] { exit_code = run_denoise(*options); });
}

}  // namespace tyndall::cli
