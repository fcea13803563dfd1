#include "cli/command.h"
#include "cli/image_options.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/print.h"
#include "cli/save.h"
#include "report/matte.h"
#include "tyndall/error.h"
#include "tyndall/io.h"
#include "tyndall/utf8.h"

namespace tyndall::cli {
namespace {

struct MatteOptions {
  std::string image, layer, output;
  ImageOptions format;
  std::vector<std::string> names;
  bool quiet = false;
};

constexpr const char* kMatteFooter =
    "The image must be one that was rendered with --aov Cryptomatte, or a layer of it. Without names those that it has are\n"
    "listed, with the share of the picture that each covers. The matte has the coverage in R, G and B.\n"
    "Exit codes: 0 done, 2 usage, 3 the image cannot be read or has no mattes, 4 the result cannot be written.\n"
    "Example: tyndall matte hall.exr table chair -o furniture.png";

int list(const MatteOptions& o) {
  const std::vector<MatteEntry> entries = list_mattes(read_image(o.image), o.image);
  std::size_t width = 0;
  for (const MatteEntry& entry : entries) width = std::max(width, utf8_count(entry.name));
  for (const MatteEntry& entry : entries) {
    if (!o.layer.empty() && entry.layer != o.layer) continue;
    const std::string space(width - utf8_count(entry.name), ' ');
    print("{:14}  {}{}  {:08x}  {:.6f}\n", entry.layer, entry.name, space, entry.id, entry.coverage);
  }
  return 0;
}

int run_matte(const MatteOptions& o) {
  if (o.names.empty() != o.output.empty())
    throw Error(Failure::usage, "names and -o go together; give both, or none to see which names there are");
  if (o.names.empty()) return list(o);
  require_image_name(o.output, "-o");
  check_writable(o.output, "-o");
  const ImageFormat format = image_format(o.format, o.output);
  const Image matte = take_matte(read_image(o.image), o.names, o.layer, o.image);
  save_image(matte, o.output, format);
  if (!o.quiet) log("{}: {}x{}\n", o.output, matte.width(), matte.height());
  return 0;
}

}  // namespace

void add_matte(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("matte", "what covers which part of a rendered image: list it, or write its matte");
  command->footer(kMatteFooter);
  auto options = std::make_shared<MatteOptions>();
  command->add_option("image", options->image, "rendered image with mattes, .exr")->required();
  command->add_option("names", options->names, "of what the matte is of, together");
  command->add_option("-o,--output", options->output, "image to write, .exr, .png or .pfm [none]; -o table.png");
  command
      ->add_option("--layer", options->layer,
                   "CryptoObject, CryptoMaterial or CryptoMedium [the first that has all names]; --layer CryptoMaterial")
      ->check(CLI::IsMember({"CryptoObject", "CryptoMaterial", "CryptoMedium"}));
  declare(*command, options->format);
  command->add_flag("--quiet", options->quiet, "no summary; errors only");
  command->callback([options, &exit_code] { exit_code = run_matte(*options); });
}

}  // namespace tyndall::cli
