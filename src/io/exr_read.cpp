#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <thread>

#include "io/exr.h"
#include "io/exr_guard.h"
#include "io/exr_header.h"
#include "io/exr_input.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

ExrFile decode(const std::string& path) {
  ExrInput input(path);
  ExrFile result;
  result.image = input.header();
  result.compression = name_of(input.first().compression());
  result.storage = input.first().hasTileDescription() ? "tiles" : "scanlines";
  result.parts = input.parts();
  result.channel_types = input.channel_types();
  Image& image = result.image;
  std::vector<std::vector<float>> planes(image.channels.size(), std::vector<float>(image.data.size()));
  input.read_rows(image.data.y0, image.data.y1, planes);
  for (std::size_t c = 0; c < planes.size(); ++c) image.channels[c].values = std::move(planes[c]);
  return result;
}

/// Where each of the image's channels stands in the file; nothing when the file is of another image.
std::optional<std::vector<std::size_t>> order_in(const Image& file, const Image& image) {
  if (file.data != image.data || file.channels.size() != image.channels.size()) return std::nullopt;
  std::vector<std::size_t> order;
  for (const Channel& c : image.channels) {
    const Channel* found = file.find(c.name);
    if (!found) return std::nullopt;
    order.push_back(static_cast<std::size_t>(found - file.channels.data()));
  }
  return order;
}

bool holds(const std::string& path, const Image& image, bool same_values) {
  constexpr int strip = 64;  // rows; keeps the check's memory small beside the image's
  ExrInput input(path, exr_threads(image.channels.size() * image.channels.front().values.size()));
  const auto order = order_in(input.header(), image);
  if (!order) return false;
  const auto width = static_cast<std::size_t>(image.width());
  std::vector<std::vector<float>> planes(order->size(), std::vector<float>(width * strip));
  for (int y0 = image.data.y0; y0 < image.data.y1; y0 += strip) {
    const int y1 = std::min(y0 + strip, image.data.y1);
    input.read_rows(y0, y1, planes);
    const std::size_t first = width * static_cast<std::size_t>(y0 - image.data.y0);
    const std::size_t bytes = width * static_cast<std::size_t>(y1 - y0) * sizeof(float);
    for (std::size_t c = 0; same_values && c < planes.size(); ++c)
      if (std::memcmp(planes[(*order)[c]].data(), image.channels[c].values.data() + first, bytes) != 0) return false;
  }
  return true;
}

constexpr int kUsefulThreads = 8;
std::atomic<int> most_threads{kUsefulThreads};  ///< OpenEXR's pool is one for the whole program, and so is this

}  // namespace

int exr_threads(std::size_t values) {
  constexpr std::size_t kSmall = 1 << 21;
  const int wanted = std::min(static_cast<int>(std::thread::hardware_concurrency()), most_threads.load());
  // Asking makes the pool. Made by the first task, in memory that there is not, it would leave who waits for the task waiting.
  const int there = Imf::globalThreadCount();
  if (values < kSmall || wanted <= 1) return 0;
  if (there < wanted) Imf::setGlobalThreadCount(wanted);
  return wanted;
}

void limit_image_threads(int threads) { most_threads = threads > 0 ? std::min(threads, kUsefulThreads) : kUsefulThreads; }

bool is_exr(const std::string& path) { return Imf::isOpenExrFile(path.c_str()); }

ExrFile read_exr(const std::string& path) {
  return guarded_exr(path, [&] { return decode(path); });
}

Image read_exr_header(const std::string& path) {
  return guarded_exr(path, [&] { return ExrInput(path).header(); });
}

bool exr_holds(const std::string& path, const Image& image) {
  return guarded_exr(path, [&] { return holds(path, image, true); });
}

bool exr_has_pixels_of(const std::string& path, const Image& image) {
  return guarded_exr(path, [&] { return holds(path, image, false); });
}

}  // namespace tyndall
