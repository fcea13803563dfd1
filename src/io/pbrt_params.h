/// A directive's parameter list: `"point3 P" [ 0 0 0 ]` and its kin, read, typed and checked.
#pragma once

#include <cstdint>
#include <deque>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/color.h"
#include "io/pbrt_reports.h"
#include "io/pbrt_token.h"
#include "tyndall/math.h"

namespace tyndall::pbrt {

enum class ParamType {
  number,
  integer,
  boolean,
  string,
  point2,
  vector2,
  point3,
  vector3,
  normal,
  rgb,
  spectrum,
  blackbody,
  texture
};
std::string_view name_of(ParamType type);  ///< as in the scene file: "float", "point3" ...

struct Param {
  ParamType type = ParamType::number;
  std::string name;
  Location where;
  std::vector<float> numbers;
  std::vector<std::int32_t> integers;  ///< of booleans 0 or 1
  std::vector<std::string> strings;
  const ColorSpace* color_space = nullptr;  ///< the one in force where the parameter stands
};

/// Reads parameters until something else follows, across the end of an included file. Wrong value types, wrong counts and
/// repetitions are Errors.
std::vector<Param> read_params(Tokenizer& in, const ColorSpace* color_space);

/// Look-ups in a parameter list. Whoever builds an entity asks for every parameter it knows, then calls `finish`,
/// which finds the unknown ones; so the code that uses a parameter is the only list of parameters.
class ParamList {
 public:
  /// `owner` is for messages: `material "diffuse"`. `defaults` (of the Attribute directive) fill in for parameters
  /// that are absent and are never reported as unknown; they must outlive this object.
  ParamList(std::string owner, Location where, std::vector<Param> params, const std::vector<Param>* defaults, Reports& reports);

  /// The parameter, or null. Error when it is there with none of these types.
  Param* find(std::string_view name, std::initializer_list<ParamType> types);

  float number(std::string_view name, float otherwise);
  float not_negative(std::string_view name, float otherwise);
  int integer(std::string_view name, int otherwise);
  bool boolean(std::string_view name, bool otherwise);
  std::string string(std::string_view name, std::string_view otherwise);
  Vec3 point(std::string_view name, Vec3 otherwise);
  Vec3 vector(std::string_view name, Vec3 otherwise);
  std::optional<float> maybe_number(std::string_view name);
  std::vector<float> numbers(std::string_view name);
  std::vector<std::int32_t> integers(std::string_view name);
  std::vector<std::string> strings(std::string_view name);
  std::vector<Vec3> triples(std::string_view name, ParamType type);
  std::vector<Vec2> pairs(std::string_view name);  ///< point2

  /// One of `choices`; any other value is an Error that lists them.
  std::string choice(std::string_view name, std::string_view otherwise, std::initializer_list<std::string_view> choices);
  /// Known to pbrt and not honoured here: a warning with the reason when it is present.
  void ignore(std::string_view name, std::initializer_list<ParamType> types, std::string_view reason);

  /// Error for the first parameter that nobody asked for.
  void finish() const;

  Error error(std::string_view name, const std::string& message) const;  ///< at the parameter, else at the directive
  Error error(const std::string& message) const { return Error(where_, message); }
  Location where(std::string_view name) const;
  const Location& where() const { return where_; }
  const std::string& owner() const { return owner_; }
  Reports& reports() { return *reports_; }

 private:
  const Param* look(std::string_view name) const;
  Param* one(std::string_view name, ParamType type);

  std::string owner_;
  Location where_;
  std::vector<Param> params_;
  const std::vector<Param>* defaults_;
  Reports* reports_;
  std::vector<std::string_view> asked_;  ///< literals of the look-ups
  std::deque<Param> borrowed_;           ///< copies of used defaults, so that callers may move values out
};

}  // namespace tyndall::pbrt
