/// Ready scenes with parameters: what `tyndall example` writes. Equal options give equal bytes.
///
/// Each is a setting for one kind of difficulty: very many lights, glossy surfaces, light in fog, a cloud among lights.
/// Their defaults are fixed, because speed and error are measured on them. The total power of the lights does not
/// depend on how many there are, so that neither does the exposure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

enum class LampShape { triangle, point };

/// What is asked for; what is empty is the example's default.
struct ExampleOptions {
  std::optional<std::int64_t> lights{};  ///< how many, [1, 10 000 000]
  std::optional<double> density{};       ///< factor on the medium's density, [0, 1000]
  std::optional<LampShape> shape{};
  std::optional<int> max_depth{};  ///< bounces a path, >= 0
  int width = 640, height = 360;   ///< pixels
  std::uint64_t seed = 0;          ///< of everything random in the scene
};

/// An example and its defaults; an option without a default is one that it does not take.
struct ExampleInfo {
  std::string_view name, title;
  std::optional<std::int64_t> lights;
  std::optional<double> density;
  std::optional<LampShape> shape;
  int max_depth = 5;
};

struct ExampleFile {
  std::string name, bytes;
};

const std::vector<ExampleInfo>& example_list();

/// The files of an example, the scene first. Throws Error (usage), which lists what there is, for an unknown name, an
/// option that the example does not take or one out of range.
std::vector<ExampleFile> make_example(std::string_view name, const ExampleOptions& options);

/// Write these files into `folder`, which is made when it is missing; other files in it are left alone. Returns the
/// path of the scene. Throws Error (output).
std::string write_example(const std::vector<ExampleFile>& files, const std::string& folder);

}  // namespace tyndall
