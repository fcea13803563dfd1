#include "tyndall/image.h"

#include "tyndall/error.h"

namespace tyndall {

std::string crop_text(const PixelBounds& c) {
  return std::to_string(c.x0) + "," + std::to_string(c.x1) + "," + std::to_string(c.y0) + "," + std::to_string(c.y1);
}

Channel& Image::add_channel(std::string name) {
  const auto count = static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  channels.push_back({std::move(name), std::vector<float>(count)});
  return channels.back();
}

const Channel* Image::find(std::string_view channel) const {
  for (const Channel& c : channels)
    if (c.name == channel) return &c;
  return nullptr;
}

Rgb Image::rgb(int x, int y) const {
  const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
  const Channel *r = find("R"), *g = find("G"), *b = find("B");
  if (r && g && b) return {r->values[i], g->values[i], b->values[i]};
  if (const Channel* grey = find("Y")) return Rgb(grey->values[i]);
  throw Error(Failure::scene, "image has neither channels R, G, B nor Y; choose one that has");
}

}  // namespace tyndall
