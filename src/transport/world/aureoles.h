/// Where collisions guide paths: toward the light that media have spread around suns.
#pragma once

#include <vector>

#include "light/lights.h"
#include "transport/vertex/vertex.h"
#include "transport/world/near_fluence.h"
#include "volume/aureole.h"

namespace tyndall {

struct LightContext;

/// What of a scene's lights does so.
class Aureoles {
 public:
  Aureoles() = default;
  explicit Aureoles(const Lights& lights);

  bool empty() const { return suns_.empty(); }
  /// At a collision, for the path's next direction; nothing where there is nothing to guide by. Deterministic.
  std::optional<Aureole> at(const LightContext& context, const Vertex& vertex) const;

 private:
  std::vector<FarCone> suns_;
  float rest_ = 0;  ///< fluence of the other lights at infinity
  NearFluence near_;
};

}  // namespace tyndall
