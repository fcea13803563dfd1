#include "cli/frame_list.h"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "tyndall/error.h"
#include "tyndall/frames.h"

namespace tyndall::cli {
namespace {

constexpr int kHighest = 99'999'999;
constexpr std::size_t kMost = 100'000;

/// Takes a number off the front of `text`; negative: there is none.
int take_number(std::string_view& text) {
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 0 || number > kHighest || text.front() == '-') return -1;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

/// "10", "1-48" or "1-48x2".
struct Range {
  int first = -1, last = -1, step = 1;
  bool valid() const { return first >= 0 && last >= 0 && step > 0; }
};

Range range_in(std::string_view text) {
  Range range;
  range.first = range.last = take_number(text);
  if (range.first >= 0 && take(text, '-')) {
    range.last = take_number(text);
    if (range.last >= 0 && take(text, 'x')) range.step = take_number(text);
  }
  return text.empty() ? range : Range();
}

}  // namespace

std::vector<int> frames_in(const std::string& list) {
  const auto bad = [&](const std::string& why) {
    return Error(Failure::usage, "--frames " + list + " " + why + "; give frames such as 1-48, 1-48x2 or 1,5,10-12");
  };
  std::vector<int> frames;
  std::set<int> seen;
  std::istringstream parts(list + ",");
  for (std::string part; std::getline(parts, part, ',');) {
    const Range range = range_in(part);
    if (!range.valid()) throw bad("is not understood");
    const int count = std::abs(range.last - range.first) / range.step;
    for (int i = 0; i <= count; ++i) {
      const int frame = range.first + (range.last < range.first ? -i : i) * range.step;
      if (seen.insert(frame).second) frames.push_back(frame);
      if (frames.size() > kMost) throw bad("are more than " + std::to_string(kMost) + " frames");
    }
  }
  return frames;
}

void declare_frames(CLI::App& command, std::string& frames) {
  command.add_option("--frames", frames,
                     "a sequence: these frames, one after the other; %04d or $F4 in names of files, those in the scene and the "
                     "output's, is the frame [none]; --frames 1-48x2,60");
}

void require_frame_place(const std::string& name, const std::string& option) {
  if (names_frame(name)) return;
  const std::filesystem::path path(name);
  const std::string better = (path.parent_path() / path.stem()).string() + ".%04d" + path.extension().string();
  throw Error(Failure::usage, "--frames writes a file for each frame, and " + name + " has no place for its number; give " +
                                  option + " " + better);
}

}  // namespace tyndall::cli
