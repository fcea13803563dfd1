#include "cli/merge_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include "report/command_words.h"
#include "tyndall/image_attributes.h"
#include "tyndall/settings.h"

namespace tyndall::cli {
namespace {

constexpr std::size_t kMostNamed = 20;

std::string list_of(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < std::min(numbers.size(), kMostNamed); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
  return numbers.size() > kMostNamed ? text + fmt::format(" and {} more", numbers.size() - kMostNamed) : text;
}

/// As many digits as `like`.
std::string padded(int number, const std::string& like) { return fmt::format("{:0{}}", number, like.size()); }

/// The last number `of` in the file's name becomes `index`; a name without is told apart by one at its end.
std::string output_for(const std::string& path, int of, int index) {
  const std::size_t name = path.find_last_of('/') + 1;  // 0 where there is no folder
  std::size_t at = std::string::npos, length = 0;
  static const std::regex kNumber("[0-9]+");
  for (std::sregex_iterator m(path.begin() + static_cast<std::ptrdiff_t>(name), path.end(), kNumber), end; m != end; ++m) {
    if (m->str().size() > 9 || std::stoi(m->str()) != of) continue;
    at = name + static_cast<std::size_t>(m->position());
    length = m->str().size();
  }
  std::string changed = path;
  if (at != std::string::npos) return changed.replace(at, length, padded(index, path.substr(at, length)));
  const std::size_t dot = path.find_last_of('.');
  return changed.insert(dot == std::string::npos || dot < name ? path.size() : dot, "-" + std::to_string(index));
}

const CommandWords::Names kOutput{"-o", "--output"}, kSeed{"--seed"}, kSlice{"--slice"}, kSpp{"--spp"};

/// Where slices of another seed go, beside the first: "parts/3.exr" to "parts/seed1-3.exr".
std::string output_of_seed(std::string path, std::uint64_t seed) {
  return path.insert(path.find_last_of('/') + 1, fmt::format("seed{}-", seed));
}

/// One that no sample of the image has.
std::uint64_t unused_seed(const Image& image) {
  std::set<std::uint64_t> used{0};
  const auto* text = image.attribute<std::string>(attributes::kSeed);
  std::istringstream seeds(text ? *text : "");
  for (std::string seed; std::getline(seeds, seed, ',');) used.insert(std::strtoull(seed.c_str(), nullptr, 10));
  std::uint64_t seed = *used.rbegin() + 1;
  while (used.contains(seed)) ++seed;
  return seed;
}

/// For slice `index`: --slice, and the output's name where that holds the number of slice `of`.
void choose_slice(CommandWords& command, const SliceChoice& of, int index) {
  command.change(kSlice, fmt::format("{}/{}", index, of.count));
  if (const auto output = command.value(kOutput)) command.change(kOutput, output_for(*output, of.index, index));
}

/// A command that renders `samples` a pixel more, of another seed; nothing when `tally` does not know how slices were made, or
/// no render takes so many.
std::string more_samples(const SliceTally& tally, double samples, std::uint64_t seed) {
  const double grain = double{kSliceGrain} * tally.count, rounded = std::ceil(samples / grain) * grain;
  if (tally.command.empty() || rounded > kMostSamples) return "";
  CommandWords command(tally.command);
  choose_slice(command, tally.of_command, 1);
  if (const auto output = command.value(kOutput)) command.change(kOutput, output_of_seed(*output, seed));
  command.drop(kSpp);
  command.add(kSpp.front(), std::to_string(static_cast<int>(rounded)));
  command.drop(kSeed);
  command.add(kSeed.front(), std::to_string(seed));
  return command.str();
}

/// Of the slice that is missing.
std::string command_for(const SliceTally& tally, int index) {
  CommandWords command(tally.command);
  choose_slice(command, tally.of_command, index);
  return command.str();
}

std::string about_error(const Merged& merged, std::optional<double> wanted) {
  if (!merged.relmse || !std::isfinite(*merged.relmse)) return "";
  std::string text = fmt::format("  estimated relMSE {:.3g}", *merged.relmse);
  if (!wanted) return text + "\n";
  const int* samples = merged.image.attribute<int>(attributes::kSamples);
  if (*merged.relmse <= *wanted) return text + fmt::format(", not above the {:.3g} asked for\n", *wanted);
  if (!samples) return text + fmt::format(", above the {:.3g} asked for\n", *wanted);
  const double more = std::ceil(*samples * (*merged.relmse / *wanted - 1));
  text += fmt::format("; for {:.3g} about {:.{}} samples a pixel more are needed\n", *wanted, more, more < 1e9 ? 9 : 3);
  const std::string command = merged.slices.empty() ? "" : more_samples(merged.slices.front(), more, unused_seed(merged.image));
  return command.empty() ? text : text + fmt::format("  they come from slices of another seed, the first: {}\n", command);
}

std::string about_slices(const SliceTally& tally) {
  const auto came = static_cast<std::size_t>(tally.count) - tally.missing.size();
  if (tally.missing.empty()) return fmt::format("  all {} slices are there\n", tally.count);
  std::string text =
      fmt::format("  {} of {} slices are there; missing or not complete: {}\n", came, tally.count, list_of(tally.missing));
  if (tally.command.empty()) return text;
  text += "  these render what is missing:\n";
  for (std::size_t i = 0; i < std::min(tally.missing.size(), kMostNamed); ++i)
    text += "    " + command_for(tally, tally.missing[i]) + "\n";
  return text;
}

}  // namespace

std::string as_text(const Merged& merged, std::optional<double> wanted) {
  std::string text;
  for (const std::string& reason : merged.left_out) text += "  left out: " + reason + "\n";
  for (const SliceTally& tally : merged.slices) text += about_slices(tally);
  return text + about_error(merged, wanted);
}

}  // namespace tyndall::cli
