/// The attributes of an image file that is a slice of a render.
#pragma once

#include <string>

#include "tyndall/image.h"

namespace tyndall {

inline constexpr const char* kSlice = "tyndall/slice";           ///< "3/16 of 1024 samples 128..192", and more words
inline constexpr const char* kAovs = "tyndall/aov";              ///< those asked for: "Albedo,Z"
inline constexpr const char* kFilmSpace = "tyndall/fromRec709";  ///< the film's colour matrix
inline constexpr const char* kDeepLayout = "tyndall/deep";       ///< DeepLayout, where there is a deep image
inline constexpr const char* kSumHash = "tyndall/sumHash";       ///< hash_of_sums

/// Channels "Sum.*".
bool is_sum(const std::string& channel);

/// 16 hexadecimal digits that stand for all of them.
std::string hash_of_sums(const Image& image);

/// Throws Error (scene): `path` has to be rendered again.
[[noreturn]] void refuse_slice(const std::string& path, const std::string& what);

/// Throws refuse_slice's error when there is none.
const std::string& text_attribute(const Image& header, const std::string& path, const char* name);

}  // namespace tyndall
