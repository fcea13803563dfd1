#include "cli/command.h"
#include "cli/image_options.h"
#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/save.h"
#include "report/relight.h"
#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

struct RelightOptions {
  std::string image, output;
  ImageOptions format;
  std::vector<std::string> factors;
  bool quiet = false;
};

constexpr const char* kRelightFooter =
    "The image must be one that was rendered from a scene whose lights have \"string lightgroup\": its groups are in channels\n"
    "LightGroup.NAME.R and so on. A factor is one number, or three for R, G and B; groups that are not named keep their "
    "light.\n"
    "R G B become the sum of the groups, Replicate and Variance follow. The light split of --aov is left out where groups\n"
    "differ in their factors, since it is not kept by groups.\n"
    "Exit codes: 0 done, 2 usage, 3 the image cannot be read or has no groups, 4 the result cannot be written.\n"
    "Example: tyndall relight hall.exr key=1.5 sky=0.3,0.3,0.5 -o evening.exr";

void check_options(const RelightOptions& o) {
  require_image_name(o.output, "-o");
  check_writable(o.output, "-o");
}

int run_relight(const RelightOptions& o) {
  check_options(o);
  const ImageFormat format = image_format(o.format, o.output);
  std::vector<GroupFactor> factors;
  for (const std::string& text : o.factors) factors.push_back(parse_group_factor(text));
  Image image = read_image(o.image);
  require_fit(format, image, o.image);
  const Relit relit = relight(std::move(image), factors, o.image);
  save_image(relit.image, o.output, format);
  if (o.quiet) return 0;
  for (const std::string& channel : relit.left_out)
    log("{}: {} is left out, since it is not known by light groups\n", o.output, channel);
  log("{}: {}x{}, {}\n", o.output, relit.image.width(), relit.image.height(),
      *relit.image.attribute<std::string>(attributes::kRelight));
  return 0;
}

}  // namespace

void add_relight(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("relight", "mix the light groups of a rendered image anew");
  command->footer(kRelightFooter);
  auto options = std::make_shared<RelightOptions>();
  command->add_option("image", options->image, "rendered image with light groups, .exr")->required();
  command->add_option("factors", options->factors, "NAME=FACTOR or NAME=R,G,B for each group that changes");
  command->add_option("-o,--output", options->output, "image to write, .exr, .png or .pfm; -o evening.exr")->required();
  declare(*command, options->format);
  command->add_flag("--quiet", options->quiet, "no summary; errors only");
  command->callback([options, &exit_code] { exit_code = run_relight(*options); });
}

}  // namespace tyndall::cli
