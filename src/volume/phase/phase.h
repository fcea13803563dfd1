/// Any phase function, asked by what it is.
#pragma once

#include "tyndall/phase.h"

namespace tyndall {

/// 1/sr.
inline float pdf(const Phase& phase, Vec3 wo, Vec3 wi) {
  return std::visit([&](const auto& kind) { return kind.pdf(wo, wi); }, phase);
}
inline PhaseSample sample(const Phase& phase, Vec3 wo, Vec2 u) {
  return std::visit([&](const auto& kind) { return kind.sample(wo, u); }, phase);
}
inline float mean_cosine(const Phase& phase) {
  return std::visit([](const auto& kind) { return kind.mean_cosine(); }, phase);
}

}  // namespace tyndall
