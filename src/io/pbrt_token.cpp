#include "io/pbrt_token.h"

#include <type_traits>
#include <utility>

#include "io/pbrt_number.h"

namespace tyndall::pbrt {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
bool ends_word(char c) { return is_blank(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

char escaped(char c) {
  switch (c) {
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case '\\':
    case '\'':
    case '"':
      return c;
    default:
      return 0;
  }
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out(text.substr(0, 60));
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return text.size() > 60 ? out + "..." : out;
}

std::string shown(const Token& token) {
  if (token.is(Token::Kind::end)) return "the end of the file";
  if (token.is(Token::Kind::string)) return "the string \"" + printable(token.text) + "\"";
  return "\"" + printable(token.text) + "\"";
}

Tokenizer::Tokenizer(std::string text, std::string name)
    : text_(std::move(text)), name_(std::move(name)), pos_(text_.data()), end_(text_.data() + text_.size()), line_start_(pos_) {
  if (text_.starts_with("\xef\xbb\xbf")) line_start_ = pos_ += 3;
  if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
    throw Error(Location{name_, 1, 1}, "the file is UTF-16; save it as UTF-8");
}

const Token& Tokenizer::peek() {
  if (!has_peeked_) {
    peeked_ = scan();
    has_peeked_ = true;
  }
  return peeked_;
}

Token Tokenizer::next() {
  if (std::exchange(has_peeked_, false)) return peeked_;
  return scan();
}

Token Tokenizer::expect_string(std::string_view what) {
  const Token token = next();
  if (token.is(Token::Kind::string)) return token;
  const std::string got = token.is(Token::Kind::end) ? "the file ends" : "found " + shown(token);
  throw error(token.at, "expected " + std::string(what) + " but " + got + "; write it in quotes");
}

void Tokenizer::skip_blank() {
  for (; pos_ < end_; ++pos_) {
    if (*pos_ == '\n') {
      ++line_;
      line_start_ = pos_ + 1;
    } else if (*pos_ == '#') {
      while (pos_ + 1 < end_ && pos_[1] != '\n' && pos_[1] != '\r') ++pos_;
    } else if (!is_blank(*pos_)) {
      return;
    }
  }
}

std::string_view Tokenizer::scan_word() {
  const char* start = pos_;
  while (pos_ < end_ && !ends_word(*pos_)) ++pos_;
  return {start, static_cast<std::size_t>(pos_ - start)};
}

Token Tokenizer::scan() {
  skip_blank();
  const Position at = here();
  if (pos_ == end_) return {Token::Kind::end, "", at};
  if (*pos_ == '"') return scan_string();
  if (*pos_ == '[' || *pos_ == ']') {
    const auto kind = *pos_ == '[' ? Token::Kind::open : Token::Kind::close;
    return {kind, {pos_++, 1}, at};
  }
  return {Token::Kind::word, scan_word(), at};
}

Token Tokenizer::scan_string() {
  const Position at = here();
  const char* start = ++pos_;
  bool escapes = false;
  while (pos_ < end_ && *pos_ != '"' && *pos_ != '\n') {
    if (*pos_ == '\\' && pos_ + 1 < end_ && pos_[1] != '\n') {
      escapes = true;
      ++pos_;
    }
    ++pos_;
  }
  if (pos_ >= end_ || *pos_ != '"') throw error(at, "string is not closed; add a \" before the end of the line");
  const std::string_view raw(start, static_cast<std::size_t>(pos_ - start));
  ++pos_;
  return {Token::Kind::string, escapes ? unescape(raw, at) : raw, at};
}

std::string_view Tokenizer::unescape(std::string_view raw, Position at) {
  std::string out;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != '\\') {
      out += raw[i];
      continue;
    }
    const char c = escaped(raw[++i]);
    if (!c) throw error(at, "string has an unknown escape \\" + printable(raw.substr(i, 1)) + "; write \\\\ for \\");
    out += c;
  }
  return unescaped_.emplace_back(std::move(out));
}

template <typename T>
T Tokenizer::parse(std::string_view word, Position at) const {
  T value;
  const NumberFault fault = parse_number(word, value);
  if (fault == NumberFault::none) return value;
  const std::string shown = "\"" + printable(word) + "\"";
  const bool integer = std::is_integral_v<T>;
  if (fault == NumberFault::out_of_range)
    throw error(at, shown + " is too large" + (integer ? " for a 32-bit integer" : "") + "; use a smaller number");
  throw error(at, shown + (integer ? " is not an integer" : " is not a number") + "; check its spelling");
}

template <typename T>
T Tokenizer::parse(const Token& token) const {
  if (token.is(Token::Kind::word)) return parse<T>(token.text, token.at);
  const std::string got = token.is(Token::Kind::end) ? "the file ends" : "found " + shown(token);
  throw error(token.at, std::string("expected ") + (std::is_integral_v<T> ? "an integer" : "a number") + " but " + got +
                            "; give the missing value");
}

double Tokenizer::number() { return parse<double>(next()); }
float Tokenizer::to_number(const Token& token) const { return parse<float>(token); }
std::int32_t Tokenizer::to_integer(const Token& token) const { return parse<std::int32_t>(token); }

template <typename T>
void Tokenizer::append(std::vector<T>& out) {
  while (true) {
    skip_blank();
    if (pos_ == end_ || ends_word(*pos_)) return;
    const Position at = here();
    out.push_back(parse<T>(scan_word(), at));
  }
}

void Tokenizer::append_numbers(std::vector<float>& out) { append(out); }
void Tokenizer::append_integers(std::vector<std::int32_t>& out) { append(out); }

}  // namespace tyndall::pbrt
