#include "light/instance_runs.h"

#include <algorithm>
#include <map>

namespace tyndall {
namespace {

/// Whether the lights of one instance can stand for those of all.
bool worth_sharing(std::span<const EmitterShape> shapes) {
  std::size_t lights = 0;
  for (const EmitterShape& s : shapes) lights += primitives_of(*s.shape);
  const bool first = shapes.front().shape->emission->power.has_value();
  return lights >= kFewestShared && std::all_of(shapes.begin(), shapes.end(), [first](const EmitterShape& s) {
           return s.shape->emission->power.has_value() == first;
         });
}

}  // namespace

std::vector<InstanceRun> shared_runs(std::span<const EmitterShape> shapes) {
  std::vector<InstanceRun> runs;
  std::map<ObjectId, std::size_t> uses;
  for (std::size_t begin = 0, end = 0; begin < shapes.size(); begin = end) {
    const Instance* instance = shapes[begin].instance;
    end = begin + 1;
    if (!instance) continue;
    while (end < shapes.size() && shapes[end].instance == instance) ++end;
    const auto to_world = Similarity::of(instance->to_world);
    if (!to_world || !worth_sharing(shapes.subspan(begin, end - begin))) continue;
    runs.push_back({begin, end, *to_world});
    ++uses[instance->object];
  }
  std::erase_if(runs, [&](const InstanceRun& run) { return uses[shapes[run.begin].instance->object] < 2; });
  return runs;
}

}  // namespace tyndall
