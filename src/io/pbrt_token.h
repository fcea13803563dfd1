/// Cuts the text of a scene file into tokens, one at a time, and knows the line and column of each.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/error.h"

namespace tyndall::pbrt {

/// A place in the tokenizer's file; both count from 1.
struct Position {
  int line = 0, column = 0;
};

struct Token {
  enum class Kind { end, word, string, open, close } kind = Kind::end;
  std::string_view text;  ///< a string without its quotes, escapes undone; valid as long as the tokenizer
  Position at;
  bool is(Kind k) const { return kind == k; }
};

class Tokenizer {
 public:
  /// `name` stands for the file in messages. A byte order mark is skipped; UTF-16 is an Error.
  Tokenizer(std::string text, std::string name);
  Tokenizer(const Tokenizer&) = delete;
  Tokenizer& operator=(const Tokenizer&) = delete;

  const Token& peek();
  Token next();
  Token expect_string(std::string_view what);  ///< Error unless a string follows

  double number();                            ///< one number, as a directive takes it
  float to_number(const Token& token) const;  ///< Error when the token is none
  std::int32_t to_integer(const Token& token) const;
  /// All numbers up to the next token that is none (a bracket, say), appended. The fast path of big meshes.
  void append_numbers(std::vector<float>& out);
  void append_integers(std::vector<std::int32_t>& out);

  /// The file with the Include of this one, where a parameter list goes on that this one's end cuts off; null: none.
  Tokenizer* includer() const { return includer_; }
  void set_includer(Tokenizer* includer) { includer_ = includer; }

  const std::string& name() const { return name_; }
  Location location(Position at) const { return {name_, at.line, at.column}; }
  Error error(Position at, const std::string& message) const { return Error(location(at), message); }

 private:
  Token scan();
  Token scan_string();
  std::string_view unescape(std::string_view raw, Position at);
  void skip_blank();
  std::string_view scan_word();
  Position here() const { return {line_, static_cast<int>(pos_ - line_start_) + 1}; }
  template <typename T>
  T parse(std::string_view word, Position at) const;
  template <typename T>
  T parse(const Token& token) const;
  template <typename T>
  void append(std::vector<T>& out);

  std::string text_, name_;
  Tokenizer* includer_ = nullptr;
  const char *pos_, *end_, *line_start_;
  int line_ = 1;
  Token peeked_;
  bool has_peeked_ = false;
  std::deque<std::string> unescaped_;
};

/// `text` made fit for a message: control characters replaced, at most 60 characters.
std::string printable(std::string_view text);
std::string shown(const Token& token);  ///< for "expected ..., found ..."

}  // namespace tyndall::pbrt
