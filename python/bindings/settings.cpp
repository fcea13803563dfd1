#include "settings.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace tyndall::python {
namespace {

PixelBounds to_crop(py::handle value) {
  const auto [x0, y0, x1, y1] = value.cast<std::array<int, 4>>();
  if (x0 >= x1 || y0 >= y1) throw py::value_error("crop is (x0, y0, x1, y1) with x0 < x1 and y0 < y1");
  return {x0, y0, x1, y1};
}

py::object from_crop(const std::optional<PixelBounds>& crop) {
  if (!crop) return py::none();
  return py::make_tuple(crop->x0, crop->y0, crop->x1, crop->y1);
}

void set_aovs(RenderSettings& settings, py::handle value) {
  const auto known = aov_names();
  settings.aovs.clear();
  for (const py::handle item : value.cast<py::list>()) {
    const auto name = item.cast<std::string>();
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw py::value_error("no AOV is called \"" + name + "\"; tyndall.aov_names() lists them");
    settings.aovs.push_back(name);
  }
}

struct Option {
  const char* name;
  std::function<void(RenderSettings&, py::handle)> set;
  std::function<py::object(const RenderSettings&)> get;
};

/// An option whose value Python converts by itself.
template <typename T>
Option plain(const char* name, T RenderSettings::*member) {
  return {name, [member](RenderSettings& s, py::handle value) { s.*member = value.cast<T>(); },
          [member](const RenderSettings& s) { return py::cast(s.*member); }};
}

const std::vector<Option>& options() {
  static const std::vector<Option> kOptions{
      plain("spp", &RenderSettings::spp),
      plain("time", &RenderSettings::time),
      plain("error", &RenderSettings::error),
      plain("error_max", &RenderSettings::error_max),
      plain("adaptive", &RenderSettings::adaptive),
      plain("max_depth", &RenderSettings::max_depth),
      plain("seed", &RenderSettings::seed),
      plain("threads", &RenderSettings::threads),
      plain("candidates", &RenderSettings::candidates),
      plain("shadow_rays", &RenderSettings::shadow_rays),
      plain("splitting", &RenderSettings::splitting),
      plain("reproducible", &RenderSettings::reproducible),
      {"aovs", set_aovs, [](const RenderSettings& s) { return py::cast(s.aovs); }},
      {"crop",
       [](RenderSettings& s, py::handle value) { s.crop = value.is_none() ? std::nullopt : std::optional(to_crop(value)); },
       [](const RenderSettings& s) { return from_crop(s.crop); }},
  };
  return kOptions;
}

/// False: no strategies have this name.
bool set_strategy(RenderSettings& settings, const std::string& name, py::handle value) {
  for (const StrategyAxis& axis : strategy_axes()) {
    if (axis.option != name) continue;
    const auto choice = value.cast<std::string>();
    if (axis.set(settings, choice)) return true;
    std::string known;
    for (const std::string_view n : axis.names) known += (known.empty() ? "" : ", ") + std::string(n);
    throw py::value_error(name + " = \"" + choice + "\" is not known; choose from " + known);
  }
  return false;
}

void set(RenderSettings& settings, const std::string& name, py::handle value) {
  for (const Option& option : options()) {
    if (option.name != name) continue;
    try {
      return option.set(settings, value);
    } catch (const py::cast_error&) {
      throw py::type_error(name + " = " + py::repr(value).cast<std::string>() + " is not understood");
    }
  }
  if (set_strategy(settings, name, value)) return;
  std::string known;
  for (const Option& option : options()) known += std::string(option.name) + ", ";
  for (const StrategyAxis& axis : strategy_axes()) known += std::string(axis.option) + ", ";
  throw py::type_error("\"" + name + "\" is no option of a render; choose from " + known.substr(0, known.size() - 2));
}

}  // namespace

RenderSettings with_options(RenderSettings settings, const py::dict& given) {
  for (const auto& [name, value] : given) set(settings, name.cast<std::string>(), value);
  // A limit of time or error alone leaves the number of samples open.
  const auto has = [&](const char* name) { return given.contains(name) && !given[name].is_none(); };
  if (!has("spp") && (has("time") || has("error") || has("error_max"))) settings.spp = std::numeric_limits<int>::max();
  return settings;
}

py::dict from_settings(const RenderSettings& settings) {
  py::dict result;
  for (const Option& option : options()) result[option.name] = option.get(settings);
  for (const StrategyAxis& axis : strategy_axes())
    result[py::str(std::string(axis.option))] = py::str(std::string(axis.get(settings)));
  return result;
}

}  // namespace tyndall::python
