/// Pictures as text that a web page unfolds.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tyndall/image.h"

namespace tyndall {

/// The nearest IEEE 754 binary16 number, ties to even. Beyond its range: the largest, 65504. NaN and infinity stay.
std::uint16_t to_half(float value);

/// Base64 with padding [RFC 4648].
std::string base64(std::string_view bytes);

/// Base64 of the deflated [RFC 1950] planes of R, G and B, row by row, as half floats; of each plane first all high
/// bytes, then all low ones, for the high ones are alike and pack well. Throws Error when there are no pixels or no colour.
std::string encode_picture(const Image& image);

}  // namespace tyndall
