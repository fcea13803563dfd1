#include "io/pbrt_token.h"

#include <clocale>

#include "io/pbrt_number.h"
#include "unit/io/reader_checks.h"

using namespace tyndall;
using namespace tyndall::pbrt;
using Kind = Token::Kind;

TEST_CASE("words, strings, brackets and comments, each with its line and column") {
  Tokenizer in("Shape \"sphere\" # a comment \" [\n  \"float radius\" [1]\r\n\tx", "a.pbrt");
  struct Expected {
    Kind kind;
    const char* text;
    int line, column;
  };
  const Expected expected[] = {
      {Kind::word, "Shape", 1, 1}, {Kind::string, "sphere", 1, 7}, {Kind::string, "float radius", 2, 3},
      {Kind::open, "[", 2, 18},    {Kind::word, "1", 2, 19},       {Kind::close, "]", 2, 20},
      {Kind::word, "x", 3, 2},     {Kind::end, "", 3, 3},          {Kind::end, "", 3, 3}};
  for (const Expected& e : expected) {
    CHECK(in.peek().text == e.text);
    const Token token = in.next();
    CHECK(token.kind == e.kind);
    CHECK(token.text == e.text);
    CHECK(token.at.line == e.line);
    CHECK(token.at.column == e.column);
  }
}

TEST_CASE("strings undo escapes and end on their line") {
  Tokenizer in(R"("a\"b\\c\n" "é")", "a.pbrt");
  CHECK(in.next().text == "a\"b\\c\n");
  CHECK(in.next().text == "é");
  Tokenizer open("  \"abc\nx\"", "a.pbrt");
  CHECK(test::message_of([&] { open.next(); }).starts_with("a.pbrt:1:3: string is not closed"));
  Tokenizer unknown(R"("\q")", "a.pbrt");
  CHECK_CONTAINS(test::message_of([&] { unknown.next(); }), "unknown escape \\q");
}

TEST_CASE("byte order marks") {
  Tokenizer utf8("\xef\xbb\xbfx", "a.pbrt");
  CHECK(utf8.next().at.column == 1);
  CHECK_THROWS_AS(Tokenizer("\xff\xfe"
                            "W",
                            "a.pbrt"),
                  Error);
}

TEST_CASE("numbers of every notation, and nothing else") {
  double d;
  for (const auto& [text, value] : {std::pair{"1", 1.0},
                                    {"-1.5", -1.5},
                                    {"+2", 2.0},
                                    {".5", 0.5},
                                    {"-.5", -0.5},
                                    {"3.", 3.0},
                                    {"1e3", 1000.0},
                                    {"1E-2", 0.01},
                                    {"1e-400", 0.0},
                                    {"007", 7.0}}) {
    CHECK(parse_number(std::string_view(text), d) == NumberFault::none);
    CHECK(d == value);
  }
  for (const char* text : {"", "-", "+", ".", "abc", "1x", "1.2.3", "--1", "+-1", "inf", "nan", "-inf", "0x10", "1,5", "1e"})
    CHECK_MESSAGE(parse_number(std::string_view(text), d) == NumberFault::not_a_number, text);
  float f;
  CHECK(parse_number(std::string_view("1e39"), f) == NumberFault::out_of_range);
  CHECK(parse_number(std::string_view("1e-50"), f) == NumberFault::none);
  CHECK(f == 0);
  std::int32_t i;
  CHECK(parse_number(std::string_view("-2147483648"), i) == NumberFault::none);
  CHECK(parse_number(std::string_view("2147483648"), i) == NumberFault::out_of_range);
  CHECK(parse_number(std::string_view("1.0"), i) == NumberFault::not_a_number);
}

TEST_CASE("numbers do not depend on the locale") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const bool comma = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  double d = 0;
  CHECK(parse_number(std::string_view("1.5"), d) == NumberFault::none);
  CHECK(d == 1.5);
  if (comma) std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("lists of numbers are read in one go, with the place of a bad one") {
  Tokenizer in("[ 1 2 # three\n 3] x", "a.pbrt");
  std::vector<float> numbers;
  in.next();
  in.append_numbers(numbers);
  CHECK(numbers == std::vector<float>{1, 2, 3});
  CHECK(in.next().is(Kind::close));
  Tokenizer bad("1\n  2.x 3", "a.pbrt");
  CHECK(test::message_of([&] { bad.append_numbers(numbers); }).starts_with("a.pbrt:2:3: \"2.x\" is not a number"));
  std::vector<std::int32_t> integers;
  Tokenizer half("1 2.5", "a.pbrt");
  CHECK_CONTAINS(test::message_of([&] { half.append_integers(integers); }), "is not an integer");
}
