#include "io/lens_file.h"

#include <cmath>

#include "io/file_text.h"
#include "io/pbrt_number.h"

namespace tyndall {
namespace {

constexpr std::size_t kMostElements = 1000;
constexpr double kLongest = 1e6;  // mm

class LensReader {
 public:
  LensReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  std::vector<LensElement> read() {
    std::vector<LensElement> elements;
    bool has_stop = false;
    while (skip_to_word()) {
      const LensElement element = read_element();
      if (element.radius == 0 && has_stop) throw error("the lenses have a second stop (radius 0); keep one");
      has_stop = has_stop || element.radius == 0;
      elements.push_back(element);
      if (elements.size() > kMostElements) throw error("there are more than 1000 lens surfaces; correct the file");
    }
    if (elements.empty()) throw error("has no lenses; give rows of radius, thickness, eta and diameter in mm");
    if (elements.back().radius == 0 && elements.size() == 1) throw error("is a stop without lenses; add some");
    return elements;
  }

 private:
  Error error(const std::string& what) const { return Error(Location{path_, at_line_, at_column_}, what); }

  LensElement read_element() {
    const double radius = number("a radius of curvature"), thickness = number("a thickness");
    if (thickness < 0) throw error("a thickness must not be negative; surfaces stand one behind the other");
    const double eta = number("an index of refraction");
    if (eta != 0 && !(eta >= 1 && eta <= 10)) throw error("an index of refraction must be from 1 to 10, or 0 for air");
    const double diameter = number("a diameter");
    if (!(diameter >= 1e-3)) throw error("a diameter must be at least 0.001");
    const auto metres = [](double mm) { return static_cast<float>(mm / 1000); };
    return {metres(radius), metres(thickness), static_cast<float>(eta), metres(diameter / 2)};
  }

  /// False at the end of the file.
  bool skip_to_word() {
    for (bool comment = false; used_ < text_.size(); ++used_) {
      const char c = text_[used_];
      if (c == '\n') {
        ++line_;
        line_start_ = used_ + 1;
        comment = false;
      } else if (c == '#') {
        comment = true;
      } else if (!comment && !is_space(c)) {
        break;
      }
    }
    at_line_ = line_;
    at_column_ = static_cast<int>(used_ - line_start_) + 1;
    return used_ < text_.size();
  }

  double number(const char* what) {
    if (!skip_to_word())
      throw error(std::string("the file ends before ") + what + "; a row has radius, thickness, eta and diameter");
    const std::size_t begin = used_;
    while (used_ < text_.size() && !is_space(text_[used_]) && text_[used_] != '#') ++used_;
    double value = 0;
    if (pbrt::parse_number(text_.substr(begin, used_ - begin), value) != pbrt::NumberFault::none)
      throw error(std::string("expected ") + what + ", a number; correct it");
    if (std::abs(value) > kLongest) throw error(std::string(what) + " must not be above 1e6; lengths are in mm");
    return value;
  }

  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  std::string_view text_;
  const std::string& path_;
  std::size_t used_ = 0, line_start_ = 0;
  int line_ = 1;                     ///< of what comes next
  int at_line_ = 1, at_column_ = 1;  ///< of what was read last
};

}  // namespace

std::vector<LensElement> read_lens_file(const std::string& path) {
  const std::string text = read_file_text(path);
  return read_lens_text(text, path);
}

std::vector<LensElement> read_lens_text(std::string_view text, const std::string& name) {
  return LensReader(text, name).read();
}

}  // namespace tyndall
