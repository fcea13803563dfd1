/// Names and messages in UTF-8, and bytes that only claim to be.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tyndall {

/// Bytes of the character at `at`, 1 to 4; 0 when there is none by RFC 3629: a stray or missing byte, a surrogate, or more
/// bytes than it needs.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// Characters, each bad byte counted as one: the columns of a table, of scripts whose letters are one column wide.
std::size_t utf8_count(std::string_view text);

/// The text, each bad byte as U+FFFD.
std::string valid_utf8(std::string_view text);

}  // namespace tyndall
