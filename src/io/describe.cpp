#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>

#include "io/describe_text.h"
#include "io/exr.h"
#include "io/file_text.h"
#include "io/image_decode.h"
#include "tyndall/deep_image.h"
#include "tyndall/io.h"
#include "tyndall/volume_io.h"

namespace tyndall {
namespace {

std::string size_text(const PixelBounds& b) {
  return std::to_string(b.width()) + " x " + std::to_string(b.height()) + " at " + std::to_string(b.x0) + ", " +
         std::to_string(b.y0);
}

std::string attribute_text(const Attribute& attribute) {
  if (const auto* text = std::get_if<std::string>(&attribute)) return *text;
  if (const auto* i = std::get_if<int>(&attribute)) return std::to_string(*i);
  if (const auto* f = std::get_if<float>(&attribute)) return number_text(*f);
  if (const auto* d = std::get_if<double>(&attribute)) return number_text(*d);
  std::string rows;
  for (float value : std::get<std::array<float, 16>>(attribute)) rows += (rows.empty() ? "" : " ") + number_text(value);
  return rows;
}

/// Smallest, largest and mean finite value, and how many are not finite.
std::string statistics_text(const std::vector<float>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
  std::size_t finite = 0;
  for (float v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min<double>(low, v);
    high = std::max<double>(high, v);
    sum += v;
    ++finite;
  }
  std::string text = finite == 0 ? "no finite value"
                                 : "min " + number_text(low) + ", max " + number_text(high) + ", mean " +
                                       number_text(sum / static_cast<double>(finite));
  if (finite < values.size()) text += ", " + std::to_string(values.size() - finite) + " NaN or infinite";
  return text;
}

void add_image(const Image& image, const std::vector<std::string>& types, Description& result) {
  result.properties.push_back({"image", "data window", size_text(image.data)});
  result.properties.push_back({"image", "display window", size_text(image.display)});
  if (const auto& c = image.chromaticities) {
    std::string text;
    for (Vec2 v : {c->red, c->green, c->blue, c->white})
      text += (text.empty() ? "" : ", ") + number_text(v.x) + " " + number_text(v.y);
    result.properties.push_back({"image", "chromaticities", text});
  }
  for (const auto& [name, value] : image.attributes) result.properties.push_back({"attribute", name, attribute_text(value)});
  for (std::size_t i = 0; i < image.channels.size(); ++i) {
    const Channel& c = image.channels[i];
    if (i < types.size()) result.properties.push_back({c.name, "type", types[i]});
    result.properties.push_back({c.name, "values", statistics_text(c.values)});
  }
}

/// What is not OpenEXR's, by its first bytes.
Description describe_picture(const std::string& path) {
  Description result{path, "image", {}};
  const Image image = read_image(path);
  const std::string bytes = read_file_text(path);
  if (is_png(bytes)) {
    result.kind = "PNG image";
    result.properties.push_back({"image", "stored", png_storage(bytes)});
  } else if (is_pfm(bytes)) {
    result.kind = "portable float map";
    result.properties.push_back({"image", "stored", bytes[1] == 'F' ? "32-bit float RGB" : "32-bit float grey"});
  }
  add_image(image, {}, result);
  return result;
}

/// The channels are of what its samples make together.
Description describe_deep(const std::string& path) {
  Description result{path, "deep OpenEXR image", {}};
  const DeepImage image = read_deep_exr(path);
  const auto most = std::max_element(image.counts.begin(), image.counts.end());
  result.properties.push_back({"image", "deep samples", std::to_string(image.samples.size())});
  result.properties.push_back({"image", "in a pixel", "at most " + std::to_string(*most)});
  std::vector<float> depths;
  for (const DeepPixelSample& sample : image.samples) depths.push_back(sample.z);
  result.properties.push_back({"image", "depth", statistics_text(depths)});
  add_image(flatten(image), {}, result);
  return result;
}

Description describe_image(const std::string& path) {
  Description result{path, "image", {}};
  if (!std::filesystem::is_regular_file(path) || !is_exr(path)) return describe_picture(path);
  if (is_deep_exr(path)) return describe_deep(path);
  const ExrFile file = read_exr(path);
  result.kind = "OpenEXR image";
  result.properties.push_back({"image", "compression", file.compression});
  result.properties.push_back({"image", "storage", file.storage});
  if (file.parts > 1) result.properties.push_back({"image", "parts", std::to_string(file.parts)});
  add_image(file.image, file.channel_types, result);
  return result;
}

}  // namespace

Description describe(const std::string& path) {
  const std::filesystem::path p(path);
  std::string extension = p.extension() == ".gz" ? p.stem().extension().string() : p.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".vdb" || extension == ".nvdb") return describe_volume(path);
  if (extension == ".pbrt") return describe_scene(path);
  return describe_image(path);
}

}  // namespace tyndall
