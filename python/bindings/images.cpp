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

void save_exr(py::handle image, const std::string& path) {
  const Image value = to_image(image);
  const py::gil_scoped_release free;
  write_exr(value, path);
}

void save_png(py::handle image, const std::string& path, float exposure) {
  const Image value = to_image(image);
  const py::gil_scoped_release free;
  write_png(value, path, exposure);
}

py::bytes as_png(py::handle image, float exposure) {
  const Image value = to_image(image);
  std::string bytes;
  {
    const py::gil_scoped_release free;
    bytes = encode_png(value, exposure);
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
  m.def("write_exr", save_exr);
  m.def("write_png", save_png);
  m.def("encode_png", as_png);
  m.def("diff", diff);
  m.def("denoise", filtered);
  m.def("denoise_aovs", [] { return denoise_aovs(); });
}

}  // namespace tyndall::python
