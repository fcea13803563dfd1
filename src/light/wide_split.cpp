#include "light/wide_split.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <optional>
#include <vector>

#include "light/wide_buckets.h"

namespace tyndall {
namespace {

constexpr std::uint32_t kWidth = 8;
using Range = std::span<BuildLight>;

/// A part of a node's lights, and what the heuristic says of keeping it whole.
struct Part {
  Range lights;
  double measure = 0;
};

std::array<Part, 2> halves(Range lights, double measure) {
  const std::size_t middle = lights.size() / 2;
  return {{{lights.first(middle), measure / 2}, {lights.subspan(middle), measure / 2}}};
}

/// Moves those for which `first` holds to the front and gives their number. Without branches, which would be guessed
/// wrong every other time; large sets need too much space for that.
template <typename F>
std::size_t partition(Range lights, const F& first) {
  constexpr std::size_t kLarge = 65536;
  if (lights.size() > kLarge)
    return static_cast<std::size_t>(std::partition(lights.begin(), lights.end(), first) - lights.begin());
  thread_local std::vector<BuildLight> rest;
  if (rest.size() < lights.size()) rest.resize(std::min(std::bit_ceil(lights.size()), kLarge));
  std::size_t front = 0, back = 0;
  for (const BuildLight& light : lights) {
    const bool is_first = first(light);
    rest[back] = light;
    lights[front] = light;
    front += is_first;
    back += !is_first;
  }
  std::copy(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(back),
            lights.begin() + static_cast<std::ptrdiff_t>(front));
  return front;
}

/// Two parts that are not empty; in half when nothing tells the lights apart.
std::array<Part, 2> split(const Part& part) {
  const Range lights = part.lights;
  const auto cut = best_cut(lights);
  if (!cut) return halves(lights, part.measure);
  const std::size_t count = partition(lights, [&](const BuildLight& light) { return cut->on_first_side(light); });
  if (count == 0 || count == lights.size()) return halves(lights, part.measure);
  return {{{lights.first(count), cut->first}, {lights.subspan(count), cut->second}}};
}

/// Up to eight parts in order.
struct Parts {
  std::array<Part, kWidth> of;
  std::size_t size = 1;

  void replace(std::size_t i, std::span<const Part> by) {
    std::move_backward(of.begin() + i + 1, of.begin() + size, of.begin() + size + by.size() - 1);
    std::copy(by.begin(), by.end(), of.begin() + i);
    size += by.size() - 1;
  }
};

/// The part that it pays most to split; only such as do not fit one node.
std::optional<std::size_t> worst(const Parts& parts) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < parts.size; ++i) {
    if (parts.of[i].lights.size() <= kWidth) continue;
    if (!found || parts.of[i].measure > parts.of[*found].measure) found = i;
  }
  return found;
}

/// The smallest part that the free places could take light by light: that saves a node.
std::optional<std::size_t> smallest(const Parts& parts) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < parts.size; ++i) {
    const std::size_t n = parts.of[i].lights.size();
    if (n < 2 || parts.size - 1 + n > kWidth) continue;
    if (!found || n < parts.of[*found].lights.size()) found = i;
  }
  return found;
}

}  // namespace

Division divide(std::span<BuildLight> lights) {
  assert(!lights.empty());
  Parts parts;
  parts.of[0] = {lights, 1};
  while (parts.size < kWidth) {
    const auto i = worst(parts);
    if (!i) break;
    const auto two = split(parts.of[*i]);
    parts.replace(*i, two);
  }
  while (const auto i = smallest(parts)) {
    std::array<Part, kWidth> single;
    const Range whole = parts.of[*i].lights;
    for (std::size_t k = 0; k < whole.size(); ++k) single[k] = {whole.subspan(k, 1), 0};
    parts.replace(*i, std::span(single).first(whole.size()));
  }
  Division division{};
  for (std::size_t i = 0; i < parts.size; ++i) division[i] = static_cast<std::uint32_t>(parts.of[i].lights.size());
  return division;
}

}  // namespace tyndall
