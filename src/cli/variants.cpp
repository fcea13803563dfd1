#include "cli/variants.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "cli/render_options.h"
#include "report/compare_results.h"

namespace tyndall::cli {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> split(const std::string& text, const char* separators) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    if (auto part = trimmed(text.substr(begin, end - begin)); !part.empty()) parts.push_back(part);
    begin = end + 1;
  }
  return parts;
}

std::string method_option_names() {
  std::string names;
  for (const StrategyAxis& axis : strategy_axes()) names += (names.empty() ? "--" : ", --") + std::string(axis.option);
  return names + ", --candidates, --splitting, --shadow-rays, --adaptive";
}

CompareVariant variant_of(const std::string& name, const std::string& options, const RenderSettings& base) {
  CLI::App parser;
  parser.set_help_flag();
  MethodOptions methods;
  declare(parser, methods);
  bool adaptive = false;
  parser.add_flag("--adaptive", adaptive);
  auto arguments = split(options, " \t");
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  CompareVariant variant{name, options, base};
  try {
    parser.parse(arguments);
    apply(methods, variant.settings);
    variant.settings.adaptive = adaptive;
  } catch (const CLI::ParseError& e) {
    throw Error(Failure::usage, "variant \"" + name + "\": " + e.what() + "; a variant may set " + method_option_names() +
                                    ", and what changes the right picture is for all: give it to compare itself");
  } catch (const Error& e) {
    throw Error(Failure::usage, "variant \"" + name + "\": " + e.what());
  }
  return variant;
}

/// With the axis where another one has a strategy of this name: "off" alone says nothing.
std::string title_of(const StrategyAxis& axis, std::string_view name) {
  const auto& axes = strategy_axes();
  const auto holders = std::count_if(axes.begin(), axes.end(), [&](const StrategyAxis& a) {
    return std::find(a.names.begin(), a.names.end(), name) != a.names.end();
  });
  return holders > 1 ? std::string(axis.option) + " " + std::string(name) : std::string(name);
}

void add_axis(const StrategyAxis& axis, const RenderSettings& base, std::vector<CompareVariant>& variants) {
  for (const std::string_view name : axis.names) {
    variants.push_back(variant_of(title_of(axis, name), "--" + std::string(axis.option) + " " + std::string(name), base));
  }
}

/// Methods that are no axis.
struct Preset {
  std::string_view name;
  struct Method {
    std::string_view name, options;
  };
  std::vector<Method> methods;
};

/// Techniques: next-event estimation at vertices, each other one beside it, and all of them with numbers that stand and that
/// are measured.
const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      {"adaptive", {{"not adaptive", ""}, {"adaptive", "--adaptive"}}},
      {"techniques",
       {{"at vertices", "--budget fixed --media vertex --emission paths --joint off --guiding off --reuse off"},
        {"along segments", "--budget fixed --media product --emission paths --joint off --guiding off --reuse off"},
        {"joint alone", "--budget fixed --media vertex --emission paths --joint points --guiding off --reuse off"},
        {"guiding alone", "--budget fixed --media vertex --emission paths --joint off --guiding media --reuse off"},
        {"sharing alone", "--budget fixed --media vertex --emission paths --joint off --guiding off --reuse pixels"},
        {"emission alone", "--budget fixed --media vertex --emission lights --joint off --guiding off --reuse off"},
        {"all fixed", "--budget fixed"},
        {"all measured", "--budget measured"}}}};
  return all;
}

/// False: no preset has this name.
bool add_preset(const std::string& name, const RenderSettings& base, std::vector<CompareVariant>& variants) {
  for (const Preset& preset : presets()) {
    if (preset.name != name) continue;
    for (const auto& [title, options] : preset.methods)
      variants.push_back(variant_of(std::string(title), std::string(options), base));
    return true;
  }
  bool known = false;
  for (const StrategyAxis& axis : strategy_axes()) {
    if (name != "all" && name != axis.option) continue;
    add_axis(axis, base, variants);
    known = true;
  }
  return known;
}

bool same_method(const RenderSettings& a, const RenderSettings& b) {
  const auto& axes = strategy_axes();
  return a.adaptive == b.adaptive && a.candidates == b.candidates && a.shadow_rays == b.shadow_rays &&
         a.splitting == b.splitting &&
         std::all_of(axes.begin(), axes.end(), [&](const StrategyAxis& axis) { return axis.get(a) == axis.get(b); });
}

/// Pictures are files named after variants, on disks that may not know capitals.
std::string file_key(const std::string& name) {
  std::string key = picture_file(name);
  for (char& c : key) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return key;
}

/// Two of one name are a mistake.
void add_named(CompareVariant variant, std::vector<CompareVariant>& variants) {
  const std::string key = file_key(variant.name);
  if (key == "reference.exr")
    throw Error(Failure::usage, "a variant is called \"" + variant.name + "\", as the reference is; choose another name");
  for (const CompareVariant& v : variants) require_own_files(v.name, variant.name);
  variants.push_back(std::move(variant));
}

/// Of a preset's methods those that are not there yet: the presets have the default method in common.
void add_new(const std::vector<CompareVariant>& preset, std::vector<CompareVariant>& variants) {
  for (const CompareVariant& p : preset) {
    const auto same = [&](const CompareVariant& v) { return same_method(v.settings, p.settings); };
    if (std::none_of(variants.begin(), variants.end(), same)) add_named(p, variants);
  }
}

}  // namespace

void require_own_files(const std::string& a, const std::string& b) {
  if (file_key(a) != file_key(b)) return;
  throw Error(Failure::usage, "variants \"" + a + "\" and \"" + b + "\" would share the file " + picture_file(a) +
                                  "; give each a name of its own");
}

std::string preset_names() {
  std::string names;
  for (const StrategyAxis& axis : strategy_axes()) names += std::string(axis.option) + ", ";
  names += "all";
  for (const Preset& preset : presets()) names += ", " + std::string(preset.name);
  return names;
}

std::vector<CompareVariant> parse_variants(const std::vector<std::string>& specs, const RenderSettings& base) {
  std::vector<CompareVariant> variants;
  for (const std::string& spec : specs) {
    for (const std::string& part : split(spec, ",;")) {
      const std::size_t colon = part.find(':');
      std::vector<CompareVariant> preset;
      if (colon == std::string::npos && !add_preset(part, base, preset)) {
        throw Error(Failure::usage, "--variants " + part + " is not known; choose from " + preset_names() +
                                        ", or write \"name:--lights power\"");
      }
      add_new(preset, variants);
      if (colon == std::string::npos) continue;
      const std::string name = trimmed(part.substr(0, colon));
      if (name.empty()) throw Error(Failure::usage, "a variant has no name; write \"name:--lights power\"");
      add_named(variant_of(name, trimmed(part.substr(colon + 1)), base), variants);
    }
  }
  if (variants.empty()) throw Error(Failure::usage, "--variants is empty; choose from " + preset_names());
  return variants;
}

}  // namespace tyndall::cli
