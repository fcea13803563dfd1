#include "io/tev_message.h"

#include <bit>
#include <cstdint>

namespace tyndall {
namespace {

enum class Type : std::uint8_t { create = 4, update = 6 };

class Message {
 public:
  explicit Message(Type type) {
    add(std::uint32_t{0});  // the length, once it is known
    add(static_cast<std::uint8_t>(type));
  }

  template <typename Unsigned>
  void add(Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes_ += static_cast<char>(std::uint64_t{value} >> (8 * i) & 0xff);
  }
  void add_int(int value) { add(static_cast<std::uint32_t>(value)); }
  void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void add(float value) { add(std::bit_cast<std::uint32_t>(value)); }
  void add_channels(const Image& image) {
    add_int(static_cast<int>(image.channels.size()));
    for (const Channel& c : image.channels) add(c.name);
  }

  std::string take() {
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    for (std::size_t i = 0; i < 4; ++i) bytes_[i] = static_cast<char>(length >> (8 * i) & 0xff);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

constexpr std::uint8_t kNoFocus = 0;  ///< the viewer does not turn to the image

}  // namespace

std::string tev_create(const std::string& name, const Image& image) {
  Message m(Type::create);
  m.add(kNoFocus);
  m.add(name);
  m.add_int(image.width());
  m.add_int(image.height());
  m.add_channels(image);
  return m.take();
}

std::string tev_update(const std::string& name, const Image& image, const PixelBounds& tile) {
  Message m(Type::update);
  m.add(kNoFocus);
  m.add(name);
  m.add_channels(image);
  for (const int n : {tile.x0, tile.y0, tile.width(), tile.height()}) m.add_int(n);
  // Where each channel begins, and the steps between its pixels, in floats: one plane after the other.
  for (std::size_t c = 0; c < image.channels.size(); ++c) m.add(std::uint64_t{c * tile.size()});
  for (std::size_t c = 0; c < image.channels.size(); ++c) m.add(std::uint64_t{1});
  const PixelBounds whole{0, 0, image.width(), image.height()};
  for (const Channel& c : image.channels)
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) m.add(c.values[whole.index(x, y)]);
  return m.take();
}

}  // namespace tyndall
