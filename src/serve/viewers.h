/// Who looks at a page, as far as their requests tell.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tyndall/timer.h"

namespace tyndall {

/// By names that the pages give themselves. Of more than kMost those that were silent longest are forgotten.
class Viewers {
 public:
  /// `name` asks, and shows what `state` stood for.
  void add(const std::string& name, std::uint64_t state) {
    std::erase_if(viewers_, [&](const Viewer& v) { return v.name == name; });
    if (viewers_.size() == kMost) viewers_.erase(viewers_.begin());
    viewers_.push_back({name, state, {}});
  }

  bool any() const { return std::any_of(viewers_.begin(), viewers_.end(), is_here); }
  /// Whether somebody is here who does not show `state` yet.
  bool any_behind(std::uint64_t state) const {
    return std::any_of(viewers_.begin(), viewers_.end(), [&](const Viewer& v) { return is_here(v) && v.state < state; });
  }

 private:
  static constexpr std::size_t kMost = 16;
  static constexpr double kSilence = 3;  ///< seconds without a request, then it is gone

  struct Viewer {
    std::string name;
    std::uint64_t state;
    Timer since;
  };
  static bool is_here(const Viewer& v) { return v.since.seconds() < kSilence; }

  std::vector<Viewer> viewers_;  ///< who asked last comes last
};

}  // namespace tyndall
