#include "settings.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "numbers.h"
#include "tyndall/denoise.h"

namespace tyndall::python {
namespace {

constexpr int kOpen = std::numeric_limits<int>::max();  ///< of spp: as many as a limit of time or error leaves room for

PixelBounds to_crop(py::handle value) {
  const auto [x0, y0, x1, y1] = as<std::array<int, 4>>(value, "crop");
  return {x0, y0, x1, y1};
}

py::object from_crop(const std::optional<PixelBounds>& crop) {
  if (!crop) return py::none();
  return py::make_tuple(crop->x0, crop->y0, crop->x1, crop->y1);
}

void require_aov(const std::string& name) {
  const auto known = aov_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw py::value_error("no AOV is called \"" + name + "\"; tyndall.aov_names() lists them");
}

/// A text would be taken for the list of its letters.
void set_aovs(RenderSettings& settings, py::handle value) {
  if (py::isinstance<py::str>(value) || !py::isinstance<py::iterable>(value))
    throw py::type_error("aovs = " + py::repr(value).cast<std::string>() + " is not understood; give a list of names");
  std::vector<std::string> aovs;
  for (const py::handle item : value) {
    for (std::string& name : aovs_named(as<std::string>(item, "an AOV"))) {
      require_aov(name);
      aovs.push_back(std::move(name));
    }
  }
  settings.aovs = std::move(aovs);
}

struct Option {
  const char* name;
  std::function<void(RenderSettings&, py::handle)> set;
  std::function<py::object(const RenderSettings&)> get;
  bool of_method = false;  ///< leaves the right picture as it is
};

/// An option whose value `read` makes of its name and Python's.
template <typename T, typename Read>
Option option(const char* name, T RenderSettings::*member, Read read) {
  return {name, [=](RenderSettings& s, py::handle value) { s.*member = read(name, value); },
          [member](const RenderSettings& s) { return py::cast(s.*member); }};
}

Option of_method(Option option) {
  option.of_method = true;
  return option;
}

template <typename Read>
auto or_none(Read read) {
  return [read](const char* name, py::handle value) {
    return unless_none(value, [&](py::handle given) { return read(name, given); });
  };
}

auto from_to(int least, int most) {
  return [=](const char* name, py::handle value) { return whole(name, value, least, most); };
}

bool yes_or_no(const char* name, py::handle value) { return as<bool>(value, name); }

float share(const char* name, py::handle value) { return static_cast<float>(between(name, value, 0, 1)); }

/// None stands for a number that is left open; given, it changes nothing, as if it was not.
Option samples() {
  return {"spp",
          [](RenderSettings& s, py::handle value) {
            if (!value.is_none()) s.spp = whole("spp", value, 1, kMostSamples);
          },
          [](const RenderSettings& s) { return s.spp == kOpen ? py::object(py::none()) : py::object(py::int_(s.spp)); }};
}

const std::vector<Option>& options() {
  static const std::vector<Option> kOptions{
      samples(),
      option("time", &RenderSettings::time, or_none(positive)),
      option("error", &RenderSettings::error, or_none(positive)),
      option("error_max", &RenderSettings::error_max, or_none(positive)),
      of_method(option("adaptive", &RenderSettings::adaptive, or_none(yes_or_no))),
      option("max_depth", &RenderSettings::max_depth, from_to(0, kMostBounces)),
      option("seed", &RenderSettings::seed, seed),
      option("threads", &RenderSettings::threads, from_to(0, kMostThreads)),
      of_method(option("candidates", &RenderSettings::candidates, or_none(from_to(0, kMostLights)))),
      of_method(option("shadow_rays", &RenderSettings::shadow_rays, or_none(from_to(0, kMostLights)))),
      of_method(option("splitting", &RenderSettings::splitting, or_none(share))),
      option("reproducible", &RenderSettings::reproducible, yes_or_no),
      {"aovs", set_aovs, [](const RenderSettings& s) { return py::cast(s.aovs); }},
      {"crop", [](RenderSettings& s, py::handle value) { s.crop = unless_none(value, to_crop); },
       [](const RenderSettings& s) { return from_crop(s.crop); }},
  };
  return kOptions;
}

/// False: no strategies have this name.
bool set_strategy(RenderSettings& settings, const std::string& name, py::handle value) {
  for (const StrategyAxis& axis : strategy_axes()) {
    if (axis.option != name) continue;
    const auto choice = as<std::string>(value, name.c_str());
    if (axis.set(settings, choice)) return true;
    std::string known;
    for (const std::string_view n : axis.names) known += (known.empty() ? "" : ", ") + std::string(n);
    throw py::value_error(name + " = \"" + choice + "\" is not known; choose from " + known);
  }
  return false;
}

/// False: no option that `may` be set has this name.
template <typename May>
bool set(RenderSettings& settings, const std::string& name, py::handle value, May may) {
  for (const Option& option : options()) {
    if (option.name != name || !may(option)) continue;
    option.set(settings, value);
    return true;
  }
  return set_strategy(settings, name, value);
}

template <typename May>
std::string names_of_options(May may) {
  std::string names;
  for (const Option& option : options())
    if (may(option)) names += std::string(option.name) + ", ";
  for (const StrategyAxis& axis : strategy_axes()) names += std::string(axis.option) + ", ";
  return names.substr(0, names.size() - 2);
}

bool is_any(const Option&) { return true; }
bool is_of_method(const Option& option) { return option.of_method; }

/// A limit of time or error alone leaves the number of samples open; without any, an open one would never end.
void settle_samples(RenderSettings& settings, const py::dict& given) {
  const auto has = [&](const char* name) { return given.contains(name) && !given[name].is_none(); };
  const bool limited = settings.time || settings.error || settings.error_max;
  if (!has("spp") && (has("time") || has("error") || has("error_max"))) settings.spp = kOpen;
  if (!limited && settings.spp == kOpen) settings.spp = RenderSettings{}.spp;
}

void require_within(const Film& film, const PixelBounds& crop) {
  const auto is_range = [](int from, int to, int size) { return 0 <= from && from < to && to <= size; };
  if (is_range(crop.x0, crop.x1, film.width) && is_range(crop.y0, crop.y1, film.height)) return;
  throw py::value_error("crop is (x0, y0, x1, y1) within " + std::to_string(film.width) + " x " + std::to_string(film.height) +
                        ", x0 below x1 and y0 below y1");
}

}  // namespace

RenderSettings with_options(const Scene& scene, const py::dict& given) {
  RenderSettings settings = scene.settings;
  for (const auto& [key, value] : given) {
    const auto name = as<std::string>(key, "the name of an option");
    if (!set(settings, name, value, is_any))
      throw py::type_error("\"" + name + "\" is no option of a render; choose from " + names_of_options(is_any));
  }
  if (given.contains("crop") && settings.crop) require_within(scene.film, *settings.crop);
  settle_samples(settings, given);
  return settings;
}

RenderSettings with_method(RenderSettings settings, const py::dict& given) {
  for (const auto& [key, value] : given) {
    const auto name = as<std::string>(key, "the name of an option");
    if (!set(settings, name, value, is_of_method))
      throw py::type_error("\"" + name + "\" is no option of a method; choose from " + names_of_options(is_of_method) +
                           ", and what changes the right picture is for all: give it to scene.settings or compare itself");
  }
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
