#include "io/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "tyndall/error.h"

namespace tyndall {
namespace {

using Words = std::vector<std::string_view>;

std::optional<PlyType> find_type(std::string_view name) {
  if (name == "char" || name == "int8") return PlyType::int8;
  if (name == "uchar" || name == "uint8") return PlyType::uint8;
  if (name == "short" || name == "int16") return PlyType::int16;
  if (name == "ushort" || name == "uint16") return PlyType::uint16;
  if (name == "int" || name == "int32") return PlyType::int32;
  if (name == "uint" || name == "uint32") return PlyType::uint32;
  if (name == "float" || name == "float32") return PlyType::float32;
  if (name == "double" || name == "float64") return PlyType::float64;
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  PlyHeader read() {
    if (const Words magic = next_line(); magic.size() != 1 || magic[0] != "ply")
      throw error("is no ply file; it must begin with \"ply\"");
    PlyHeader header;
    header.encoding = read_format();
    for (Words words = next_line(); words.empty() || words[0] != "end_header"; words = next_line()) {
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "element")
        header.elements.push_back(read_element(words));
      else if (words[0] == "property" && !header.elements.empty())
        header.elements.back().properties.push_back(read_property(words));
      else
        throw error("header line is not understood; expected element, property or end_header");
    }
    header.size = used_;
    return header;
  }

 private:
  Error error(const std::string& what) const { return Error(Location{path_, line_, 1}, what); }

  Words next_line() {
    const std::size_t end = bytes_.find('\n', used_);
    if (end == std::string_view::npos) throw error("header ends too early; the file is truncated");
    std::string_view line = bytes_.substr(used_, end - used_);
    used_ = end + 1;
    ++line_;
    Words words;
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
      if (line.empty()) return words;
      words.push_back(line.substr(0, line.find_first_of(" \t\r")));
      line.remove_prefix(words.back().size());
    }
  }

  PlyEncoding read_format() {
    Words words = next_line();
    while (!words.empty() && words[0] == "comment") words = next_line();
    if (words.size() != 3 || words[0] != "format") throw error("header has no format line");
    if (words[1] == "ascii") return PlyEncoding::ascii;
    if (words[1] == "binary_little_endian") return PlyEncoding::little_endian;
    if (words[1] == "binary_big_endian") return PlyEncoding::big_endian;
    throw error("format is unknown; use ascii, binary_little_endian or binary_big_endian");
  }

  PlyElement read_element(const Words& words) const {
    PlyElement element;
    if (words.size() == 3) {
      const auto [end, fault] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
      if (fault == std::errc() && end == words[2].data() + words[2].size()) {
        element.name = words[1];
        return element;
      }
    }
    throw error("element line is not understood; expected \"element <name> <count>\"");
  }

  PlyProperty read_property(const Words& words) const {
    PlyProperty property;
    property.is_list = words.size() == 5 && words[1] == "list";
    if (words.size() != (property.is_list ? 5u : 3u)) throw error("property line is not understood");
    const auto type = find_type(words[property.is_list ? 3 : 1]);
    const auto count_type = property.is_list ? find_type(words[2]) : PlyType::uint8;
    if (!type || !count_type) throw error("property type is unknown");
    if (*count_type == PlyType::float32 || *count_type == PlyType::float64) throw error("list count is no integer type");
    property.type = *type;
    property.count_type = *count_type;
    property.name = words.back();
    return property;
  }

  std::string_view bytes_;
  const std::string& path_;
  std::size_t used_ = 0;
  int line_ = 0;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    default:
      return 4;
  }
}

std::size_t PlyElement::least_size() const {
  std::size_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.is_list ? p.count_type : p.type);
  return size;
}

int PlyElement::index_of(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& path) { return HeaderReader(bytes, path).read(); }

}  // namespace tyndall
