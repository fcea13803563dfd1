/// How often something that costs time may be done.
#pragma once

#include <algorithm>

#include "tyndall/timer.h"

namespace tyndall {

/// At most every `least_seconds`, and so seldom that it takes no more than `share` of the time.
class Pace {
 public:
  Pace(double least_seconds, double share) : least_seconds_(least_seconds), share_(share) {}

  bool is_due() const { return !done_ || since_.seconds() >= std::max(least_seconds_, took_ / share_); }
  /// It was done, in `seconds`.
  void did(double seconds) {
    took_ = seconds;
    since_ = {};
    done_ = true;
  }

 private:
  double least_seconds_, share_, took_ = 0;
  Timer since_;
  bool done_ = false;
};

}  // namespace tyndall
