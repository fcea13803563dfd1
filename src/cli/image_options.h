/// The options that say how an image is written.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

#include "tyndall/image.h"
#include "tyndall/image_format.h"

namespace tyndall::cli {

struct ImageOptions {
  bool half = false, parts = false;
  std::string compression, view;  ///< empty: not given
  std::optional<double> exposure;
};

void declare(CLI::App& command, ImageOptions& options);

/// What they mean for a file of this name. Throws Error (usage) for an option that it has no use for.
ImageFormat image_format(const ImageOptions& options, const std::string& path);

/// Throws Error (usage) where a file of this name would not keep what `image` has: mattes are ids, of which every bit counts.
void require_fit(const ImageFormat& format, const Image& image, const std::string& path);

/// Throws Error (usage) unless an image can be written under this name; `option` stands for it in the message.
void require_image_name(const std::string& path, const std::string& option);

}  // namespace tyndall::cli
