/// From where light is received to a find (path_offer.h): how much of it comes there, and how likely a path was to go there.
#pragma once

#include <optional>

#include "transport/path/path_offer.h"
#include "transport/sample/counters.h"
#include "transport/world/built_world.h"

namespace tyndall {

/// What links go through, how, and where they are counted.
struct Between {
  const BuiltWorld& world;
  TransmittanceStrategy transmittance;
  Counters& counters;
};

/// A scattering function and its density.
struct Connection {
  Rgb f;          ///< scattering functions times cosine over squared distance
  float pdf = 0;  ///< 1/area, 1/volume or, of an environment, 1/sr, times that of the find's direction, by which a path would
                  ///< have made the find
};
/// Where a find is seen from a place, and what the find adds to the scattering there toward it: factors of a Connection.
struct Sighting {
  Vec3 w;
  Connection back;  ///< what it scatters back, over squared distance, and how likely; 1 of an environment
};
/// Nothing where it scatters nothing back.
std::optional<Sighting> sight(const Find& find, Vec3 p);
/// By the path of `from`, from its first vertex; without visibility. Nothing after another number of bounces, which leaves
/// others of the most that paths have.
Connection connect(const PathOffer& from, const Find& find);

/// What lies in between.
struct Passage {
  Rgb weight{1.0f};  ///< the transmittance; of a path's own find, what its flight weighs over its transmittance
  float chance = 1;  ///< of flying through: a proxy in grids, that both sides know; 0: the flight does not tell of all channels
  float likely = 1;  ///< the same for white light, whatever the path's throughput

  /// What the flight weighs over the chance of it; where it does not tell of all channels, which it may weigh by no number,
  /// nothing.
  Rgb flight() const { return chance > 0 ? weight * chance : Rgb(); }
};

/// A ray to a find.
class Link {
 public:
  /// Of the path that made the find.
  static Link own(const Between& between, PathOffer& find) { return Link(between, find.first, find, true); }
  Link(const Between& between, const Vertex& from, PathOffer& find) : Link(between, from, find, false) {}

  /// By light of `throughput` before it. Nothing where surfaces are in between, or not as many panes as the find lies behind:
  /// others leave it another number of bounces.
  std::optional<Passage> pass(Rgb throughput) const;

 private:
  Link(const Between& between, const Vertex& from, PathOffer& find, bool own);
  struct Piece;
  std::optional<Piece> beyond_pane(const Piece& piece, Rgb& throughput, Passage& passage) const;
  MediaState pass_media(const Piece& piece, const Crossings& crossings, float t_end, Rgb& throughput, Passage& passage) const;
  void pass_uniform(const Interval& interval, Rgb& throughput, Passage& passage) const;
  void pass_varying(const Interval& interval, const Ray& ray, Passage& passage) const;

  const Between& between_;
  PathOffer& find_;
  Ray ray_;
  MediaState media_;
  bool own_;
};

}  // namespace tyndall
