/// Which light group each light of a world is in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "light/query.h"
#include "tyndall/scene.h"
#include "volume/medium.h"

namespace tyndall {

/// Names that the scene gives to groups of its lights, area lights and media, sorted, once each.
std::vector<std::string> named_light_groups(const Scene& scene);

class LightGroups {
 public:
  LightGroups() = default;

  /// In the order of their channels: those that the scene names, and kUngrouped where something emits without a group. Empty
  /// where it names none.
  const std::vector<std::string>& names() const { return names_; }
  bool empty() const { return names_.empty(); }
  std::size_t size() const { return names_.size(); }
  /// Indices of names(); not when empty().
  std::size_t of(LightId light) const;
  std::size_t of(const ParticipatingMedium& medium) const;

 private:
  friend class LightGroupsBuilder;
  /// Lights from `first` up to the next run's.
  struct Run {
    LightId first;
    std::uint32_t group;
  };
  std::vector<std::string> names_;
  std::vector<Run> runs_;  ///< by first; neighbours differ
  const ParticipatingMedium* first_medium_ = nullptr;
  std::vector<std::uint32_t> of_medium_;
};

/// Takes up the lights in the order of their ids.
class LightGroupsBuilder {
 public:
  /// Throws Error (scene) for a name that is_light_group_name refuses.
  explicit LightGroupsBuilder(const Scene& scene);

  bool needed() const { return !groups_.names_.empty(); }
  /// Lights from `first` on, until the next call; of no light where that has the same `first`.
  void add(LightId first, const std::string& group);
  /// Those of the scene, in their order; kept by address. After all lights.
  LightGroups finish(const std::vector<ParticipatingMedium>& built, const std::vector<Medium>& media);

 private:
  std::uint32_t index_of(const std::string& group);

  LightGroups groups_;
};

}  // namespace tyndall
