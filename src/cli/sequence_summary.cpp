#include "cli/sequence_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "tyndall/frames.h"

namespace tyndall::cli {
namespace {

double seconds_of(const Summary& s) { return s.read_seconds + s.build_seconds + s.render.seconds + s.write_seconds; }

template <typename Value>
auto sum_of(const SequenceSummary& s, Value value) {
  decltype(value(Summary())) sum{};
  for (const FrameSummary& f : s.frames) sum += value(f.summary);
  return sum;
}

std::string times_text(const SequenceSummary& s) {
  const auto longest = std::max_element(s.frames.begin(), s.frames.end(), [](const FrameSummary& a, const FrameSummary& b) {
    return seconds_of(a.summary) < seconds_of(b.summary);
  });
  return fmt::format(
      "  time    read {:.2f}s, build {:.2f}s, render {:.2f}s, write {:.2f}s; {:.2f}s a frame, {:.2f}s the longest, frame {}\n",
      sum_of(s, [](const Summary& f) { return f.read_seconds; }), sum_of(s, [](const Summary& f) { return f.build_seconds; }),
      sum_of(s, [](const Summary& f) { return f.render.seconds; }), sum_of(s, [](const Summary& f) { return f.write_seconds; }),
      sum_of(s, seconds_of) / static_cast<double>(s.frames.size()), seconds_of(longest->summary), longest->frame);
}

std::string health_text(const SequenceSummary& s) {
  return fmt::format("  health  {} non-finite samples, {} majorant violations, {} caps hit, {} boundary parity errors\n",
                     sum_of(s, [](const Summary& f) { return f.render.non_finite; }),
                     sum_of(s, [](const Summary& f) { return f.render.majorant_violations; }),
                     sum_of(s, [](const Summary& f) { return f.render.caps_hit; }),
                     sum_of(s, [](const Summary& f) { return f.render.parity_errors; }));
}

std::string work_text(const SequenceSummary& s) {
  return fmt::format("  work    {} paths, {} rays, {} shadow rays, {} density lookups\n",
                     sum_of(s, [](const Summary& f) { return f.render.paths; }),
                     sum_of(s, [](const Summary& f) { return f.render.rays; }),
                     sum_of(s, [](const Summary& f) { return f.render.shadow_rays; }),
                     sum_of(s, [](const Summary& f) { return f.render.density_lookups; }));
}

std::string numbers_text(const SequenceSummary& s) {
  std::string text;
  for (const FrameSummary& f : s.frames) {
    if (f.summary.render.stopped) text += fmt::format(", frame {} stopped early", f.frame);
  }
  if (!s.there.empty()) text += fmt::format(", {} there before ({})", s.there.size(), frames_text(s.there));
  if (s.missing() > 0) text += fmt::format(", {} not begun", s.missing());
  return text;
}

}  // namespace

std::string as_text(const SequenceSummary& s) {
  std::string text = fmt::format("{}: {} of {} frames rendered{}\n", s.output, s.frames.size(), s.asked, numbers_text(s));
  if (s.frames.empty()) return text;
  const Summary& last = s.frames.back().summary;
  text += fmt::format("  frames  {}x{}, {} spp\n", last.width, last.height, last.render.samples);
  text += times_text(s);
  text += fmt::format("  kept    scene built {} times; files read {} times, and {} times not again\n", s.builds, s.files_read,
                      s.files_kept);
  return text + work_text(s) + health_text(s);
}

std::string as_json(const SequenceSummary& s) {
  nlohmann::ordered_json j;
  j["output"] = s.output;
  j["frames"] = nlohmann::json::array();
  for (const FrameSummary& f : s.frames) {
    nlohmann::ordered_json frame{{"frame", f.frame}};
    frame.update(nlohmann::ordered_json::parse(as_json(f.summary)));
    j["frames"].push_back(std::move(frame));
  }
  j["there"] = s.there;
  j["not_begun"] = s.missing();
  j["builds"] = s.builds;
  j["files"] = {{"read", s.files_read}, {"kept", s.files_kept}};
  return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace tyndall::cli
