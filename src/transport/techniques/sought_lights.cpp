#include "transport/techniques/sought_lights.h"

#include "transport/techniques/mis.h"

namespace tyndall {

float SoughtLights::scattering_mis_weight(const LightContext& context, float pdf, LightId id, float light_pdf) const {
  if (light_pdf == 0) return 1;
  if (collision) {
    const SpanDensities others = span_densities(context, *collision, id);
    return mis_weight(collision->density * pdf, others.pair * light_pdf, others.tracked * light_pdf);
  }
  return mis_weight(pdf, search.among->n_pmf(search.cut, search.query, id) * light_pdf);
}

}  // namespace tyndall
