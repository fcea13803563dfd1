/// Text for people, on stderr.
#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <string>
#include <utility>

namespace tyndall::cli {

/// Unlike fmt::print this never throws: a closed or full stderr must not cost a render.
inline void log_text(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

template <typename... Args>
void log(fmt::format_string<Args...> format, Args&&... args) {
  log_text(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace tyndall::cli
