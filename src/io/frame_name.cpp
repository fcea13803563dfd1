#include <cctype>
#include <optional>

#include "tyndall/frames.h"

namespace tyndall {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A place for a frame's number.
struct Place {
  std::size_t end = 0;  ///< behind it
  std::size_t width = 1;
};

/// %d, %4d, %04d
std::optional<Place> percent_at(std::string_view name, std::size_t at) {
  constexpr std::size_t kMostDigits = 2;
  std::size_t end = at + 1, width = 0;
  while (end < name.size() && is_digit(name[end]) && end - at <= kMostDigits)
    width = 10 * width + static_cast<std::size_t>(name[end++] - '0');
  if (end >= name.size() || name[end] != 'd') return std::nullopt;
  return Place{end + 1, width};
}

/// $F, $F4, but not $FF or $Final, which are other variables.
std::optional<Place> dollar_at(std::string_view name, std::size_t at) {
  if (name.substr(at, 2) != "$F") return std::nullopt;
  const std::size_t next = at + 2;
  if (next < name.size() && is_digit(name[next])) return Place{next + 1, static_cast<std::size_t>(name[next] - '0')};
  if (next < name.size() && (std::isalpha(static_cast<unsigned char>(name[next])) || name[next] == '_')) return std::nullopt;
  return Place{next, 1};
}

std::optional<Place> place_at(std::string_view name, std::size_t at) {
  if (name[at] == '%') return percent_at(name, at);
  return name[at] == '$' ? dollar_at(name, at) : std::nullopt;
}

}  // namespace

bool names_frame(std::string_view name) {
  for (std::size_t i = 0; i < name.size(); ++i)
    if (place_at(name, i)) return true;
  return false;
}

std::string with_frame(std::string_view name, int frame) {
  const std::string number = std::to_string(frame);
  std::string result;
  for (std::size_t i = 0; i < name.size();) {
    const auto place = place_at(name, i);
    if (!place) {
      result += name[i++];
      continue;
    }
    if (number.size() < place->width) result.append(place->width - number.size(), '0');
    result += number;
    i = place->end;
  }
  return result;
}

std::string frames_text(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t end = i + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
    if (end - i < 3) end = i + 1;
    text += (text.empty() ? "" : ",") + std::to_string(frames[i]);
    if (end - i > 1) text += "-" + std::to_string(frames[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace tyndall
