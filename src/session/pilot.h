/// A look at a few blocks of the picture before it is rendered, for what is decided by measurement.
#pragma once

#include <optional>

#include "math/parallel.h"
#include "session/pixel_sample.h"
#include "transport/budget/light_budget.h"

namespace tyndall {

/// What is best asked of lights in this picture: a function of the scene, the frame and the settings, whatever part of the
/// picture is rendered, and by whom; and of no random number that its samples use. Nothing where there is nothing to decide.
std::optional<LightBudget> measured_budget(const SampleContext& context, ThreadPool& pool);

}  // namespace tyndall
