#include "tyndall/deep_image.h"

#include <doctest/doctest.h>

using namespace tyndall;

TEST_CASE("samples are laid over each other front to back, pixel by pixel") {
  DeepImage deep;
  deep.data = {1, 2, 4, 3};
  deep.display = {0, 0, 5, 5};
  deep.attributes["software"] = std::string("s");
  deep.counts = {2, 0, 1};
  deep.samples = {{1, 2, {0.4f, 0.2f, 0, 0.6f}}, {3, 3, {0.1f, 0.3f, 1, 0.5f}}, {5, 5, {7, 0, 0, 0}}};
  const Image flat = flatten(deep);
  CHECK(flat.data == deep.data);
  CHECK(flat.display == deep.display);
  CHECK(*flat.attribute<std::string>("software") == "s");
  const auto at = [&](const char* channel, std::size_t pixel) { return flat.find(channel)->values[pixel]; };
  CHECK(at("R", 0) == doctest::Approx(0.4 + 0.4 * 0.1));
  CHECK(at("G", 0) == doctest::Approx(0.2 + 0.4 * 0.3));
  CHECK(at("B", 0) == doctest::Approx(0.4));
  CHECK(at("A", 0) == doctest::Approx(1 - 0.4 * 0.5));
  for (const char* channel : {"R", "G", "B", "A"}) CHECK(at(channel, 1) == 0);
  CHECK(at("R", 2) == 7);  // light that hides nothing
  CHECK(at("A", 2) == 0);
}
