/// Numeric kernels of src/surface against their promises, at their worst.
#include "support/adversarial.h"
#include "surface/fresnel.h"
#include "surface/microfacet.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// With widths from all but a mirror to beyond what materials make of a roughness of 1.
Ggx facets(Adversary& any) {
  const float x = any.between(1e-3f, 1);
  return {x, any.chance() ? x : any.between(1e-3f, 1)};
}

bool is_share(float x) { return x >= 0 && x <= 1 + 1e-5f; }

}  // namespace

TEST_CASE("kernels: Fresnel") {
  check_kernel("dielectric", [](Adversary& any) {
    const float cosine = any.between(0, 1), eta = any.positive(10), r = fresnel_dielectric(cosine, eta);
    return holds(is_share(r), cosine, eta, r);
  });
  check_kernel("conductor", [](Adversary& any) {
    const float cosine = any.between(0, 1);
    const Rgb eta(any.positive(10)), k(any.chance() ? any.positive(10) : 0);
    const Rgb r = fresnel_conductor(cosine, eta, k);
    return holds(is_share(r.r), cosine, eta.r, k.r, r.r);
  });
  check_kernel("refraction", [](Adversary& any) {
    const Vec3 n = any.direction();
    Vec3 w = any.direction();
    if (dot(w, n) < 0) w = -w;
    const float eta = any.positive(6);
    const auto t = refract(w, n, eta);
    const Vec3 tangential = w - n * dot(w, n);
    if (!t) return holds(length(tangential) > eta * (1 - 1e-4f), w, n, eta);
    // Snell: what lies in the plane shrinks by eta, and the ray goes on to the other side.
    const Vec3 expected = tangential * (-1 / eta), kept = *t - n * dot(*t, n);
    return holds(std::abs(length(*t) - 1) < 1e-4f && dot(*t, n) <= 1e-4f && length(kept - expected) < 1e-3f, w, n, eta, *t);
  });
}

TEST_CASE("kernels: microfacets") {
  check_kernel("visible normals", [](Adversary& any) {
    const Ggx ggx = facets(any);
    const Vec3 w = any.upper_direction(), m = ggx.sample_visible(w, any.square());
    const float pdf = ggx.visible_pdf(w, m);
    const bool sound = std::abs(length(m) - 1) < 1e-4f && m.z >= 0 && dot(m, w) >= -1e-4f;
    return holds(sound && std::isfinite(pdf) && pdf >= 0, ggx.alpha_x(), ggx.alpha_y(), w, m, pdf);
  });
  check_kernel("shadowing", [](Adversary& any) {
    const Ggx ggx = facets(any);
    const Vec3 wo = any.upper_direction(), wi = any.upper_direction();
    const float g = ggx.shadowing(wo, wi), over_cosine = ggx.G_over_cosine(wo, wi);
    return holds(is_share(g) && std::isfinite(over_cosine) && over_cosine >= 0, ggx.alpha_x(), ggx.alpha_y(), wo, wi, g,
                 over_cosine);
  });
  check_kernel("density of normals", [](Adversary& any) {
    const Ggx ggx = facets(any);
    const Vec3 wo = any.upper_direction(), m = any.upper_direction();
    const float d = ggx.D(m), pdf = dot(wo, m) > 0 ? ggx.reflected_pdf(wo, m) : 0.0f;
    return holds(std::isfinite(d) && d >= 0 && std::isfinite(pdf) && pdf >= 0, ggx.alpha_x(), ggx.alpha_y(), wo, m, d, pdf);
  });
}
