/// From tokens to typed parameters.
#include <algorithm>
#include <array>
#include <utility>

#include "io/pbrt_params.h"
#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

enum class Values { numbers, integers, booleans, strings, numbers_or_strings };

struct TypeRow {
  std::string_view name;
  ParamType type;
  Values values;
  int multiple;  ///< the count of values must be a multiple of it
};

// The first row of a type holds the name used in messages.
constexpr std::array kTypes{
    TypeRow{"float", ParamType::number, Values::numbers, 1},
    TypeRow{"integer", ParamType::integer, Values::integers, 1},
    TypeRow{"bool", ParamType::boolean, Values::booleans, 1},
    TypeRow{"string", ParamType::string, Values::strings, 1},
    TypeRow{"point2", ParamType::point2, Values::numbers, 2},
    TypeRow{"vector2", ParamType::vector2, Values::numbers, 2},
    TypeRow{"point3", ParamType::point3, Values::numbers, 3},
    TypeRow{"vector3", ParamType::vector3, Values::numbers, 3},
    TypeRow{"normal", ParamType::normal, Values::numbers, 3},
    TypeRow{"normal3", ParamType::normal, Values::numbers, 3},
    TypeRow{"rgb", ParamType::rgb, Values::numbers, 3},
    TypeRow{"spectrum", ParamType::spectrum, Values::numbers_or_strings, 1},
    TypeRow{"blackbody", ParamType::blackbody, Values::numbers, 1},
    TypeRow{"texture", ParamType::texture, Values::strings, 1},
};

std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for (const TypeRow& row : kTypes) names.emplace_back(row.name);
  return names;
}

const TypeRow& find_type(const Tokenizer& in, Position at, std::string_view name) {
  for (const TypeRow& row : kTypes)
    if (row.name == name) return row;
  const std::string hint = name == "color" || name == "xyz" ? "use \"rgb\"" : suggestion(name, type_names());
  throw in.error(at, "\"" + printable(name) + "\" is not a parameter type; " + hint);
}

/// `"type name"` cut at its blanks.
std::pair<std::string_view, std::string_view> split_declaration(const Tokenizer& in, const Token& token) {
  constexpr std::string_view kBlank = " \t";
  const auto cut = [&](std::string_view s) { return s.substr(std::min(s.find_first_not_of(kBlank), s.size())); };
  std::string_view rest = cut(token.text);
  const std::string_view type = rest.substr(0, rest.find_first_of(kBlank));
  rest = cut(rest.substr(type.size()));
  const std::string_view name = rest.substr(0, rest.find_first_of(kBlank));
  if (name.empty() || !cut(rest.substr(name.size())).empty())
    throw in.error(token.at, "\"" + printable(token.text) + "\" is no parameter; write \"type name\", as \"float radius\"");
  return {type, name};
}

bool to_boolean(const Tokenizer& in, const Token& token) {
  if (token.is(Token::Kind::word) && token.text == "true") return true;
  if (token.is(Token::Kind::word) && token.text == "false") return false;
  throw in.error(token.at, "expected true or false, found " + shown(token) + "; write it without quotes");
}

void read_value(const Tokenizer& in, const Token& token, Values values, Param& out) {
  switch (values) {
    case Values::numbers:
      out.numbers.push_back(in.to_number(token));
      return;
    case Values::integers:
      out.integers.push_back(in.to_integer(token));
      return;
    case Values::booleans:
      out.integers.push_back(to_boolean(in, token));
      return;
    case Values::numbers_or_strings:
      if (!token.is(Token::Kind::string)) return read_value(in, token, Values::numbers, out);
      [[fallthrough]];
    case Values::strings:
      if (!token.is(Token::Kind::string))
        throw in.error(token.at, "expected a string, found " + shown(token) + "; write it in quotes");
      out.strings.emplace_back(token.text);
  }
}

void read_values(Tokenizer& in, Values values, Param& out) {
  Token token = in.next();
  if (!token.is(Token::Kind::open)) return read_value(in, token, values, out);
  if (values == Values::numbers) in.append_numbers(out.numbers);
  if (values == Values::integers) in.append_integers(out.integers);
  while (!(token = in.next()).is(Token::Kind::close)) {
    if (token.is(Token::Kind::end)) throw in.error(token.at, "the file ends inside a parameter; add the missing ]");
    read_value(in, token, values, out);
  }
}

void check_count(const Param& p, int multiple) {
  const std::size_t count = p.numbers.size() + p.integers.size() + p.strings.size();
  const std::string name = "parameter \"" + p.name + "\"";
  if (count == 0) throw Error(p.where, name + " has no value; give one or leave it out");
  if (count % multiple != 0)
    throw Error(p.where, name + " has " + std::to_string(count) + " values; a " + std::string(name_of(p.type)) + " takes " +
                             std::to_string(multiple) + " for each item");
  if (!p.numbers.empty() && !p.strings.empty()) throw Error(p.where, name + " mixes numbers and strings; use one kind");
}

}  // namespace

std::string_view name_of(ParamType type) {
  return std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeRow& row) { return row.type == type; })->name;
}

namespace {

Param read_param(Tokenizer& in, const ColorSpace* color_space) {
  const Token declaration = in.next();
  const auto [type, name] = split_declaration(in, declaration);
  const TypeRow& row = find_type(in, declaration.at, type);
  Param param;
  param.type = row.type;
  param.name = printable(name);
  param.where = in.location(declaration.at);
  param.color_space = color_space;
  read_values(in, row.values, param);
  check_count(param, row.multiple);
  return param;
}

}  // namespace

std::vector<Param> read_params(Tokenizer& in, const ColorSpace* color_space) {
  std::vector<Param> params;
  for (Tokenizer* source = &in; true;) {
    // No directive begins with a string: what stands so behind the Include belongs to the list before its file's end.
    while (source->peek().is(Token::Kind::end) && source->includer()) source = source->includer();
    if (!source->peek().is(Token::Kind::string)) break;
    Param param = read_param(*source, color_space);
    for (const Param& other : params)
      if (other.name == param.name) throw Error(param.where, "parameter \"" + param.name + "\" is given twice; remove one");
    params.push_back(std::move(param));
  }
  return params;
}

}  // namespace tyndall::pbrt
