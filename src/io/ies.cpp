/// Photometric data files, IES LM-63 of 1986 to 2019.
///
/// After lines of keywords and one of TILT, all is numbers that white space or commas separate: how many lamps and vertical and
/// horizontal angles, factors, sizes, the angles, and a row of candela for each horizontal angle.
#include <algorithm>
#include <cmath>

#include "io/file_text.h"
#include "io/pbrt_number.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr int kMostAngles = 10'000;

class IesReader {
 public:
  IesReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  PhotometricWeb read() {
    read_head();
    const double lamps = number("the number of lamps");
    if (!(lamps >= 1)) throw error("the number of lamps must be at least 1");
    number("lumens per lamp");
    double factor = number("the candela multiplier");
    const int vertical = count("vertical angles", 2), horizontal = count("horizontal angles", 1);
    require_type_c();
    for (const char* what : {"the unit of length", "the width", "the length", "the height"}) number(what);
    factor *= number("the ballast factor");
    const double reserved = number("the ballast-lamp factor");  // since 2019 it tells how the file was made
    if (!since_2019_) factor *= reserved;
    if (!(factor >= 0) || !std::isfinite(factor)) throw error("the candela factors must not be negative");
    number("the input watts");

    PhotometricWeb web;
    web.vertical_degrees = angles(vertical, "vertical");
    require_vertical(web.vertical_degrees);
    web.horizontal_degrees = angles(horizontal, "horizontal");
    require_horizontal(web.horizontal_degrees);
    for (int i = 0; i < vertical * horizontal; ++i) web.candela.push_back(candela(factor));
    return web;
  }

 private:
  Error error(const std::string& what) const { return Error(Location{path_, at_line_, at_column_}, what); }

  std::string_view next_line() {
    const std::size_t end = std::min(text_.find('\n', used_), text_.size());
    std::string_view line = text_.substr(used_, end - used_);
    at_line_ = line_;
    at_column_ = 1;
    used_ = std::min(end + 1, text_.size());
    line_start_ = used_;
    ++line_;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    return line;
  }

  void read_head() {
    for (bool first = true; used_ < text_.size(); first = false) {
      const std::string_view line = next_line();
      if (first) since_2019_ = line.starts_with("IES:LM-63-2019");
      if (!line.starts_with("TILT=")) continue;
      if (line == "TILT=INCLUDE") skip_tilt();
      return;
    }
    throw error("is no photometric file: a line \"TILT=\" is missing; give an IES LM-63 file");
  }

  /// Factors for luminaires that are mounted at other angles than they were measured at: none are here.
  void skip_tilt() {
    number("the lamp's position");
    const int pairs = count("tilt angles", 1);
    for (int i = 0; i < 2 * pairs; ++i) number(i < pairs ? "a tilt angle" : "a tilt factor");
  }

  std::string_view word(const char* what) {
    const auto separates = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == '\x1a'; };
    for (; used_ < text_.size() && separates(text_[used_]); ++used_) {
      if (text_[used_] != '\n') continue;
      ++line_;
      line_start_ = used_ + 1;
    }
    at_line_ = line_;
    at_column_ = static_cast<int>(used_ - line_start_) + 1;
    const std::size_t begin = used_;
    while (used_ < text_.size() && !separates(text_[used_])) ++used_;
    if (begin == used_) throw error(std::string("the file ends before ") + what + "; it may not have been written to its end");
    return text_.substr(begin, used_ - begin);
  }

  double number(const char* what) {
    const std::string_view text = word(what);
    double value = 0;
    if (pbrt::parse_number(text, value) != pbrt::NumberFault::none || std::abs(value) > 1e30)
      throw error(std::string("expected ") + what + ", a number; correct it");
    return value;
  }

  int count(const char* what, int least) {
    const double value = number((std::string("the number of ") + what).c_str());
    if (value != std::floor(value) || value < least || value > kMostAngles)
      throw error(std::string("the number of ") + what + " must be a whole one from " + std::to_string(least) + " to " +
                  std::to_string(kMostAngles));
    return static_cast<int>(value);
  }

  void require_type_c() {
    const double type = number("the photometric type");
    if (type == 1) return;
    if (type == 2 || type == 3)
      throw error(std::string("photometry of type ") + (type == 2 ? "B" : "A") +
                  " is not supported by Tyndall; convert the file to type C");
    throw error("the photometric type must be 1 (C), 2 (B) or 3 (A)");
  }

  std::vector<float> angles(int count, const char* kind) {
    std::vector<float> list;
    for (int i = 0; i < count; ++i) {
      const auto degrees =
          static_cast<float>(number(kind == std::string_view("vertical") ? "a vertical angle" : "a horizontal angle"));
      if (i > 0 && !(degrees > list.back())) throw error(std::string(kind) + " angles must increase; put them in order");
      list.push_back(degrees);
    }
    return list;
  }

  void require_vertical(const std::vector<float>& degrees) const {
    const float first = degrees.front(), last = degrees.back();
    if (!(first >= 0 && last <= 180)) throw error("vertical angles of type C run from 0 to 180 degrees at most; correct them");
  }

  void require_horizontal(const std::vector<float>& degrees) const {
    const float first = degrees.front(), last = degrees.back();
    if (degrees.size() == 1 || (first == 90 && last == 270)) return;
    if (first != 0 || !(last == 90 || (last >= 180 && last <= 360)))
      throw error(
          "horizontal angles of type C begin at 0 and end at 90, 180 or 360 degrees, or run from 90 to 270; correct them");
  }

  float candela(double factor) {
    const double value = factor * number("a candela value");
    if (value < 0) throw error("candela must not be negative; correct the value");
    if (value > 1e30) throw error("the candela value is too large; correct it or the multiplier");
    return static_cast<float>(value);
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t used_ = 0, line_start_ = 0;
  int line_ = 1;                     ///< of what comes next
  int at_line_ = 1, at_column_ = 1;  ///< of what was read last
  bool since_2019_ = false;
};

}  // namespace

PhotometricWeb read_ies(const std::string& path) {
  const std::string text = read_file_text(path);
  return read_ies_text(text, path);
}

PhotometricWeb read_ies_text(std::string_view text, const std::string& name) { return IesReader(text, name).read(); }

}  // namespace tyndall
