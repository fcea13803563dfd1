/// Warnings of one reading, each kind once.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "tyndall/io.h"

namespace tyndall::pbrt {

class Reports {
 public:
  /// Kept unless the same message was given before, wherever that was.
  void warn(const Location& where, const std::string& message) {
    if (seen_.insert(message).second) warnings_.push_back({where, message});
  }
  std::vector<Warning> take() { return std::move(warnings_); }

 private:
  std::vector<Warning> warnings_;
  std::unordered_set<std::string> seen_;
};

}  // namespace tyndall::pbrt
