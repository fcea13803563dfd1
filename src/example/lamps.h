/// Very many small lights of log-normal strengths, as triangles or points.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "example/example.h"
#include "example/pbrt_text.h"
#include "math/rng.h"

namespace tyndall {

struct Lamp {
  Vec3 position;
  Vec3 normal{0, -1, 0};  ///< unit; the side to which a triangle emits
  int color = 0;          ///< index into the palette
  float share = 0;        ///< of all lamps' power
};

/// How the lamps of a scene are made up.
struct LampSet {
  std::string name;          ///< of the files: NAME.ply, or NAME_0.ply ... with more colours than one
  std::vector<Rgb> palette;  ///< hues; each is made to have a mean of 1
  float power = 1;           ///< of all lamps together, W, mean of the channels
  float area = 1;            ///< of all triangles together
};

/// A stream of its own for each purpose of a scene.
Rng stream(std::uint64_t seed, std::uint64_t purpose);
float normal_deviate(Rng& rng);  ///< mean 0, variance 1
Vec3 unit_vector(Rng& rng);      ///< uniform on the sphere

/// n positive numbers with logarithms of deviation `sigma`; their sum is 1.
std::vector<float> log_normal_shares(std::size_t n, float sigma, Rng& rng);

/// A saturated colour of the hue circle, `hue` in turns.
Rgb hue_color(float hue);

/// Gives every lamp its share of the power, log-normal.
void share_power(std::vector<Lamp>& lamps, float sigma, Rng& rng);

/// Turn every lamp's back to the viewer. Lights that are seen make noise at their edges that has nothing to do with how
/// lights are chosen, and so much of it that it would drown what these scenes are to show.
void shade_from(Vec3 eye, std::vector<Lamp>& lamps);

/// Equilateral triangles, one a lamp, all of one radiance: a lamp's share of the power is its share of the area, so one
/// polygon file holds all lamps of a colour. Adds the files to `files` and the lines that use them to `text`.
void add_triangle_lamps(std::span<const Lamp> lamps, const LampSet& set, Rng& rng, PbrtText& text,
                        std::vector<ExampleFile>& files);
/// One line of text a lamp.
void add_point_lamps(std::span<const Lamp> lamps, const LampSet& set, PbrtText& text);

/// "AreaLightSource ..." and a black material for what follows.
void add_emission(PbrtText& text, Rgb radiance);

}  // namespace tyndall
