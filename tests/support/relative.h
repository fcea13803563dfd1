/// Approximate equality of numbers that may be small.
#pragma once

#include <doctest/doctest.h>

namespace tyndall::test {

/// doctest::Approx measures a difference against 1 + the values, so that all numbers below its epsilon are alike to it: a
/// variance of 1/192 "to 9 %" may be anything up to 0.1. This one measures against the values alone.
inline doctest::Approx relative(double value) { return doctest::Approx(value).scale(1e-300); }

}  // namespace tyndall::test
