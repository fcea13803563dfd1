/// What is written at the end: hours of work that must end up somewhere.
#pragma once

#include <functional>
#include <string>

#include "tyndall/deep_image.h"
#include "tyndall/image.h"
#include "tyndall/image_format.h"

namespace tyndall::cli {

/// write_image() for a finished image. When that fails it tries again a few times, since disks get cleared, then writes to the
/// folder for temporary files, the home folder or the current one. With the image safe there, `make_room` (may be empty; must
/// not throw) is called and `path` tried once more; when this fails as well, throws Error (output) that says where the image
/// is.
void save_image(const Image& image, const std::string& path, const ImageFormat& format = {},
                const std::function<void()>& make_room = {});

/// The same for a deep image, without `make_room`.
void save_deep_image(const DeepImage& image, const std::string& path);

/// The same for a report: `write` puts it into the folder that it is given, which it makes, and throws Error when it cannot.
void save_report(const std::string& folder, const std::function<void(const std::string& folder)>& write);

}  // namespace tyndall::cli
