/// The attributes of an image file that is a slice of a render.
#pragma once

#include <string>

#include "tyndall/image.h"

namespace tyndall {

/// Channels "Sum.*".
bool is_sum(const std::string& channel);

/// 16 hexadecimal digits that stand for all of them.
std::string hash_of_sums(const Image& image);

/// Throws Error (scene): `path` has to be rendered again.
[[noreturn]] void refuse_slice(const std::string& path, const std::string& what);

/// Throws refuse_slice's error when there is none.
const std::string& text_attribute(const Image& header, const std::string& path, const char* name);

}  // namespace tyndall
