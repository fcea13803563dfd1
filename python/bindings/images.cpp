#include "define.h"
#include "tyndall/compare.h"
#include "tyndall/denoise.h"
#include "tyndall/io.h"
#include "watch.h"

namespace tyndall::python {
namespace {

py::object read(const std::string& path) {
  std::optional<Image> image;
  {
    const py::gil_scoped_release free;
    image = read_image(path);
  }
  return from_image(std::move(*image));
}

/// The enum whose names these are.
template <typename Enum>
Enum chosen(py::handle value, const char* what, const std::vector<std::string_view>& names) {
  const auto name = value.cast<std::string>();
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
    known += (i > 0 ? ", " : "") + std::string(names[i]);
  }
  throw py::value_error(what + (" = \"" + name + "\" is not known; choose from " + known));
}

PngSettings to_png(py::handle exposure, py::handle view) {
  return {.exposure = exposure.cast<float>(), .view = chosen<DisplayView>(view, "view", view_names())};
}

void save(py::handle image, const std::string& path, const py::dict& format) {
  const Image value = to_image(image);
  ImageFormat settings;
  settings.png = to_png(format["exposure"], format["view"]);
  settings.exr.half = format["half"].cast<bool>();
  settings.exr.parts = format["parts"].cast<bool>();
  settings.exr.compression = chosen<ExrCompression>(format["compression"], "compression", exr_compression_names());
  const py::gil_scoped_release free;
  write_image(value, path, settings);
}

py::bytes as_png(py::handle image, py::handle exposure, py::handle view) {
  const Image value = to_image(image);
  const PngSettings settings = to_png(exposure, view);
  std::string bytes;
  {
    const py::gil_scoped_release free;
    bytes = encode_png(value, settings);
  }
  return bytes;
}

DiffQuestion to_question(const py::dict& q) {
  return {.channels = q["channels"].cast<std::vector<std::string>>(),
          .reference_noise = q["reference_noise"].cast<bool>(),
          .flip = q["flip"].cast<bool>(),
          .test = q["test"].cast<bool>(),
          .exact = q["exact"].cast<bool>(),
          .max_error = q["max_error"].cast<std::optional<double>>(),
          .max_relmse = q["max_relmse"].cast<std::optional<double>>(),
          .max_flip = q["max_flip"].cast<std::optional<double>>()};
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
py::tuple filtered(py::handle image, int threads) {
  const Image noisy = to_image(image);
  std::optional<Denoised> result;
  Watched watched;
  run_watched(watched, [&] { result = denoise(noisy, {.threads = threads}); });
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
