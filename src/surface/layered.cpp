#include "surface/layered.h"

#include <bit>

#include "math/hash.h"
#include "math/rng.h"
#include "surface/albedo.h"
#include "surface/fresnel.h"
#include "surface/layered_walk.h"

namespace tyndall {

namespace {

using Event = LayerWalk::Event;

std::uint64_t bits(Vec3 v) {
  return hash(std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y), std::bit_cast<std::uint32_t>(v.z));
}

/// MIS weight of a technique of density `a` against one of density `b`, squared [Veach 1997].
float power_heuristic(float a, float b) {
  if (a <= 0) return 0;
  const float ratio = b / a;
  return 1 / (1 + ratio * ratio);
}

template <typename Lobe, typename... Mode>
std::optional<BsdfSample> sample_with(const Lobe& lobe, Vec3 wo, Rng& rng, Mode... mode) {
  const float uc = rng.uniform(), u = rng.uniform(), v = rng.uniform();
  return lobe.sample(wo, uc, {u, v}, mode...);
}

/// One walk's estimate of the light that enters along wi and leaves along wo after at least one bounce inside. Both directions
/// are above the surface. The last step out is sampled by two techniques: along `out`, drawn backwards from wi, and by chance,
/// through top.eval(); where both are possible, MIS weights them by the power heuristic.
///
/// pbrt-v4 weights the second technique with the density of wi given w instead of that of w given wi. Its two weights then sum
/// to more than one, and its f() under a rough top is too bright for its own Sample_f() (docs/measurements.md). Ours sum to
/// one, and eval() and sample() agree.
template <typename Bottom>
class EvalWalk {
 public:
  EvalWalk(const LayeredLobe<Bottom>& lobe, Vec3 wo, Vec3 wi, Rng& rng)
      : lobe_(lobe), wi_(wi), walk_{lobe.coat, rng, lobe.top.eta, {}, Rgb(1.0f), lobe.coat.thickness} {
    const auto in = sample_with(lobe.top, wo, rng, kTransmitted);
    out_ = sample_with(lobe.top, wi, rng, kTransmittedImportance);
    if (!in || !out_ || out_->wi.z == 0) return;
    walk_.follow(*in);
    out_weight_ = out_->weight * std::abs(wi.z / out_->wi.z);
    alive_ = true;
  }

  Rgb run() {
    for (int bounce = 0; alive_ && bounce < lobe_.coat.max_depth; ++bounce) {
      if (walk_.survive(bounce) == 0 || walk_.w.z == 0) break;
      switch (walk_.advance()) {
        case Event::scattering:
          at_scattering();
          break;
        case Event::bottom:
          at_bottom();
          break;
        case Event::top:
          leave_by(sample_with(lobe_.top, -walk_.w, walk_.rng, kReflected));
          break;
      }
    }
    return sum_;
  }

 private:
  void at_scattering() {
    const float toward = walk_.phase(-out_->wi);
    const float weight = lobe_.top.has_smooth() ? power_heuristic(out_->pdf, toward) : 1.0f;
    sum_ += walk_.beta * lobe_.coat.albedo * out_weight_ * (toward * weight * transmittance_to_top(out_->wi));
    const float pdf = walk_.scatter();
    if (walk_.w.z > 0) exit_by_chance(pdf);
  }

  void at_bottom() {
    const Vec3 from = -walk_.w;
    const bool smooth = lobe_.bottom.has_smooth();
    if (smooth) {
      const Vec3 toward = -out_->wi;
      const float weight = lobe_.top.has_smooth() ? power_heuristic(out_->pdf, lobe_.bottom.pdf(from, toward)) : 1.0f;
      sum_ += walk_.beta * lobe_.bottom.eval(from, toward) * out_weight_ * (weight * transmittance_to_top(toward));
    }
    const auto next = sample_with(lobe_.bottom, from, walk_.rng);
    leave_by(next);
    if (next) exit_by_chance(smooth ? next->pdf : kInfinity);
  }

  /// The walk's own direction, drawn with density `pdf` (infinite: no other technique finds it), goes straight out.
  void exit_by_chance(float pdf) {
    if (!lobe_.top.has_smooth()) return;
    const Rgb f = lobe_.top.eval(-walk_.w, wi_);
    if (is_black(f)) return;
    const float weight = std::isinf(pdf) ? 1.0f : power_heuristic(pdf, lobe_.top.pdf(wi_, -walk_.w, kTransmittedImportance));
    sum_ += walk_.beta * f * (weight * transmittance_to_top(walk_.w));
  }

  void leave_by(const std::optional<BsdfSample>& s) {
    if (s) walk_.follow(*s);
    alive_ = s.has_value();
  }

  float transmittance_to_top(Vec3 w) const { return LayerWalk::transmittance(lobe_.coat.thickness - walk_.z, w); }

  const LayeredLobe<Bottom>& lobe_;
  Vec3 wi_;
  LayerWalk walk_;
  std::optional<BsdfSample> out_;  ///< wi refracted into the coat; out_->wi points down, against the light leaving
  Rgb out_weight_, sum_;           ///< out_weight_: |cos wi| f / pdf of `out_`, without the cosine inside
  bool alive_ = false;
};

/// The bottom as seen through the coat: directions refracted at the mean plane, a metal's lobe widened by the two refractions
/// through a rough top. Each bends a ray by (eta - 1)/eta of the facet's slope; a half vector halves that.
float seen_through(const DielectricLobe& top, const ConductorLobe& bottom, Vec3 wo, Vec3 wi) {
  const auto o = refract(wo, {0, 0, 1}, top.eta), i = refract(wi, {0, 0, 1}, top.eta);
  if (!o || !i) return 0;
  const float bend = (top.eta - 1) / top.eta, share = 0.5f * bend * bend;
  const auto widened = [share](float a, float b) { return std::sqrt(a * a + share * b * b); };
  const ConductorLobe wide{
      .ggx = Ggx(widened(bottom.ggx.alpha_x(), top.ggx.alpha_x()), widened(bottom.ggx.alpha_y(), top.ggx.alpha_y())),
      .eta = {},
      .k = {}};
  return wide.pdf(-*o, -*i) * wi.z / (top.eta * top.eta * -i->z);
}

float seen_through(const DielectricLobe&, const DiffuseLobe&, Vec3, Vec3 wi) { return wi.z * kInvPi; }

}  // namespace

template <typename Bottom>
Rgb LayeredLobe<Bottom>::eval(Vec3 wo, Vec3 wi) const {
  if (!same_side(wo, wi) || !has_smooth()) return {};
  if (wo.z < 0) return eval(-wo, -wi);
  Rng rng(hash(coat.seed, bits(wo), bits(wi)));
  Rgb sum;
  for (int i = 0; i < coat.samples; ++i) sum += EvalWalk<Bottom>(*this, wo, wi, rng).run();
  return top.eval(wo, wi) + sum / float(coat.samples);
}

template <typename Bottom>
float LayeredLobe<Bottom>::pdf(Vec3 wo, Vec3 wi) const {
  if (!same_side(wo, wi) || !has_smooth()) return 0;
  if (wo.z < 0) return pdf(-wo, -wi);
  // Reflection off the top, then a single bounce off the bottom, then a cosine lobe for everything else.
  const float inside = 1 - fresnel_dielectric(wo.z, top.eta);
  const float once = seen_through(top, bottom, wo, wi);
  return top.pdf(wo, wi) + inside * (0.9f * once + 0.1f * wi.z * kInvPi);
}

template <typename Bottom>
std::optional<BsdfSample> LayeredLobe<Bottom>::sample(Vec3 wo, float uc, Vec2 u) const {
  if (wo.z < 0) {
    auto s = sample(-wo, uc, u);
    if (s) s->wi = -s->wi;
    return s;
  }
  auto s = top.sample(wo, uc, u);
  if (!s) return std::nullopt;
  bool specular = s->specular;
  float probability = s->pdf;  // of a path of specular bounces alone

  if (s->transmission) {
    Rng rng(hash(coat.seed, bits(wo), bits({uc, u.x, u.y}), 1));
    LayerWalk walk{coat, rng, top.eta, s->wi, s->weight, coat.thickness};
    // One more step than eval(): the last may only leave. (pbrt-v4 stops one bounce earlier here than in f().)
    for (int bounce = 0;; ++bounce) {
      const float survival = walk.survive(bounce);
      if (bounce > coat.max_depth || survival == 0 || walk.w.z == 0) return std::nullopt;
      const Event what = walk.advance();
      if (what == Event::scattering) {
        walk.scatter();
        specular = false;
        continue;
      }
      s = what == Event::top ? sample_with(top, -walk.w, rng) : sample_with(bottom, -walk.w, rng);
      if (!s) return std::nullopt;
      walk.follow(*s);
      specular = specular && s->specular;
      probability *= s->pdf * survival;
      if (s->transmission) break;
    }
    s->weight = walk.beta;
  }
  return BsdfSample{.wi = s->wi,
                    .weight = s->weight,
                    .pdf = specular ? probability : pdf(wo, s->wi),
                    .specular = specular,
                    .transmission = false};
}

template <typename Bottom>
float LayeredLobe<Bottom>::mirrored(Vec3 wo) const {
  return top.is_specular() && bottom.has_smooth() ? fresnel_dielectric(std::abs(wo.z), top.eta) : 0.0f;
}

template <typename Bottom>
Rgb LayeredLobe<Bottom>::albedo(Vec3 wo) const {
  return sampled_albedo(*this, wo);
}

template struct LayeredLobe<DiffuseLobe>;
template struct LayeredLobe<ConductorLobe>;

}  // namespace tyndall
