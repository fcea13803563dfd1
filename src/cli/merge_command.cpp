#include <fmt/core.h>

#include <filesystem>

#include "cli/command.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/save.h"
#include "report/merge.h"
#include "tyndall/error.h"

namespace tyndall::cli {
namespace {

struct MergeOptions {
  std::vector<std::string> slices;
  std::string output;
  MergeSettings settings;
  bool quiet = false;
};

std::string attribute_text(const Image& image, const std::string& name) {
  const Attribute& value = image.attributes.at(name);
  const int* number = std::get_if<int>(&value);
  return number ? std::to_string(*number) : std::get<std::string>(value);
}

int run_merge(const MergeOptions& options) {
  if (std::filesystem::path(options.output).extension() != ".exr") {
    throw Error(Failure::usage, "output " + options.output + " is not understood; give a name that ends in .exr");
  }
  check_writable(options.output);
  const Image image = merge_slices(options.slices, options.settings);
  save_image(image, options.output);
  if (!options.quiet) {
    log("{}: {} x {} pixels at {}, {} from {} image(s), {} samples a pixel, seed {}\n", options.output, image.width(),
        image.height(), image.data.x0, image.data.y0, options.slices.size(), attribute_text(image, "tyndall/samples"),
        attribute_text(image, "tyndall/seed"));
  }
  return 0;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("merge", "join renders of one scene: other seeds, other crops, or both");
  command->footer(
      "Pixels are averaged by their sample counts. Z, P and Zvol stay means over the samples that hit something, exactly:\n"
      "renders count those in SurfaceCount and VolumeCount. Variance becomes that of the joined mean, with its degrees of\n"
      "freedom in Dof. Slices must have the same scene hash, frame and channels; one seed may cover a pixel only once.\n"
      "The order of slices does not matter, and a merged image can be merged again. Exit code 3: they do not go together.\n"
      "Example: tyndall merge seed1.exr seed2.exr -o both.exr");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("slices", options->slices, "images that tyndall render or merge wrote, .exr")->required();
  command->add_option("-o,--output", options->output, "image to write, .exr; -o whole.exr")->required();
  command->add_flag("--fill-black", options->settings.fill_black,
                    "pixels that no slice holds become black, with SampleCount 0, instead of an error");
  command->add_flag("--quiet", options->quiet, "no summary; errors only");
  command->callback([options, &exit_code] { exit_code = run_merge(*options); });
}

}  // namespace tyndall::cli
