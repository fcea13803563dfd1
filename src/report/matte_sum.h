/// Mattes of several renders of one scene, added by their ids.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "tyndall/cryptomatte.h"

namespace tyndall {

/// One layer. All ids are kept until the end: ranks that were cut do not add up in any order.
class MatteSum {
 public:
  MatteSum(std::string_view layer, std::size_t pixels) : layer_(layer), pixels_(pixels) {}

  std::string_view layer() const { return layer_; }
  void add(std::size_t pixel, const std::vector<MatteCoverage>& covers, double samples);
  /// As channels of `image`; `samples` of each pixel, 0 where it has none.
  void store(Image& image, const std::vector<double>& samples) const;

 private:
  std::string_view layer_;
  std::vector<std::map<std::uint32_t, double>> pixels_;  ///< coverage times samples, by id
};

}  // namespace tyndall
