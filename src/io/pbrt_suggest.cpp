#include "io/pbrt_suggest.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace tyndall::pbrt {
namespace {

int lower(char c) { return std::tolower(static_cast<unsigned char>(c)); }

/// Levenshtein distance without regard to case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i - 1]) != lower(b[j - 1]));
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string quoted_list(const std::vector<std::string>& names, const char* last) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : (i + 1 == names.size() ? last : ", ")) + ("\"" + names[i] + "\"");
  return out;
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 64;  // the distance is quadratic, and names come from the file
  if (name.size() > kLongest) return {};
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongest) continue;
    const std::size_t distance = edit_distance(name, candidate);
    const bool part = name.size() > 2 && candidate.find(name) != std::string::npos;
    if (part || distance <= 1 + std::min(name.size(), candidate.size()) / 3) ranked.emplace_back(distance, candidate);
  }
  std::sort(ranked.begin(), ranked.end());
  ranked.erase(std::unique(ranked.begin(), ranked.end()), ranked.end());
  std::vector<std::string> out;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, ranked.size()); ++i) out.push_back(ranked[i].second);
  return out;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  const std::vector<std::string> near = nearest_names(name, known);
  if (!near.empty()) return "did you mean " + quoted_list(near, " or ") + "?";
  if (known.empty()) return "none is known here";
  if (known.size() <= 12) return "known: " + quoted_list(known, ", ");
  return "known: " + quoted_list({known.begin(), known.begin() + 12}, ", ") + " ...";
}

}  // namespace tyndall::pbrt
