/// The result of a comparison in a sentence.
#pragma once

#include <span>
#include <string>

#include "report/compare.h"

namespace tyndall {

/// Who is ahead of the first variant, by MSE and without the worst 0.1 % of pixels, each with its interval; whether the two
/// agree, and whether the seeds decide. Empty where there is nothing to compare.
std::string compare_verdict(std::span<const VariantResult> variants);

}  // namespace tyndall
