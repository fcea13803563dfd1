#include <filesystem>

#include "cli/command.h"
#include "cli/diff_text.h"
#include "cli/log.h"
#include "cli/print.h"
#include "cli/validators.h"
#include "report/error_picture.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

constexpr const char* kFooter =
    "The second image is the reference: differences are image - reference. Which of the criteria above are given must all\n"
    "hold; with none, --test if both images have R G B and Variance.R .G .B (render --aov Variance), else --exact. NaN,\n"
    "infinity, negative variances, different data windows and a channel that one image lacks always differ (--channels RGB\n"
    "looks at the picture alone).\n"
    "Exit codes: 0 same, 5 differs, 2 usage, 3 an image cannot be read, 4 the error picture or stdout cannot be written.\n"
    "Examples:\n"
    "  tyndall diff new.exr reference.exr                        the statistical test, or equality\n"
    "  tyndall diff new.exr reference.exr --max-relmse 0.001 -o error.png\n"
    "  tyndall diff a.exr b.exr --exact --no-flip --json\n"
    "  tyndall diff a.exr b.exr --test --level 0.01 --block 16\n"
    "  tyndall diff shown.png reference.png --max-flip 0.05 --ppd 40";

/// Of R, G and B where both images have them, else of all they have in common.
void write_picture(const DiffOptions& options, const Image& image, const Image& reference, const ImageDiff& diff) {
  if (options.picture.empty()) return;
  if (diff.channels.empty()) {
    log("tyndall: {}: no error picture is made; the images have other data windows, or no channels in common\n",
        options.picture);
    return;
  }
  std::vector<std::string> channels;
  for (const GroupDiff& g : diff.groups) {
    if (g.name == "RGB") channels = g.channels;
  }
  if (channels.empty()) {
    for (const ChannelDiff& c : diff.channels) channels.push_back(c.name);
  }
  write_png(error_picture(image, reference, channels), options.picture);
}

int run_diff(const DiffOptions& options) {
  if (!options.picture.empty() && std::filesystem::path(options.picture).extension() != ".png") {
    throw Error(Failure::usage, options.picture + ": the error picture is a PNG; give a name that ends in .png");
  }
  const Image image = read_image(options.image), reference = read_image(options.reference);
  const ImageDiff diff = compare_images(image, reference, options.settings);
  const Judgement judgement = judge(diff, options.criteria);
  print("{}\n", options.json ? as_json(diff, judgement, options) : as_text(diff, judgement, options));
  write_picture(options, image, reference, diff);
  return judgement.same ? 0 : static_cast<int>(Failure::differs);
}

void declare(CLI::App& command, DiffOptions& o) {
  command.add_option("image", o.image, "image to judge (.exr, .png, .hdr, .jpg, .tga, .bmp)")->required();
  command.add_option("reference", o.reference, "image it is held against")->required();
  command.add_option("-o,--output", o.picture,
                     "error picture, a PNG: relative squared error, black up to 1e-4, pale yellow from 10; not made when the "
                     "images have other data windows, or no channels in common; -o error.png");
  command.add_flag("--json", o.json, "as JSON on stdout");
  command
      .add_option("--channels", o.settings.channels, "look at these only: channels (Z) or groups (RGB, Albedo); example: RGB,Z")
      ->delimiter(',');
  command.add_flag(
      "--reference-noise", o.settings.reference_noise,
      "also errors of RGB without the reference's own noise, known from its Variance; --max-relmse then judges these");
  command.add_flag_callback(
      "--no-flip", [&o] { o.settings.flip = false; }, "leave out FLIP, the slowest of the metrics");
  command
      .add_option("--ppd", o.settings.flip_settings.pixels_per_degree,
                  "pixels a degree of the viewer's field, for FLIP; --ppd 40")
      ->check(positive())
      ->capture_default_str();
}

/// Under a heading of their own in --help.
void declare_criteria(CLI::App& command, DiffOptions& o) {
  const std::string criteria = "Criteria";
  command.add_flag("--test", o.criteria.test, "RGB is the same but for noise: blocks, means and p-values of Welch's test")
      ->group(criteria);
  command.add_flag("--exact", o.criteria.exact, "every value of every channel is equal")->group(criteria);
  command.add_option("--max-error", o.criteria.max_error, "no value is off by more, absolutely; example: 0.001")
      ->check(non_negative())
      ->group(criteria);
  command.add_option("--max-relmse", o.criteria.max_relmse, "no group's relMSE (eps 0.01) is larger; example: 0.001")
      ->check(non_negative())
      ->group(criteria);
  command.add_option("--max-flip", o.criteria.max_flip, "mean HDR-FLIP of RGB is not larger, 0 to 1; example: 0.05")
      ->check(fraction())
      ->group(criteria);
  command
      .add_option("--level", o.settings.test.family_level,
                  "of --test: chance of calling two equal pictures different, above 0 and below 1; --level 0.01")
      ->check(open_fraction())
      ->capture_default_str()
      ->group(criteria);
  command.add_option("--block", o.settings.test.block_size, "of --test: pixels a side of a block; --block 16")
      ->check(whole_number(1, 65536))
      ->capture_default_str()
      ->group(criteria);
}

}  // namespace

void add_diff(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("diff", "metrics, statistical test and error picture of two images");
  command->footer(kFooter);
  auto options = std::make_shared<DiffOptions>();
  declare(*command, *options);
  declare_criteria(*command, *options);
  command->callback([options, &exit_code] { exit_code = run_diff(*options); });
}

}  // namespace tyndall::cli
