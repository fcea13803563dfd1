/// Lists of which a pixel keeps the brightest, and draws one by its brightness.
#pragma once

#include <algorithm>
#include <cstddef>

namespace tyndall {

/// At most `most` are left, the first by `brighter`, and their brightnesses are probabilities; none, where all are black.
template <typename List, typename Brighter>
void keep_brightest(List& list, std::size_t most, const Brighter& brighter) {
  if (list.size() > most) {
    std::partial_sort(list.begin(), list.begin() + most, list.end(), brighter);
    list.truncate(most);
  }
  double sum = 0;
  for (const auto& item : list) sum += item.brightness;
  if (!(sum > 0)) list.clear();
  for (auto& item : list) item.brightness = static_cast<float>(item.brightness / sum);
}

/// By `which` in [0, 1), of a list that is not empty.
template <typename List>
const auto& chosen_by_brightness(const List& list, float which) {
  const auto* chosen = list.begin();
  while (which >= chosen->brightness && chosen != &list.back()) which -= (chosen++)->brightness;
  return *chosen;
}

}  // namespace tyndall
