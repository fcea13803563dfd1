#include "io/pbrt_transforms.h"

#include <cmath>
#include <limits>
#include <string>

#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

constexpr const char* kNoMotion =
    "moving transforms are not supported by Tyndall: everything stands as at the start of the shutter";

bool is_singular(double factor) { return factor == 0 || (std::isfinite(factor) && !std::isfinite(1 / factor)); }

/// A matrix that Transform refuses has no inverse when this holds; otherwise it is wrong in another way.
bool is_affine(const Transform::Matrix& m) {
  for (const auto& row : m)
    for (const double v : row)
      if (!std::isfinite(v)) return false;
  const double dust = 1e-6 * std::abs(m[3][3]);
  return m[3][3] != 0 && std::abs(m[3][0]) <= dust && std::abs(m[3][1]) <= dust && std::abs(m[3][2]) <= dust;
}

bool is_singular(const Transform::Matrix& m) {
  try {
    const Transform regular(m);
    return false;
  } catch (const Error&) {
    return is_affine(m);
  }
}

/// A product with a singular matrix is singular: only a directive that sets the matrix ends it.
void set_singular(State& state, const Location& where) {
  if (state.graphics.start_active) state.graphics.singular = where;
}

/// Sets the matrix to what `make` gives, with errors located; a transform for the shutter's end alone has no effect.
template <typename Make>
void set_transform(State& state, const Location& where, Make make) {
  Transform next;
  try {
    next = make();
    for (const auto& row : next.matrix())
      for (const double v : row)
        if (!(std::abs(v) <= std::numeric_limits<float>::max()))  // of what points are
          throw Error(Failure::scene, "transforms multiply to more than a number can hold; check the scale factors");
  } catch (const Error& e) {
    throw Error(where, e.what());
  }
  if (!state.graphics.start_active) return;
  state.graphics.ctm = next;
  state.graphics.singular.reset();
}

template <typename Make>
void concatenate(State& state, const Location& where, Make make) {
  if (const auto singular = state.graphics.singular) {
    set_transform(state, where, make);  // for its errors alone
    return set_singular(state, *singular);
  }
  set_transform(state, where, [&] { return state.graphics.ctm * make(); });
}

struct Three {
  double x, y, z;
};

Three read_three(Tokenizer& in) {
  const double x = in.number(), y = in.number(), z = in.number();
  return {x, y, z};
}

Vec3 to_vec3(Three v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// Sixteen numbers in brackets, column by column as pbrt stores them.
Transform::Matrix read_matrix(Tokenizer& in) {
  const Token open = in.next();
  if (!open.is(Token::Kind::open)) throw in.error(open.at, "expected [ and 16 numbers, found " + shown(open));
  Transform::Matrix m;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) m[row][column] = in.number();
  const Token close = in.next();
  if (!close.is(Token::Kind::close)) throw in.error(close.at, "expected ] after 16 numbers, found " + shown(close));
  return m;
}

}  // namespace

void read_identity(State& state, Tokenizer&, const Location& where) {
  set_transform(state, where, [] { return Transform(); });
}

void read_translate(State& state, Tokenizer& in, const Location& where) {
  const Three v = read_three(in);
  concatenate(state, where, [&] { return Transform::translate(v.x, v.y, v.z); });
}

void read_scale(State& state, Tokenizer& in, const Location& where) {
  const Three v = read_three(in);
  const bool finite = std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  if (finite && (is_singular(v.x) || is_singular(v.y) || is_singular(v.z))) return set_singular(state, where);
  concatenate(state, where, [&] { return Transform::scale(v.x, v.y, v.z); });
}

void read_rotate(State& state, Tokenizer& in, const Location& where) {
  const double degrees = in.number();
  const Three axis = read_three(in);
  concatenate(state, where, [&] { return Transform::rotate(degrees, axis.x, axis.y, axis.z); });
}

void read_look_at(State& state, Tokenizer& in, const Location& where) {
  const Three eye = read_three(in), look = read_three(in), up = read_three(in);
  concatenate(state, where, [&] { return Transform::look_at(to_vec3(eye), to_vec3(look), to_vec3(up)); });
}

void read_transform(State& state, Tokenizer& in, const Location& where) {
  const Transform::Matrix m = read_matrix(in);
  if (is_singular(m)) return set_singular(state, where);
  set_transform(state, where, [&] { return Transform(m); });
}

void read_concat_transform(State& state, Tokenizer& in, const Location& where) {
  const Transform::Matrix m = read_matrix(in);
  if (is_singular(m)) return set_singular(state, where);
  concatenate(state, where, [&] { return Transform(m); });
}

void read_coordinate_system(State& state, Tokenizer& in, const Location&) {
  const std::string name(in.expect_string("the name of a coordinate system").text);
  state.coordinate_systems[name] = {state.graphics.ctm, state.graphics.singular};
}

void read_coord_sys_transform(State& state, Tokenizer& in, const Location&) {
  const Token name = in.expect_string("the name of a coordinate system");
  const auto it = state.coordinate_systems.find(std::string(name.text));
  if (it == state.coordinate_systems.end())
    throw in.error(name.at, "coordinate system \"" + printable(name.text) +
                                "\" is not defined; define it with CoordinateSystem before line " +
                                std::to_string(name.at.line) + " (" +
                                suggestion(name.text, names_of(state.coordinate_systems)) + ")");
  if (!state.graphics.start_active) return;
  state.graphics.ctm = it->second.to_world;
  state.graphics.singular = it->second.singular;
}

void read_active_transform(State& state, Tokenizer& in, const Location& where) {
  const Token which = in.next();
  const bool start = which.text == "StartTime", end = which.text == "EndTime";
  if (!start && !end && which.text != "All")
    throw in.error(which.at, "expected StartTime, EndTime or All, found " + shown(which));
  if (end) state.reports.warn(where, kNoMotion);
  state.graphics.start_active = !end;
}

void read_transform_times(State& state, Tokenizer& in, const Location& where) {
  in.number();
  in.number();
  state.reports.warn(where, kNoMotion);
}

}  // namespace tyndall::pbrt
