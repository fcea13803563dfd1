#include "cli/merge_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <regex>

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

/// `command` with the path of its output changed.
std::string with_output(const std::string& command, const std::function<std::string(const std::string& path)>& change) {
  static const std::regex kOutput("(-o|--output)([ =]?)('[^']*'|[^ ]+)");
  std::smatch found;
  if (!std::regex_search(command, found, kOutput)) return command;
  return found.prefix().str() + found[1].str() + found[2].str() + change(found[3]) + found.suffix().str();
}

/// Where slices of another seed go, beside the first: "parts/3.exr" to "parts/seed1-3.exr".
std::string output_of_seed(std::string path, unsigned long long seed) {
  const std::size_t name = path.find_last_of('/') + 1;
  return path.insert(name == 0 && path.starts_with('\'') ? 1 : name, fmt::format("seed{}-", seed));
}

/// A command that renders `samples` a pixel more, of the next seed; nothing when `tally` does not know how slices were made.
std::string more_samples(const SliceTally& tally, long long samples) {
  if (tally.command.empty()) return "";
  static const std::regex kSpp(" --spp[ =][0-9]+"), kSeed(" --seed[ =]([0-9]+)");
  std::smatch seed;
  const unsigned long long next = std::regex_search(tally.command, seed, kSeed) ? std::stoull(seed[1]) + 1 : 1;
  const std::string command = std::regex_replace(std::regex_replace(tally.command, kSpp, ""), kSeed, "");
  const long long grain = static_cast<long long>(kSliceGrain) * tally.count;
  return with_output(command_for(command, tally.of_command, 1),
                     [&](const std::string& path) { return output_of_seed(path, next); }) +
         fmt::format(" --spp {} --seed {}", (samples + grain - 1) / grain * grain, next);
}

std::string about_error(const Merged& merged, std::optional<double> wanted) {
  if (!merged.relmse || !std::isfinite(*merged.relmse)) return "";
  std::string text = fmt::format("  estimated relMSE {:.3g}", *merged.relmse);
  if (!wanted) return text + "\n";
  const int* samples = merged.image.attribute<int>("tyndall/samples");
  if (*merged.relmse <= *wanted) return text + fmt::format(", not above the {:.3g} asked for\n", *wanted);
  if (!samples) return text + fmt::format(", above the {:.3g} asked for\n", *wanted);
  const auto more = static_cast<long long>(std::ceil(*samples * (*merged.relmse / *wanted - 1)));
  text += fmt::format("; for {:.3g} about {} samples a pixel more are needed\n", *wanted, more);
  const std::string command = merged.slices ? more_samples(*merged.slices, more) : "";
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
    text += "    " + command_for(tally.command, tally.of_command, tally.missing[i]) + "\n";
  return text;
}

}  // namespace

std::string command_for(const std::string& command, const SliceChoice& of, int index) {
  const std::string count = "/" + std::to_string(of.count);
  const std::regex slice("(--slice[ =])" + std::to_string(of.index) + count + "(?![0-9])");
  std::smatch found;
  if (!std::regex_search(command, found, slice)) return command;
  const std::string sliced = found.prefix().str() + found[1].str() + std::to_string(index) + count + found.suffix().str();
  return with_output(sliced, [&](const std::string& path) { return output_for(path, of.index, index); });
}

std::string as_text(const Merged& merged, std::optional<double> wanted) {
  std::string text;
  for (const std::string& reason : merged.left_out) text += "  left out: " + reason + "\n";
  if (merged.slices) text += about_slices(*merged.slices);
  return text + about_error(merged, wanted);
}

}  // namespace tyndall::cli
