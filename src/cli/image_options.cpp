#include "cli/image_options.h"

#include <algorithm>
#include <filesystem>

#include "cli/option_values.h"
#include "cli/validators.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

CLI::IsMember one_of(const std::vector<std::string_view>& names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

/// The enum whose names these are; `otherwise` when none is given.
template <typename Enum>
Enum chosen(const std::string& name, const std::vector<std::string_view>& names, Enum otherwise) {
  if (name.empty()) return otherwise;
  return static_cast<Enum>(std::find(names.begin(), names.end(), name) - names.begin());
}

void refuse(bool given, const std::string& option, const std::string& path, const std::string& ending) {
  if (given)
    throw Error(Failure::usage, option + " is for " + ending + " files, which " + path +
                                    " is none of; leave it out, or give a "
                                    "name that ends in " +
                                    ending);
}

}  // namespace

void declare(CLI::App& command, ImageOptions& o) {
  command.add_flag(
      "--half", o.half,
      "colours of an .exr as 16-bit floats, clamped to 65504; depths, positions, counts and variances stay 32-bit");
  command
      .add_option(
          "--compression", o.compression,
          "packing of an .exr: " + join(exr_compression_names(), ", ") + "; the last two are lossy [zip]; --compression piz")
      ->check(one_of(exr_compression_names()));
  command.add_flag("--parts", o.parts, "an .exr of several parts, one for each group of channels: rgba, Albedo ...");
  command.add_option("--view", o.view, "from light to what a .png shows: " + join(view_names(), ", ") + " [srgb]; --view agx")
      ->check(one_of(view_names()));
  command.add_option("--exposure", o.exposure, "stops that a .png is made brighter by, before --view [0]; --exposure 1.5")
      ->check(number_between(-64, 64));
}

ImageFormat image_format(const ImageOptions& o, const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".exr") {
    refuse(o.half, "--half", path, ".exr");
    refuse(o.parts, "--parts", path, ".exr");
    refuse(!o.compression.empty(), "--compression", path, ".exr");
  }
  if (ending != ".png") {
    refuse(!o.view.empty(), "--view", path, ".png");
    refuse(o.exposure.has_value(), "--exposure", path, ".png");
  }
  ImageFormat format;
  format.exr = {
      .half = o.half, .compression = chosen(o.compression, exr_compression_names(), ExrCompression::zip), .parts = o.parts};
  format.png = {.exposure = static_cast<float>(o.exposure.value_or(0)),
                .view = chosen(o.view, view_names(), DisplayView::srgb)};
  return format;
}

void require_fit(const ImageFormat& format, const Image& image, const std::string& path) {
  const auto& channels = image.channels;
  if (is_lossy(format.exr.compression) &&
      std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return is_matte_channel(c.name); }))
    throw Error(Failure::usage, path + ": has mattes, ids that lossy --compression would change; leave it out");
}

void require_image_name(const std::string& path, const std::string& option) {
  if (is_written_image(path)) return;
  throw Error(Failure::usage, option + " " + path + " is not understood; give a name that ends in .exr, .png or .pfm");
}

}  // namespace tyndall::cli
