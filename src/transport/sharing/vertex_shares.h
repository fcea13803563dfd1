/// Finds received at first vertices: on surfaces, or where paths collided.
#pragma once

#include <vector>

#include "transport/path/path.h"
#include "transport/sharing/find_link.h"

namespace tyndall {

/// L(x0) = sum over finds x2 of T(x1) f(x1, x2) L(x2) / p(x2), with the density p_j that the path j itself comes to x1 and
/// makes the find, and those of the others that have come to theirs, whether they found anything or not: p = p_j + sum_(k != j)
/// p_k, the balance heuristic [Veach 1997]. What the path itself found weighs p_j / p. A surface behind media may receive
/// whether or not the path has come there: then p_j has the chance of that as a factor.
class VertexShares {
 public:
  explicit VertexShares(const Between& between) : between_(between) {}

  /// The path has come to its first vertex; by chance, where nothing else is received.
  void add_arrived(Path& path) { receivers_.push_back({&path, &path.offer(), true, 1, path.offer().beta}); }
  /// All receive on the surface behind the camera's media, whatever becomes of the path. Nothing where there is no such
  /// surface.
  void add_behind(Path& path);

  /// About how many have part in a find: itself, and of the others as many as of some, evenly spread.
  float sharers(const Find& find) const;
  /// Hands out a find, its light times `scale`.
  void share(const Find& find, float scale);

 private:
  struct Receiver {
    Path* path;
    PathOffer* offer;
    bool arrived;
    float passes;    ///< the chance of that, roughly
    Rgb throughput;  ///< up to the vertex: the path's, or an estimate for all paths

    bool made(const Find& find) const { return path->offers() && &path->offer() == find.of; }
  };
  struct Linked;

  Linked link(const Receiver& receiver, const Connection& connection, const Find& find) const;

  const Between& between_;
  std::vector<Receiver> receivers_;
};

}  // namespace tyndall
