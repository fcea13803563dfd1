#include "transport/sharing/vertex_shares.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

/// Who makes a find with a smaller part of the largest density is none of those who share it: it would hardly weigh, and
/// cost a shadow ray. What it finds there by itself is its own. Any value is unbiased.
constexpr float kLeastPart = 0.01f;
/// Paths, with the finder, that are asked whether they might have made a find.
constexpr std::size_t kProbes = 8;

}  // namespace

/// A receiver and a find, with what is in between.
struct VertexShares::Linked {
  Rgb f;           ///< scattering, and transmittance where the find is another's
  float own = 0;   ///< density with which the receiver's path might have come there and made the find
  float made = 0;  ///< with which it might, having come there; 0: it has not
  Rgb flight;      ///< of the path's own find: what its flight weighs, over the chance of it
};

void VertexShares::add_behind(Path& path) {
  const bool arrived = path.offers() && path.offer().first.on_surface() && !is_black(path.offer().beta);
  PathOffer* const offer = arrived ? &path.offer() : path.behind();
  if (!offer) return;
  CameraSegment* const segment = path.segment();
  if (!segment || offer->bounces > 1) return add_arrived(path);
  const Rgb T = segment->transmittance(between_.transmittance, between_.counters.tracking);
  receivers_.push_back({&path, offer, arrived, segment->chance_of_passing(), T});
}

float VertexShares::sharers(const Find& find) const {
  const float least = kLeastPart * connect(*find.of, find).pdf;
  if (!(least > 0)) return 1;
  const auto at = std::find_if(receivers_.begin(), receivers_.end(), [&](const Receiver& r) { return r.made(find); });
  const auto own = static_cast<std::size_t>(at - receivers_.begin());
  const std::size_t n = receivers_.size(), step = (n + kProbes - 1) / kProbes;
  int probes = 0, might = 0;
  for (std::size_t i = step; i < n; i += step, ++probes) might += connect(*receivers_[(own + i) % n].offer, find).pdf >= least;
  between_.counters.connections += static_cast<std::uint64_t>(probes);
  return might > 0 ? 1 + static_cast<float>(might) / static_cast<float>(probes) * static_cast<float>(n - 1) : 1;
}

VertexShares::Linked VertexShares::link(const Receiver& receiver, const Connection& connection, const Find& find) const {
  const bool own = receiver.made(find);
  if (!receiver.arrived && is_black(receiver.throughput)) return {};
  const Link link = own ? Link::own(between_, *find.of) : Link(between_, receiver.offer->first, *find.of);
  const auto passage = link.pass(receiver.offer->beta * connection.f);
  if (!passage) return {};
  Linked linked;
  linked.f = connection.f;
  linked.own = receiver.passes * connection.pdf * passage->likely;
  if (receiver.arrived) linked.made = connection.pdf * passage->chance;
  if (own) {
    linked.flight = passage->flight();
  } else {
    linked.f *= passage->weight;
  }
  return linked;
}

void VertexShares::share(const Find& find, float scale) {
  const auto where = Path::received_at(find.of->first);
  const std::size_t n = receivers_.size();
  between_.counters.connections += n;
  std::array<Connection, kMostSharing> to;
  float largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    to[k] = connect(*receivers_[k].offer, find);
    largest = std::max(largest, to[k].pdf);
  }
  std::array<Linked, kMostSharing> linked;
  double sum = 0;
  Rgb flight;
  for (std::size_t k = 0; k < n; ++k) {
    if (to[k].pdf > 0 && to[k].pdf >= kLeastPart * largest) linked[k] = link(receivers_[k], to[k], find);
    sum += linked[k].made;
    if (receivers_[k].made(find)) flight = linked[k].flight;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Receiver& receiver = receivers_[k];
    const auto density = static_cast<float>(linked[k].own + (sum - linked[k].made));
    const bool shares = linked[k].own > 0 && std::isfinite(density);
    if (receiver.made(find)) {
      receiver.path->take(receiver.path->own_factor(find) * (scale * (shares ? linked[k].own / density : 1.0f)), find, where);
    } else if (shares && !is_black(flight)) {
      receiver.path->take(receiver.throughput * linked[k].f * flight * (scale / density), find, where);
    }
  }
}

}  // namespace tyndall
