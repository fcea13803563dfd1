#include "transport/world/light_groups.h"

#include <algorithm>
#include <set>

#include "tyndall/error.h"

namespace tyndall {
namespace {

void require_name(const std::string& group, const Location& where) {
  if (!group.empty() && !is_light_group_name(group))
    throw Error(where, "the light group's name cannot name channels of an image; use 1 to 64 letters, digits, - and _");
}

template <typename Visit>
void for_each_group(const Scene& scene, const Visit& visit) {
  const auto visit_shapes = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) {
      if (shape.emission) visit(shape.emission->group, shape.where);
    }
  };
  for (const Light& light : scene.lights) visit(light.group, light.where);
  visit_shapes(scene.shapes);
  for (const Object& object : scene.objects) visit_shapes(object.shapes);
  for (const Medium& medium : scene.media) visit(medium.group, medium.where);
}

}  // namespace

std::vector<std::string> named_light_groups(const Scene& scene) {
  std::set<std::string_view> names;
  for_each_group(scene, [&](const std::string& group, const Location&) {
    if (!group.empty()) names.insert(group);
  });
  return {names.begin(), names.end()};
}

std::size_t LightGroups::of(LightId light) const {
  const auto after =
      std::upper_bound(runs_.begin(), runs_.end(), light, [](LightId id, const Run& run) { return id < run.first; });
  return std::prev(after)->group;
}

std::size_t LightGroups::of(const ParticipatingMedium& medium) const {
  return of_medium_[static_cast<std::size_t>(&medium - first_medium_)];
}

LightGroupsBuilder::LightGroupsBuilder(const Scene& scene) {
  for_each_group(scene, require_name);
  groups_.names_ = named_light_groups(scene);
}

/// The group of what has none is there from when something needs it.
std::uint32_t LightGroupsBuilder::index_of(const std::string& group) {
  const std::string_view name = group.empty() ? kUngrouped : std::string_view(group);
  auto& names = groups_.names_;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    names.emplace_back(name);
    return static_cast<std::uint32_t>(names.size() - 1);
  }
  return static_cast<std::uint32_t>(found - names.begin());
}

void LightGroupsBuilder::add(LightId first, const std::string& group) {
  const std::uint32_t index = index_of(group);
  auto& runs = groups_.runs_;
  while (!runs.empty() && runs.back().first >= first) runs.pop_back();
  if (runs.empty() || runs.back().group != index) runs.push_back({first, index});
}

LightGroups LightGroupsBuilder::finish(const std::vector<ParticipatingMedium>& built, const std::vector<Medium>& media) {
  groups_.first_medium_ = built.data();
  for (std::size_t i = 0; i < built.size(); ++i)
    groups_.of_medium_.push_back(built[i].emissive() ? index_of(media[i].group) : 0);
  return std::move(groups_);
}

}  // namespace tyndall
