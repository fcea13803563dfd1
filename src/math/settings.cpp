#include "tyndall/settings.h"

#include <array>
#include <utility>

namespace tyndall {
namespace {

// Registering a strategy is adding a row here; the command line, the scene reader and the help text follow.
constexpr std::array<std::pair<std::string_view, LightStrategy>, 4> kLightStrategies{{
    {"uniform", LightStrategy::uniform},
    {"power", LightStrategy::power},
    {"exhaustive", LightStrategy::exhaustive},
    {"tree-binary", LightStrategy::tree_binary},
}};
constexpr std::array<std::pair<std::string_view, TransmittanceStrategy>, 3> kTransmittanceStrategies{{
    {"residual", TransmittanceStrategy::residual},
    {"ratio", TransmittanceStrategy::ratio},
    {"delta", TransmittanceStrategy::delta},
}};
constexpr std::array<std::string_view, 13> kAovs{
    "Albedo",        "N",               "P",            "Z",              "Zvol",     "Variance", "SampleCount",
    "Transmittance", "SurfaceDirect",   "SurfaceIndirect", "VolumeDirect", "VolumeIndirect", "Emission"};

template <typename Table, typename Value = typename Table::value_type::second_type>
std::optional<Value> find_value(const Table& table, std::string_view name) {
  for (const auto& [key, value] : table) {
    if (key == name) return value;
  }
  return std::nullopt;
}

template <typename Table, typename Value>
std::string_view find_name(const Table& table, Value wanted) {
  for (const auto& [key, value] : table) {
    if (value == wanted) return key;
  }
  return {};
}

template <typename Table>
std::vector<std::string_view> all_names(const Table& table) {
  std::vector<std::string_view> names;
  for (const auto& row : table) names.push_back(row.first);
  return names;
}

}  // namespace

std::optional<LightStrategy> parse_light_strategy(std::string_view name) { return find_value(kLightStrategies, name); }
std::optional<TransmittanceStrategy> parse_transmittance_strategy(std::string_view name) {
  return find_value(kTransmittanceStrategies, name);
}
std::string_view name_of(LightStrategy strategy) { return find_name(kLightStrategies, strategy); }
std::string_view name_of(TransmittanceStrategy strategy) { return find_name(kTransmittanceStrategies, strategy); }
std::vector<std::string_view> light_strategy_names() { return all_names(kLightStrategies); }
std::vector<std::string_view> transmittance_strategy_names() { return all_names(kTransmittanceStrategies); }
std::vector<std::string_view> aov_names() { return {kAovs.begin(), kAovs.end()}; }

}  // namespace tyndall
