#include "cli/validators.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace tyndall::cli {
namespace {

/// All of `text` as a number; nothing when it is none or does not fit.
template <typename Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data() + text.starts_with('+'), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

/// Long input is shown by its beginning.
std::string shown(const std::string& text) {
  constexpr std::size_t kMost = 40;
  return text.size() > kMost ? text.substr(0, kMost) + "..." : text;
}

/// Passes what `accepts` a parsed number; else says "must be `wanted`, not `text`".
template <typename Number, typename Accepts>
CLI::Validator check(const std::string& name, const std::string& wanted, Accepts accepts) {
  return {[wanted, accepts](std::string& text) -> std::string {
            const auto value = parse<Number>(text);
            return value && accepts(*value) ? "" : "must be " + wanted + ", not " + shown(text);
          },
          name};
}

}  // namespace

CLI::Validator positive() {
  return check<double>("> 0", "a number above 0", [](double v) { return v > 0 && std::isfinite(v); });
}

CLI::Validator non_negative() {
  return check<double>(">= 0", "a number of 0 or more", [](double v) { return v >= 0 && std::isfinite(v); });
}

CLI::Validator fraction() { return number_between(0, 1); }

CLI::Validator open_fraction() {
  return check<double>("> 0, < 1", "a number above 0 and below 1", [](double v) { return v > 0 && v < 1; });
}

CLI::Validator number_between(double lowest, double highest) {
  return check<double>(fmt::format("{:g}..{:g}", lowest, highest), fmt::format("a number from {:g} to {:g}", lowest, highest),
                       [=](double v) { return v >= lowest && v <= highest; });
}

CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest) {
  const bool open = highest == std::numeric_limits<std::uint64_t>::max();
  const std::string name = open ? fmt::format(">= {}", lowest) : fmt::format("{}..{}", lowest, highest);
  return check<std::uint64_t>(name, fmt::format("a whole number from {} to {}", lowest, highest),
                              [=](std::uint64_t v) { return v >= lowest && v <= highest; });
}

}  // namespace tyndall::cli
