#include "cli/variants.h"

#include <algorithm>
#include <sstream>

#include "cli/render_options.h"

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
  return names + ", --candidates, --splitting, --shadow-rays";
}

CompareVariant variant_of(const std::string& name, const std::string& options, const RenderSettings& base) {
  CLI::App parser;
  parser.set_help_flag();
  MethodOptions methods;
  declare(parser, methods);
  auto arguments = split(options, " \t");
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  CompareVariant variant{name, options, base};
  try {
    parser.parse(arguments);
    apply(methods, variant.settings);
  } catch (const CLI::ParseError& e) {
    throw Error(Failure::usage, "variant \"" + name + "\": " + e.what() + "; a variant may set " + method_option_names() +
                                    ", and what changes the right picture is for all: give it to compare itself");
  } catch (const Error& e) {
    throw Error(Failure::usage, "variant \"" + name + "\": " + e.what());
  }
  return variant;
}

void add_axis(const StrategyAxis& axis, const RenderSettings& base, std::vector<CompareVariant>& variants) {
  for (const std::string_view name : axis.names) {
    variants.push_back(variant_of(std::string(name), "--" + std::string(axis.option) + " " + std::string(name), base));
  }
}

/// False: no preset has this name.
bool add_preset(const std::string& name, const RenderSettings& base, std::vector<CompareVariant>& variants) {
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
  return a.candidates == b.candidates && a.shadow_rays == b.shadow_rays && a.splitting == b.splitting &&
         std::all_of(axes.begin(), axes.end(), [&](const StrategyAxis& axis) { return axis.get(a) == axis.get(b); });
}

/// A method that several presets hold appears once; two of one name are a mistake.
std::vector<CompareVariant> without_repeats(const std::vector<CompareVariant>& all, bool explicit_ones) {
  std::vector<CompareVariant> kept;
  for (const CompareVariant& v : all) {
    const auto same = [&](const CompareVariant& k) { return same_method(k.settings, v.settings); };
    if (!explicit_ones && std::any_of(kept.begin(), kept.end(), same)) continue;
    const auto same_name = [&](const CompareVariant& k) { return k.name == v.name; };
    if (std::any_of(kept.begin(), kept.end(), same_name)) {
      throw Error(Failure::usage, "two variants are called \"" + v.name + "\"; give each a name of its own");
    }
    kept.push_back(v);
  }
  return kept;
}

}  // namespace

std::string preset_names() {
  std::string names;
  for (const StrategyAxis& axis : strategy_axes()) names += std::string(axis.option) + ", ";
  return names + "all";
}

std::vector<CompareVariant> parse_variants(const std::vector<std::string>& specs, const RenderSettings& base) {
  std::vector<CompareVariant> variants;
  bool explicit_ones = false;
  for (const std::string& spec : specs) {
    for (const std::string& part : split(spec, ",;")) {
      const std::size_t colon = part.find(':');
      if (colon == std::string::npos) {
        if (add_preset(part, base, variants)) continue;
        throw Error(Failure::usage, "--variants " + part + " is not known; choose from " + preset_names() +
                                        ", or write \"name:--lights power\"");
      }
      const std::string name = trimmed(part.substr(0, colon));
      if (name.empty()) throw Error(Failure::usage, "a variant has no name; write \"name:--lights power\"");
      variants.push_back(variant_of(name, trimmed(part.substr(colon + 1)), base));
      explicit_ones = true;
    }
  }
  if (variants.empty()) throw Error(Failure::usage, "--variants is empty; choose from " + preset_names());
  return without_repeats(variants, explicit_ones);
}

}  // namespace tyndall::cli
