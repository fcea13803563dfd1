/// Reads scene files directive by directive; at the first error it stops, or goes on with the next directive.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "io/file_text.h"
#include "io/pbrt_blocks.h"
#include "io/pbrt_boundaries.h"
#include "io/pbrt_directives.h"
#include "io/pbrt_settings.h"
#include "io/pbrt_suggest.h"
#include "io/pbrt_textures.h"
#include "tyndall/io.h"

namespace tyndall {
namespace pbrt {
namespace {

constexpr std::size_t kMaxErrors = 100;  // one mistake early in a big file can make thousands
constexpr std::size_t kMaxFiles =
    3'000'000;  // Include lines followed; files that include each other twice grow beyond all bounds

enum class OnError { stop, go_on };

/// One spelling for a file, to see that two names mean the same.
std::string canonical(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::weakly_canonical(path, ignored).string();
}

class Reading {
 public:
  Reading(std::string folder, const SceneReading& how, OnError on_error)
      : state_(initial_state(std::move(folder), how)), on_error_(on_error) {}

  void read(Tokenizer& top) {
    open_files_.push_back(canonical(top.name()));
    try {
      read_directives(top);
      attempt([&] { require_closed(state_, 1); });
      attempt([&] {
        if (!state_.in_world)
          throw top.error(top.peek().at, "the file ends without WorldBegin; add it after the camera and the film");
      });
      if (errors_.empty()) warn_of_idle_textures(state_);  // else what names them may be what failed
      if (errors_.empty()) warn_of_crossing_boundaries(state_);
      warn_of_media_passed_over(state_);
    } catch (TooManyErrors) {
      errors_.push_back("more errors are not shown; mend these first");
    }
    state_.scene.film.imaging_ratio = static_cast<float>(state_.exposure_time * state_.iso / 100);
    if (state_.scene.camera.lenses) state_.scene.camera.lenses->film_diagonal = state_.film_diagonal;
    state_.scene.source = top.name();
  }

  State& state() { return state_; }
  std::vector<std::string>& errors() { return errors_; }

 private:
  struct TooManyErrors {};

  /// Runs `step`; its Error ends the reading or is noted. Returns whether it went well.
  template <typename Step>
  bool attempt(Step step) {
    try {
      step();
      return true;
    } catch (const Error& e) {
      if (on_error_ == OnError::stop) throw;
      errors_.push_back(e.what());
      if (errors_.size() == kMaxErrors) throw TooManyErrors{};
      return false;
    }
  }

  void read_directives(Tokenizer& in) {
    bool at_end = false;
    while (!at_end)
      if (!attempt([&] { at_end = !read_directive(in); })) skip_to_directive(in);
  }

  /// False at the end of the file.
  bool read_directive(Tokenizer& in) {
    const Token token = in.next();
    if (token.is(Token::Kind::end)) return false;
    const Location where = in.location(token.at);
    if (!token.is(Token::Kind::word))
      throw Error(where, "expected a directive, as Shape, found " + shown(token) + "; is a directive's name missing?");
    const Directive* directive = find_directive(token.text);
    if (!directive && token.text == "WorldEnd") throw Error(where, "WorldEnd is not part of pbrt-v4; remove it");
    if (!directive)
      throw Error(where, "unknown directive \"" + printable(token.text) + "\"; " + suggestion(token.text, directive_names()));
    check_scope(*directive, state_, where);
    if (directive->read)
      directive->read(state_, in, where);
    else if (directive->name == "Import")
      import(in, where);
    else
      include(in, &in);
    return true;
  }

  /// To where reading can be taken up again after an error: a directive, or what looks like a misspelled one.
  static void skip_to_directive(Tokenizer& in) {
    int line = std::numeric_limits<int>::max();
    while (true) {
      try {
        const Token& token = in.peek();
        if (token.is(Token::Kind::end)) return;
        const bool first_in_line = token.at.line > line;
        if (token.is(Token::Kind::word)) {
          const bool capital = token.text[0] >= 'A' && token.text[0] <= 'Z';
          if (find_directive(token.text) || (first_in_line && capital)) return;
        }
        line = in.next().at.line;
      } catch (const Error&) {
        // A broken string: the tokenizer stands behind it.
      }
    }
  }

  /// Parameters that the file's end cuts off go on in `includer`.
  void include(Tokenizer& in, Tokenizer* includer) {
    const Token name = in.expect_string("a file name");
    const std::string path = resolve_asset(state_, in.location(name.at), std::string(name.text), true);
    const std::string one_name = canonical(path);
    const bool open = std::find(open_files_.begin(), open_files_.end(), one_name) != open_files_.end();
    if (open || open_files_.size() > kMaxDepth)
      throw in.error(name.at, "file \"" + printable(name.text) + "\" includes itself or is nested deeper than " +
                                  std::to_string(kMaxDepth) + "; break the circle");
    if (++files_ > kMaxFiles)
      throw in.error(name.at, "more than " + std::to_string(kMaxFiles) + " files are included; merge some");
    std::string text;
    try {
      text = read_file_text(path);
    } catch (const Error& e) {
      throw in.error(name.at, e.what());
    }
    Tokenizer included(std::move(text), path);
    included.set_includer(includer);
    open_files_.push_back(one_name);
    read_directives(included);
    open_files_.pop_back();
  }

  /// As Include, but nothing that the file does to the graphics state outlives it, nor do its coordinate systems.
  void import(Tokenizer& in, const Location& where) {
    open_block(state_, Block::Kind::import, where);
    const std::size_t depth = state_.blocks.size();
    const auto systems = state_.coordinate_systems;
    const auto leave = [&] {
      while (state_.blocks.size() >= depth) close_block(state_);
      state_.coordinate_systems = systems;
    };
    try {
      include(in, nullptr);
      require_closed(state_, depth);
    } catch (const Error&) {
      leave();
      throw;
    }
    leave();
  }

  State state_;
  OnError on_error_;
  std::vector<std::string> errors_;
  std::vector<std::string> open_files_;  ///< canonical, the top one first
  std::size_t files_ = 0;
};

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

SceneFile read_or_throw(Tokenizer in, const std::string& folder, const SceneReading& how) {
  Reading reading(folder, how, OnError::stop);
  reading.read(in);
  State& state = reading.state();
  return {std::move(state.scene), state.reports.take(), std::move(state.frame_names)};
}

}  // namespace
}  // namespace pbrt

SceneFile read_scene(const std::string& path, const SceneReading& how) {
  return pbrt::read_or_throw(pbrt::Tokenizer(read_file_text(path), path), pbrt::folder_of(path), how);
}

SceneFile read_scene_text(const std::string& text, const std::string& name, const std::string& folder) {
  return pbrt::read_or_throw(pbrt::Tokenizer(text, name), folder, {});
}

SceneCheck check_scene(const std::string& path, const SceneReading& how) {
  SceneCheck check;
  try {
    pbrt::Tokenizer in(read_file_text(path), path);
    pbrt::Reading reading(pbrt::folder_of(path), how, pbrt::OnError::go_on);
    reading.read(in);
    pbrt::State& state = reading.state();
    check = {std::move(state.scene), std::move(reading.errors()), state.reports.take(), std::move(state.frame_names)};
  } catch (const Error& e) {
    check.errors.push_back(e.what());
  }
  return check;
}

}  // namespace tyndall
