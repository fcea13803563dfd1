#include "define.h"
#include "numbers.h"
#include "tyndall/compare.h"
#include "tyndall/denoise.h"
#include "tyndall/io.h"
#include "watch.h"

namespace tyndall::python {
namespace {

py::object read(py::handle path) {
  const std::string name = to_name(path, "path");
  std::optional<Image> image;
  Watched watched;
  run_watched(watched, [&] { image = read_image(name); });
  return from_image(std::move(*image));
}

/// The enum whose names these are.
template <typename Enum>
Enum chosen(py::handle value, const char* what, const std::vector<std::string_view>& names) {
  const auto name = as<std::string>(value, what);
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
    known += (i > 0 ? ", " : "") + std::string(names[i]);
  }
  throw py::value_error(what + (" = \"" + name + "\" is not known; choose from " + known));
}

PngSettings to_png(py::handle exposure, py::handle view) {
  return {.exposure = static_cast<float>(between("exposure", exposure, -kMostStops, kMostStops)),
          .view = chosen<DisplayView>(view, "view", view_names())};
}

void save(py::handle image, py::handle path, const py::dict& format) {
  const Image value = to_image(image);
  const std::string name = to_name(path, "path");
  ImageFormat settings;
  settings.png = to_png(format["exposure"], format["view"]);
  settings.exr.half = entry<bool>(format, "half");
  settings.exr.parts = entry<bool>(format, "parts");
  settings.exr.compression = chosen<ExrCompression>(format["compression"], "compression", exr_compression_names());
  Watched watched;
  run_watched(watched, [&] { write_image(value, name, settings); });
}

py::bytes as_png(py::handle image, py::handle exposure, py::handle view) {
  const Image value = to_image(image);
  const PngSettings settings = to_png(exposure, view);
  std::string bytes;
  Watched watched;
  run_watched(watched, [&] { bytes = encode_png(value, settings); });
  return bytes;
}

DiffQuestion to_question(const py::dict& q) {
  return {.channels = entry<std::vector<std::string>>(q, "channels"),
          .reference_noise = entry<bool>(q, "reference_noise"),
          .flip = entry<bool>(q, "flip"),
          .test = entry<bool>(q, "test"),
          .exact = entry<bool>(q, "exact"),
          .max_error = entry<std::optional<double>>(q, "max_error"),
          .max_relmse = entry<std::optional<double>>(q, "max_relmse"),
          .max_flip = entry<std::optional<double>>(q, "max_flip")};
}

/// JSON
std::string diff(py::handle image, py::handle reference, const py::dict& question) {
  const Image a = to_image(image), b = to_image(reference);
  const DiffQuestion q = to_question(question);
  std::string found;
  Watched watched;
  run_watched(watched, [&] { found = diff_images(a, b, q); });
  return found;
}

/// (image, {"seconds", "missing", "noisy_relmse", "relmse"})
py::tuple filtered(py::handle image, py::handle threads) {
  const Image noisy = to_image(image);
  const DenoiseSettings settings{.threads = whole("threads", threads, 0, kMostThreads)};
  std::optional<Denoised> result;
  Watched watched;
  run_watched(watched, [&] { result = denoise(noisy, settings); });
  const DenoiseReport& r = result->report;
  const py::dict report("seconds"_a = r.seconds, "missing"_a = r.missing, "noisy_relmse"_a = r.noisy_relmse,
                        "relmse"_a = r.relmse);
  return py::make_tuple(from_image(std::move(result->image)), report);
}

}  // namespace

void define_images(py::module_& m) {
  m.def("read_image", read);
  m.def("write_image", save);
  m.def("encode_png", as_png);
  m.def("diff", diff);
  m.def("denoise", filtered);
  m.def("denoise_aovs", [] { return denoise_aovs(); });
}

}  // namespace tyndall::python
