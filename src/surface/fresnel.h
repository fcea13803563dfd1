/// Fresnel reflectance, and the directions of mirrors and refraction.
#pragma once

#include <optional>

#include "tyndall/math.h"

namespace tyndall {

/// Unpolarised reflectance of a dielectric interface: `cos_i` in [0, 1] on the incident side, `eta` = n beyond / n here.
float fresnel_dielectric(float cos_i, float eta);

/// Unpolarised reflectance of a conductor of index eta + i k (relative to the side the light comes from), a channel.
Rgb fresnel_conductor(float cos_i, Rgb eta, Rgb k);

/// Mirror image of `w` about the unit vector `n`; both leave the surface.
constexpr Vec3 reflect(Vec3 w, Vec3 n) { return n * (2 * dot(w, n)) - w; }

/// `w` refracted at a plane with unit normal `n` on w's side (dot(w, n) >= 0), into relative index `eta`.
/// Nothing on total internal reflection.
std::optional<Vec3> refract(Vec3 w, Vec3 n, float eta);

}  // namespace tyndall
