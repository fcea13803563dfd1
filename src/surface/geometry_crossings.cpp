#include "surface/geometry_impl.h"

namespace tyndall {
namespace {

using Record = BoundaryRecord;

/// How far apart in t two shapes may report one and the same boundary: a few roundings of a position, over the slope.
double slack(const Record& record, const Ray& ray) {
  const Vec3d o(ray.o), d(ray.d);
  const double position = max_component(abs(o) + abs(d) * record.t);
  return 0x1p-22 * position / (length(d) * std::max(record.cosine, 1e-2));
}

bool same_primitive(const Record& a, const Record& b) {
  return a.shape == b.shape && a.primitive == b.primitive && a.sign == b.sign && a.t == b.t;
}

/// Net crossings of records of one group at one t. Within a shape signs add up exactly; shapes that say the same
/// (copies, or neighbours that meet at an edge) count once; what enters and leaves cancels.
int net_crossings(const Record* begin, const Record* end) {
  int entered = 0, left = 0;
  for (const Record* r = begin; r != end; ++r) {
    const bool first_of_shape = std::none_of(begin, r, [&](const Record& q) { return q.shape == r->shape; });
    if (!first_of_shape) continue;
    int net = 0;
    for (const Record* q = r; q != end; ++q) {
      const bool repeated = std::any_of(begin, q, [&](const Record& earlier) { return same_primitive(earlier, *q); });
      if (q->shape == r->shape && !repeated) net += q->sign;
    }
    entered = std::max(entered, net);
    left = std::max(left, -net);
  }
  return entered - left;
}

}  // namespace

Crossings crossings_of(BoundaryRecords& records, const Ray& ray) {
  if (records.size() == 1) {  // most rays leave what they are in
    Crossings crossing;
    crossing.push_back({static_cast<float>(records[0].t), records[0].group, records[0].sign});
    return crossing;
  }
  const auto order = [](const Record& a, const Record& b) {
    return std::tie(a.group, a.t, a.shape, a.primitive, a.sign) < std::tie(b.group, b.t, b.shape, b.primitive, b.sign);
  };
  std::sort(records.begin(), records.end(), order);
  Crossings crossings;
  for (const Record* r = records.begin(); r != records.end();) {
    const double reach = r->t + slack(*r, ray);
    const Record* next = r + 1;
    while (next != records.end() && next->group == r->group && next->t <= reach) ++next;
    const int net = net_crossings(r, next);
    for (int i = 0; i < std::abs(net); ++i) crossings.push_back({static_cast<float>(r->t), r->group, net > 0 ? 1 : -1});
    r = next;
  }
  const auto earlier = [](const Crossing& a, const Crossing& b) { return a.t < b.t; };
  if (!std::is_sorted(crossings.begin(), crossings.end(), earlier)) {  // a group's own order stays as it is at equal t
    std::stable_sort(crossings.begin(), crossings.end(), earlier);
  }
  return crossings;
}

}  // namespace tyndall
