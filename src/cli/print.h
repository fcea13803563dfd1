/// What a command answers, on stdout.
#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>

namespace tyndall::cli {

/// Throws Error (output) when stdout is known to take no more. What is still buffered is checked at the end of main().
void print_text(const std::string& text);
/// At once, for who watches.
void print_now(const std::string& text);
/// Throws Error (output) unless everything printed so far was taken.
void finish_printing();

template <typename... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  print_text(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace tyndall::cli
