#include "transport/camera/lens_system.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace tyndall {
namespace {

/// Index of a glass as lens files have it: they write 0 for air beside the stop.
double index_of(float eta) { return eta == 0 ? 1 : eta; }

/// Where a ray that came in parallel to the axis crosses it, and where it seems to have been bent.
struct CardinalPoints {
  double focus, principal;  ///< z
};
CardinalPoints cardinal_points(const LensRay& in, const LensRay& out) {
  const double slope = out.d.z / out.d.x;
  return {out.o.z - out.o.x * slope, out.o.z + (in.o.x - out.o.x) * slope};
}

void require_usable(const Lenses& lenses) {
  if (lenses.elements.empty()) throw Error(lenses.where, "a realistic camera has no lenses; name a lens file that has some");
  for (const LensElement& e : lenses.elements) {
    if (!(e.aperture_radius > 0)) throw Error(lenses.where, "a lens lets nothing pass; its diameter must be above 0");
    if (!(index_of(e.eta) >= 1)) throw Error(lenses.where, "an index of refraction is below 1; correct the lens file");
  }
  if (!(lenses.film_diagonal > 0 && lenses.focus_distance > 0))
    throw Error(lenses.where, "the film's diagonal and the distance of focus must be above 0; correct them");
}

}  // namespace

LensSystem::LensSystem(const Lenses& lenses) : stop_(lenses.stop), film_radius_(lenses.film_diagonal / 2) {
  require_usable(lenses);
  place_surfaces(lenses.elements);
  focus(lenses);
  const double rear = 1.5 * surfaces_.back().aperture_radius;
  Pupil pupil = pupil_within({-rear, rear, rear}, 1024, 0, film_radius_ / kPupils);
  if (pupil.is_empty())
    throw Error(lenses.where,
                "no light comes through the lenses to the middle of the film; correct the lens file, or open aperturediameter");
  for (int i = 0; i < kPupils; ++i) {
    const double film0 = film_radius_ * i / kPupils, film1 = film_radius_ * (i + 1) / kPupils;
    pupil = exit_pupil(film0, film1, pupil);
    pupils_[i] = pupil;
  }
}

void LensSystem::place_surfaces(const std::vector<LensElement>& elements) {
  surfaces_.resize(elements.size());
  double z = 0;
  for (std::size_t i = elements.size(); i-- > 0;) {
    const LensElement& element = elements[i];
    z += element.thickness;
    surfaces_[i] = {z, element.radius, i > 0 ? index_of(elements[i - 1].eta) : 1.0, index_of(element.eta),
                    element.aperture_radius};
  }
}

/// Moves the film so that 1/s + 1/s' = 1/f, s and s' being the distances of what is in focus and of the film from their
/// principal planes. Their sum L does not change with that: s' = (L - sqrt(L (L - 4 f))) / 2, or 2 L f / (L + sqrt(...)).
void LensSystem::focus(const Lenses& lenses) {
  double height = 1e-3 * lenses.film_diagonal;
  for (const Surface& s : surfaces_) height = std::min(height, 0.1 * s.aperture_radius);
  const LensRay from_scene{{height, 0, front_z() + 1}, {0, 0, -1}}, from_film{{height, 0, rear_z() - 1}, {0, 0, 1}};
  const auto on_film = to_film(from_scene);
  const auto in_scene = to_scene(from_film);
  if (!on_film || !in_scene || on_film->d.x == 0 || in_scene->ray.d.x == 0)
    throw Error(lenses.where, "the lenses bring no light to a focus; correct the lens file");
  const CardinalPoints behind = cardinal_points(from_scene, *on_film), before = cardinal_points(from_film, in_scene->ray);
  const double f = behind.principal - behind.focus, sum = lenses.focus_distance - before.principal + behind.principal;
  if (!(f > 0)) throw Error(lenses.where, "the lenses spread light instead of gathering it; correct the lens file");
  if (!(sum > 4 * f))
    throw Error(lenses.where, "focusdistance is too short for the lenses, whose focal length is " + std::to_string(f * 1000) +
                                  " mm; give more than " + std::to_string(4 * f + before.principal - behind.principal));
  image_distance_ = 2 * sum * f / (sum + std::sqrt(sum * (sum - 4 * f)));
  const double shift = image_distance_ - behind.principal;
  for (Surface& s : surfaces_) s.z += shift;
  if (!(rear_z() > 0)) throw Error(lenses.where, "focused, the last lens would stand behind the film; correct the lens file");
}

/// Snell's law at a sphere about the axis, or the aperture in a plane.
std::optional<LensRay> LensSystem::through(const Surface& s, LensRay ray) {
  const Vec3d center{0, 0, s.z - s.radius};
  double t = (s.z - ray.o.z) / ray.d.z;
  if (!s.is_stop()) {
    const Vec3d from = ray.o - center;
    const double b = dot(from, ray.d), q = b * b - dot(from, from) + s.radius * s.radius;
    if (!(q >= 0)) return std::nullopt;
    const bool is_far = (ray.d.z > 0) == (s.radius > 0);  // the surface is the half of the sphere that meets the axis at s.z
    t = -b + (is_far ? std::sqrt(q) : -std::sqrt(q));
  }
  if (!(t >= 0)) return std::nullopt;
  const Vec3d p = ray.o + ray.d * t;
  if (!(p.x * p.x + p.y * p.y <= s.aperture_radius * s.aperture_radius)) return std::nullopt;
  if (s.is_stop()) return LensRay{p, ray.d};
  Vec3d n = (p - center) / s.radius;
  if (dot(n, ray.d) > 0) n = -n;
  const double eta = ray.d.z > 0 ? s.eta_behind / s.eta_front : s.eta_front / s.eta_behind;
  const double cos_in = -dot(n, ray.d), sin2_out = eta * eta * (1 - cos_in * cos_in);
  if (!(sin2_out < 1)) return std::nullopt;
  const Vec3d d = normalize(ray.d * eta + n * (eta * cos_in - std::sqrt(1 - sin2_out)));
  if (!(d.z * ray.d.z > 0)) return std::nullopt;
  return LensRay{p, d};
}

std::optional<LensSystem::Sample> LensSystem::to_scene(LensRay ray) const {
  double transmission = 1;
  for (std::size_t i = surfaces_.size(); i-- > 0;) {
    const Surface& s = surfaces_[i];
    const auto next = through(s, ray);
    if (!next) return std::nullopt;
    ray = *next;
    if (s.is_stop()) transmission *= stop_transmission(stop_, ray.o.x / s.aperture_radius, ray.o.y / s.aperture_radius);
  }
  return Sample{ray, transmission};
}

std::optional<LensRay> LensSystem::to_film(LensRay ray) const {
  for (const Surface& s : surfaces_) {
    const auto next = through(s, ray);
    if (!next) return std::nullopt;
    ray = *next;
  }
  return ray;
}

/// What of `region` is met by light that reaches the film from film0 to film1 on the +x axis, to within two cells outward. The
/// stop counts as a circle: all its shapes lie within, and only a circle may turn about the axis.
LensSystem::Pupil LensSystem::pupil_within(Pupil region, int cells, double film0, double film1) const {
  const double step_x = (region.x1 - region.x0) / cells, step_y = 2 * region.y1 / cells;
  Pupil found{kInfinity, -kInfinity, -kInfinity};
  for (const double x_film : {film0, (film0 + film1) / 2, film1}) {
    for (int iy = 0; 2 * iy < cells; ++iy) {
      for (int ix = 0; ix < cells; ++ix) {
        const Vec3d at{region.x0 + (ix + 0.5) * step_x, iy * step_y, rear_z()}, from{x_film, 0, 0};
        LensRay ray{from, normalize(at - from)};
        bool passes = true;
        for (std::size_t i = surfaces_.size(); passes && i-- > 0;) {
          const auto next = through(surfaces_[i], ray);
          passes = next.has_value();
          if (passes) ray = *next;
        }
        if (passes) found = {std::min(found.x0, at.x), std::max(found.x1, at.x), std::max(found.y1, at.y)};
      }
    }
  }
  if (!(found.y1 >= 0)) return {};
  return {found.x0 - 2 * step_x, found.x1 + 2 * step_x, found.y1 + 2 * step_y};
}

/// From coarse to fine: first where the neighbour's pupil is, then everywhere.
LensSystem::Pupil LensSystem::exit_pupil(double film0, double film1, const Pupil& neighbour) const {
  const double rear = 1.5 * surfaces_.back().aperture_radius;
  Pupil found;
  if (!neighbour.is_empty()) {
    const double grow = (neighbour.x1 - neighbour.x0) / 2;
    found = pupil_within({neighbour.x0 - grow, neighbour.x1 + grow, 1.5 * neighbour.y1}, 64, film0, film1);
  }
  if (found.is_empty()) found = pupil_within({-rear, rear, rear}, 256, film0, film1);
  return found.is_empty() ? found : pupil_within(found, 64, film0, film1);
}

/// Irradiance: integral of L cos^4 / z^2 over the pupil's area [Kolb et al. 1995], estimated with one point of its bounds.
std::optional<LensSystem::Sample> LensSystem::sample(Vec2 film, Vec2 pupil) const {
  const double r = std::hypot(film.x, film.y);
  const Pupil& bounds = pupils_[std::clamp(static_cast<int>(r / film_radius_ * kPupils), 0, kPupils - 1)];
  if (bounds.is_empty()) return std::nullopt;
  const double x = std::lerp(bounds.x0, bounds.x1, pupil.x), y = bounds.y1 * (2.0 * pupil.y - 1);
  const double sine = r > 0 ? film.y / r : 0, cosine = r > 0 ? film.x / r : 1;
  const Vec3d from{film.x, film.y, 0}, at{cosine * x - sine * y, sine * x + cosine * y, rear_z()};
  const LensRay ray{from, normalize(at - from)};
  auto result = to_scene(ray);
  if (!result || result->weight == 0) return std::nullopt;
  result->weight *= std::pow(ray.d.z, 4) * bounds.area() / (rear_z() * rear_z());
  return result;
}

}  // namespace tyndall
