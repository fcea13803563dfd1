/// Files that a scene names.
#pragma once

#include <optional>
#include <string>

#include "tyndall/io.h"

namespace tyndall {

/// The path of the file, with `frame` in the places for it; Error at asset.where when no such file exists.
std::string require_asset(const FrameName& asset, std::optional<int> frame);

}  // namespace tyndall
