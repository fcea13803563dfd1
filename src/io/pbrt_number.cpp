#include "io/pbrt_number.h"

#include <charconv>
#include <cmath>
#include <type_traits>

namespace tyndall::pbrt {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// from_chars takes no leading '+', and takes "inf" and "nan", which scene files must not hold.
bool starts_number(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return !text.empty() && (is_digit(text.front()) || (text.front() == '.' && text.size() > 1));
}

/// from_chars reports underflow as it reports overflow.
bool underflows(std::string_view text) {
  const auto e = text.find_first_of("eE");
  if (e == std::string_view::npos) return text.find('.') < 2 || text.starts_with("-0");
  return e + 1 < text.size() && text[e + 1] == '-';
}

template <typename T>
NumberFault parse(std::string_view text, T& out) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  if (!starts_number(text)) return NumberFault::not_a_number;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (fault == std::errc::invalid_argument || end != text.data() + text.size()) return NumberFault::not_a_number;
  if (fault != std::errc::result_out_of_range) return NumberFault::none;
  if constexpr (std::is_floating_point_v<T>)
    if (underflows(text)) {
      out = 0;
      return NumberFault::none;
    }
  return NumberFault::out_of_range;
}

}  // namespace

NumberFault parse_number(std::string_view text, double& out) { return parse(text, out); }
NumberFault parse_number(std::string_view text, float& out) { return parse(text, out); }
NumberFault parse_number(std::string_view text, std::int32_t& out) { return parse(text, out); }

}  // namespace tyndall::pbrt
