#include "io/pbrt_phase.h"

#include <cmath>

#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

float read_g(ParamList& params) {
  const float g = params.number("g", 0);
  if (!(std::abs(g) < 1)) throw params.error("g", "g must lie between -1 and 1, both excluded");
  return g;
}

Phase draine(ParamList& params) {
  const float g = read_g(params), alpha = params.number("alpha", 1);
  if (!(alpha >= 0 && alpha <= 1000)) throw params.error("alpha", "alpha must lie between 0 and 1000");
  return Draine(g, alpha);
}

Phase mie(ParamList& params) {
  const float diameter = params.number("diameter", 10);
  if (!(diameter >= 0.01f && diameter <= Mie::kLargest))
    throw params.error("diameter", "diameter, of droplets, must lie between 0.01 and 50 micrometers");
  return Mie(diameter);
}

struct NamedPhase {
  std::string_view name;
  Phase (*read)(ParamList& params);
};
constexpr NamedPhase kPhases[] = {
    {"henyey-greenstein", [](ParamList& params) -> Phase { return HenyeyGreenstein{read_g(params)}; }},
    {"rayleigh", [](ParamList&) -> Phase { return Rayleigh{}; }},
    {"draine", draine},
    {"mie", mie},
};

}  // namespace

Phase read_phase(ParamList& params) {
  const std::string name = params.string("phase", "henyey-greenstein");
  std::vector<std::string> known;
  for (const NamedPhase& kind : kPhases) {
    if (kind.name == name) return kind.read(params);
    known.emplace_back(kind.name);
  }
  throw params.error("phase", "phase function \"" + printable(name) + "\" is unknown; " + suggestion(name, known));
}

}  // namespace tyndall::pbrt
