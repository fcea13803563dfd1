/// Finds of paths that collided in media, received anywhere along the camera's rays.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "transport/path/path.h"
#include "transport/sharing/find_link.h"

namespace tyndall {

/// A ray through media has a first vertex x1 wherever it likes: for each find x2 that another path has made it draws one of its
/// own, toward the find (DistanceSampler), whether the path of that ray collides or passes. L(x0) = sum over finds of
/// T(x1) sigma_s f(x1, x2) L(x2) / (p_j(x1, x2) + q_j(x1 | x2) sum_(k != j) p_k(x2)): the balance heuristic [Veach 1997]
/// between that and what the path j finds by itself, colliding at x1 and going on to x2; p_k are the densities with which the
/// others that collided, whether they found anything or not, go on to x2.
class SegmentShares {
 public:
  SegmentShares(const Between& between, std::span<Path* const> paths);

  /// Whether rays receive the finds of each other as if they were one: they are much closer together than light goes between
  /// collisions, some of them collide, and the media are homogeneous. Deterministic for given rays, whatever becomes of the
  /// paths. Else finds are received where paths collide (VertexShares).
  static bool pay(std::span<Path* const> paths);
  /// Whether light goes about as far between collisions as the rays are apart: else paths that collide hardly see what the
  /// others meet. Connections through homogeneous media have no noise of their own, and always count as near. Deterministic
  /// likewise.
  static bool near_each_other(std::span<Path* const> paths);

  /// About how many have part in a find: fewer where its own path is much more likely than others to make it.
  float sharers(const Find& find);
  /// Takes in a find, its light times `scale`.
  void share(const Find& find, float scale);
  /// Hands out all of them.
  void hand_out();

 private:
  using PerPath = std::array<float, kMostSharing>;
  struct Shared {
    const Find* find;
    std::size_t maker;  ///< index of its path
    float scale;
    PerPath might{};       ///< density with which a path that collided would make it, were all clear
    double might_sum = 0;  ///< of these
    PerPath made{};        ///< the same, with what is in between
    double made_sum = 0;
    float likely = 0;  ///< chance of its flight, by white light
    Rgb flight;        ///< what its flight weighs, over the chance of it
  };
  struct Candidate;

  Shared consider(const Find& find) const;
  void receive(std::size_t k);
  void take_own(const Shared& shared) const;
  std::optional<Candidate> draw(const Shared& shared, std::size_t k, float u) const;
  void link(const Candidate& candidate, Path& receiver, Rgb T) const;

  const Between& between_;
  std::span<Path* const> paths_;
  std::vector<std::size_t> makers_, receivers_;  ///< indices of paths
  std::vector<Shared> finds_;
};

}  // namespace tyndall
