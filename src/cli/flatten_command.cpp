#include "cli/command.h"
#include "cli/image_options.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/save.h"
#include "tyndall/deep_image.h"

namespace tyndall::cli {
namespace {

struct FlattenOptions {
  std::string image, output;
  ImageOptions format;
  bool quiet = false;
};

int run_flatten(const FlattenOptions& o) {
  require_image_name(o.output, "-o");
  check_writable(o.output, "-o");
  const ImageFormat format = image_format(o.format, o.output);
  const DeepImage deep = read_deep_exr(o.image);
  save_image(flatten(deep), o.output, format);
  if (!o.quiet) log("{}: {}x{} of {} deep samples\n", o.output, deep.data.width(), deep.data.height(), deep.samples.size());
  return 0;
}

}  // namespace

void add_flatten(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("flatten", "a deep image made flat: its samples over each other, front to back");
  command->footer(
      "Any deep OpenEXR image of scan lines with channels R, G, B, A and Z whose samples are sorted and do not overlap.\n"
      "Exit codes: 0 done, 2 usage, 3 the image cannot be read, 4 the result cannot be written.\n"
      "Example: tyndall flatten plume.deep.exr -o plume.exr");
  auto options = std::make_shared<FlattenOptions>();
  command->add_option("image", options->image, "deep image, .exr")->required();
  command->add_option("-o,--output", options->output, "image to write, .exr, .png or .pfm; -o plume.exr")->required();
  declare(*command, options->format);
  command->add_flag("--quiet", options->quiet, "no summary; errors only");
  command->callback([options, &exit_code] { exit_code = run_flatten(*options); });
}

}  // namespace tyndall::cli
