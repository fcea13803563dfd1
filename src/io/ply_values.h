/// The numbers in the body of a polygon file, one after the other, whatever their encoding.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "io/pbrt_number.h"
#include "io/ply_header.h"

namespace tyndall {

/// `value` and `skip` return false at the end of the data (or, in text, at something that is no number).
class PlyTextValues {
 public:
  explicit PlyTextValues(std::string_view body) : rest_(body) {}

  bool value(PlyType, double& out) {
    constexpr std::string_view kBlank = " \t\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlank));
    rest_.remove_prefix(word.size());
    return pbrt::parse_number(word, out) == pbrt::NumberFault::none;
  }
  bool skip(PlyType type, std::size_t count) {
    double ignored;
    for (std::size_t i = 0; i < count; ++i)
      if (!value(type, ignored)) return false;
    return true;
  }
  /// A number takes a digit and a blank, whatever its type.
  bool can_hold(std::size_t count, const PlyElement& element) const {
    return count <= (rest_.size() + 1) / (2 * element.properties.size());
  }

 private:
  std::string_view rest_;
};

class PlyBinaryValues {
 public:
  PlyBinaryValues(std::string_view body, std::endian order) : rest_(body), swap_(order != std::endian::native) {}

  bool value(PlyType type, double& out) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>(out);
      case PlyType::uint8:
        return take<std::uint8_t>(out);
      case PlyType::int16:
        return take<std::int16_t>(out);
      case PlyType::uint16:
        return take<std::uint16_t>(out);
      case PlyType::int32:
        return take<std::int32_t>(out);
      case PlyType::uint32:
        return take<std::uint32_t>(out);
      case PlyType::float32:
        return take<float>(out);
      case PlyType::float64:
        return take<double>(out);
    }
    return false;
  }
  bool skip(PlyType type, std::size_t count) {
    if (count > rest_.size() / size_of(type)) return false;
    rest_.remove_prefix(count * size_of(type));
    return true;
  }
  bool can_hold(std::size_t count, const PlyElement& element) const { return count <= rest_.size() / element.least_size(); }

 private:
  template <typename T>
  bool take(double& out) {
    if (rest_.size() < sizeof(T)) return false;
    char bytes[sizeof(T)];
    std::memcpy(bytes, rest_.data(), sizeof(T));
    if (swap_) std::reverse(bytes, bytes + sizeof(T));
    rest_.remove_prefix(sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    out = static_cast<double>(value);
    return true;
  }

  std::string_view rest_;
  bool swap_;
};

}  // namespace tyndall
