#include "report/matte.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tyndall/error.h"

namespace tyndall {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(Failure::scene, path + ": " + what + "; render it with --aov Cryptomatte");
}

std::vector<std::string> layers_of(const Image& image, const std::string& path) {
  std::vector<std::string> layers;
  for (const std::string_view layer : kMatteLayers) {
    if (has_mattes(image, layer)) layers.emplace_back(layer);
  }
  if (layers.empty()) refuse(path, "has no mattes");
  return layers;
}

std::vector<MatteEntry> entries_of(const Image& image, const std::string& layer, const std::string& path) {
  const auto* manifest = image.attribute<std::string>(manifest_attribute(layer));
  if (!manifest) refuse(path, "has no manifest of " + layer);
  std::vector<MatteEntry> entries;
  try {
    const auto names = nlohmann::json::parse(*manifest);
    for (const auto& [name, id] : names.items())
      entries.push_back({layer, name, static_cast<std::uint32_t>(std::stoul(id.get<std::string>(), nullptr, 16))});
  } catch (const std::exception&) {
    refuse(path, "the manifest of " + layer + " is damaged");
  }
  return entries;
}

std::map<std::uint32_t, double> coverages(const Image& image, const std::string& layer) {
  const MatteReader mattes(image, layer);
  std::map<std::uint32_t, double> sums;
  for (std::size_t pixel = 0; pixel < image.data.size(); ++pixel) {
    for (const MatteCoverage& cover : mattes.at(pixel))
      sums[cover.id] += static_cast<double>(cover.coverage) / static_cast<double>(image.data.size());
  }
  return sums;
}

/// Those of the layer that are called so; nothing where one of the names is not there.
std::set<std::uint32_t> ids_of(const std::vector<MatteEntry>& entries, const std::string& layer,
                               const std::vector<std::string>& names) {
  std::set<std::uint32_t> ids;
  for (const std::string& name : names) {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const MatteEntry& e) { return e.layer == layer && e.name == name; });
    if (found == entries.end()) return {};
    ids.insert(found->id);
  }
  return ids;
}

std::string names_text(const std::vector<MatteEntry>& entries, const std::string& layer) {
  std::string text;
  for (const MatteEntry& entry : entries) {
    if (layer.empty() || entry.layer == layer) text += (text.empty() ? "" : ", ") + entry.name;
  }
  return text;
}

}  // namespace

std::vector<MatteEntry> list_mattes(const Image& image, const std::string& path) {
  std::vector<MatteEntry> all;
  for (const std::string& layer : layers_of(image, path)) {
    const auto sums = coverages(image, layer);
    for (MatteEntry& entry : entries_of(image, layer, path)) {
      const auto found = sums.find(entry.id);
      if (found != sums.end()) entry.coverage = found->second;
      all.push_back(entry);
    }
  }
  return all;
}

Image take_matte(const Image& image, const std::vector<std::string>& names, const std::string& layer, const std::string& path) {
  const std::vector<MatteEntry> entries = list_mattes(image, path);
  std::set<std::uint32_t> ids;
  std::string of;
  for (const std::string& known : layers_of(image, path)) {
    if (!ids.empty() || (!layer.empty() && known != layer)) continue;
    ids = ids_of(entries, known, names);
    of = known;
  }
  if (ids.empty())
    throw Error(Failure::usage, path + ": no layer of mattes has all of these names; it has " + names_text(entries, layer));
  Image matte;
  matte.data = image.data;
  matte.display = image.display;
  const MatteReader mattes(image, of);
  std::vector<float> coverage(image.data.size());
  for (std::size_t pixel = 0; pixel < coverage.size(); ++pixel) {
    for (const MatteCoverage& cover : mattes.at(pixel)) {
      if (ids.contains(cover.id)) coverage[pixel] += cover.coverage;
    }
  }
  for (const char* name : {"R", "G", "B"}) matte.add_channel(name).values = coverage;
  return matte;
}

}  // namespace tyndall
