#include "convert.h"

namespace tyndall::python {
namespace {

PixelBounds to_bounds(py::handle window) {
  const auto [x0, y0, x1, y1] = as<std::array<int, 4>>(window, "a window of an image");
  return {x0, y0, x1, y1};
}

py::tuple from_bounds(const PixelBounds& b) { return py::make_tuple(b.x0, b.y0, b.x1, b.y1); }

/// The floats of a channel as an array that owns them.
py::object plane_of(std::vector<float> values, int width, int height) {
  auto* kept = new std::vector<float>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<float>*>(p); });
  return py::array_t<float>({py::ssize_t{height}, py::ssize_t{width}}, kept->data(), owner);
}

/// A float stays a float, and no double, when the image is written again.
struct AttributeToPython {
  py::object operator()(int value) const { return py::int_(value); }
  py::object operator()(float value) const { return py::module_::import("numpy").attr("float32")(value); }
  py::object operator()(double value) const { return py::float_(value); }
  py::object operator()(const std::string& value) const { return from_text(value); }
  py::object operator()(const std::array<float, 16>& rows) const { return py::array_t<float>({4, 4}, rows.data()); }
};

Attribute to_attribute(py::handle value) {
  constexpr const char* kName = "an image attribute";
  if (py::isinstance<py::str>(value)) return as<std::string>(value, kName);
  if (py::isinstance<py::int_>(value)) return as<int>(value, kName);
  if (py::isinstance<py::float_>(value)) return as<double>(value, kName);
  if (!py::isinstance<py::array>(value)) return as<float>(value, kName);
  const auto matrix = as<Floats>(value, kName);
  if (matrix.size() != 16) throw py::value_error("an image attribute that is an array must be 4 x 4");
  std::array<float, 16> rows{};
  std::copy_n(matrix.data(), 16, rows.begin());
  return rows;
}

py::object from_chromaticities(const std::optional<Chromaticities>& c) {
  if (!c) return py::none();
  py::list points;
  for (const Vec2 v : {c->red, c->green, c->blue, c->white}) points.append(py::make_tuple(v.x, v.y));
  return py::tuple(points);
}

std::optional<Chromaticities> to_chromaticities(py::handle value) {
  if (value.is_none()) return std::nullopt;
  const auto p = as<std::array<std::array<float, 2>, 4>>(value, "chromaticities");
  return Chromaticities{{p[0][0], p[0][1]}, {p[1][0], p[1][1]}, {p[2][0], p[2][1]}, {p[3][0], p[3][1]}};
}

}  // namespace

Image to_image(py::handle image) {
  Image result;
  result.data = to_bounds(image.attr("data_window"));
  result.display = to_bounds(image.attr("display_window"));
  result.chromaticities = to_chromaticities(image.attr("chromaticities"));
  for (const auto& [name, value] : get<py::dict>(image, "attributes"))
    result.attributes[to_name(name, "an image attribute's name")] = to_attribute(value);
  for (const auto& [name, plane] : image.cast<py::dict>())
    result.channels.push_back({to_name(name, "a channel"), to_floats(as<Floats>(plane, "a channel"))});
  return result;
}

py::object from_image(Image image) {
  py::dict channels, attributes;
  for (Channel& c : image.channels) channels[from_name(c.name)] = plane_of(std::move(c.values), image.width(), image.height());
  for (const auto& [name, value] : image.attributes) attributes[from_name(name)] = std::visit(AttributeToPython{}, value);
  return python_class("tyndall.image", "Image")(channels, "data_window"_a = from_bounds(image.data),
                                                "display_window"_a = from_bounds(image.display), "attributes"_a = attributes,
                                                "chromaticities"_a = from_chromaticities(image.chromaticities));
}

}  // namespace tyndall::python
