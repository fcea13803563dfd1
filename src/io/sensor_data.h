/// Spectral sensitivities of cameras: numbers only. Their source stands in sensor_data.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace tyndall {

/// Samples at 380, 390 ... 720 nm, in 1e-4.
inline constexpr int kSensorCount = 35;

struct SensorTable {
  std::string_view name;
  std::array<std::uint16_t, kSensorCount> red, green, blue;
};
std::span<const SensorTable> sensor_tables();

}  // namespace tyndall
