#include "support/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "support/sanitized.h"
#include "tyndall/io.h"

namespace tyndall::test {
namespace {

constexpr int kFewest = 4;   // renders that an error may rest on
constexpr int kWanted = 12;  // renders that a measurement is cut into

RenderSettings settings_of(const Scene& scene, const Variant& variant) {
  RenderSettings settings = scene.settings;
  settings.lights = variant.lights;
  settings.transmittance = variant.transmittance;
  settings.threads = variant.threads;
  settings.candidates = variant.candidates;
  settings.shadow_rays = variant.shadow_rays;
  settings.splitting = variant.splitting;
  settings.media = variant.media;
  settings.distance = variant.distance;
  settings.emission = variant.emission;
  settings.guiding = variant.guiding;
  settings.joint = variant.joint;
  settings.reuse = variant.reuse;
  settings.budget = variant.budget;
  settings.reproducible = true;
  return settings;
}

BuildSettings build_settings_of(const Variant& variant) {
  BuildSettings settings;
  settings.lights = {variant.lights};
  settings.volume_lights = variant.emission != EmissionStrategy::paths;
  settings.threads = variant.threads;
  return settings;
}

}  // namespace

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC / std::max(1u, std::thread::hardware_concurrency());
}

bool nightly() {
  const char* value = std::getenv("TYNDALL_NIGHTLY");
  return value != nullptr && std::string(value) == "1";
}

std::uint64_t base_seed() {
  const char* value = std::getenv("TYNDALL_SEED");
  return value != nullptr ? std::strtoull(value, nullptr, 10) : 1;
}

int stream_of(const std::string& name) {
  std::uint32_t hash = 2166136261u;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return static_cast<int>(hash % 1'000'000);
}

Subject::Subject(const std::string& text, const Variant& variant, const std::string& folder)
    : Subject(read_scene_text(text, "test.pbrt", folder).scene, variant) {}

Subject::Subject(Scene scene, const Variant& variant)
    : scene_(std::move(scene)), settings_(settings_of(scene_, variant)), world_(build(scene_, build_settings_of(variant))) {}

Image Subject::render(int spp, std::uint64_t seed, const std::vector<std::string>& aovs) {
  RenderSettings settings = settings_;
  settings.spp = spp;
  settings.seed = seed;
  settings.aovs = aovs;
  Rendering rendering = tyndall::render(world_, settings);
  const RenderReport& r = rendering.report;
  total_.rays += r.rays + r.shadow_rays;
  total_.non_finite += r.non_finite;
  total_.majorant_violations += r.majorant_violations;
  total_.caps_hit += r.caps_hit;
  total_.parity_errors += r.parity_errors;
  return std::move(rendering.image);
}

std::string Subject::faults() const {
  // A collision rounded across a boundary that it grazes: 2 in 8.2e6 rays were seen in the worst scene. At 1e-6 a
  // path error of order one changes a mean by 1e-6, a thousandth of what these tests resolve.
  const bool parity_kept = static_cast<double>(total_.parity_errors) <= 1e-6 * static_cast<double>(total_.rays);
  if (total_.non_finite + total_.majorant_violations + total_.caps_hit == 0 && parity_kept) return {};
  return std::to_string(total_.non_finite) + " non-finite samples, " + std::to_string(total_.majorant_violations) +
         " majorant violations, " + std::to_string(total_.caps_hit) + " caps hit and " + std::to_string(total_.parity_errors) +
         " parity errors in " + std::to_string(total_.rays) + " rays";
}

namespace {

/// Of two independent measurements, in the proportion of their samples.
Estimate joined(const Estimate& a, double part_of_a, const Estimate& b) {
  const double u = part_of_a * part_of_a, v = (1 - part_of_a) * (1 - part_of_a);
  Estimate e{part_of_a * a.mean + (1 - part_of_a) * b.mean, u * a.variance + v * b.variance, 0};
  const double fourth = u * u * a.variance * a.variance / a.dof + v * v * b.variance * b.variance / b.dof;
  e.dof = fourth > 0 ? e.variance * e.variance / fourth : a.dof + b.dof;  // Welch and Satterthwaite
  return e;
}

MeanImage joined(const MeanImage& a, double part_of_a, MeanImage b) {
  for (std::size_t k = 0; k < b.channels.size(); ++k) {
    for (std::size_t i = 0; i < b.channels[k].size(); ++i)
      b.channels[k][i] = joined(a.channels[k][i], part_of_a, b.channels[k][i]);
  }
  return b;
}

}  // namespace

Measured measure(Subject& subject, const Goal& goal) {
  const double start = processor_seconds();
  std::uint64_t seed = base_seed() * 10'000'000'000 + std::uint64_t(goal.stream) * 10'000;
  const int first_spp = kSanitized ? std::max(1, goal.first_spp / 8) : goal.first_spp;
  int spp = first_spp;
  MeanImageBuilder builder;
  std::optional<MeanImage> first;  // what the first renders gave, once larger ones have taken over
  const double first_samples = double(first_spp) * kFewest;
  Measured measured;
  for (;;) {
    builder.add(subject.render(spp, seed++));
    measured.seconds = processor_seconds() - start;
    measured.spp = double(spp) * builder.count() + (first ? first_samples : 0);
    measured.renders = builder.count() + (first ? kFewest : 0);
    const bool out_of_budget = measured.seconds > goal.seconds || measured.spp + spp > goal.max_spp;
    if (builder.count() < kFewest && !out_of_budget) continue;

    measured.image = first ? joined(*first, first_samples / measured.spp, builder.result()) : builder.result();
    const double excess = goal.excess(measured.image) / (kCoarser * kCoarser);
    measured.reached = excess <= 1;
    if (measured.reached || out_of_budget) return measured;

    const double needed = builder.count() * std::max(excess, 1.0) / kWanted;  // in units of spp
    const double room = goal.max_spp / double(spp) / kFewest;
    if (!first && builder.count() == kFewest && std::min(needed, room) >= 2) {
      first = std::move(measured.image);
      // A power of two, a factor of 16 at most: the first guess of the excess is a guess.
      spp *= 1 << std::clamp(int(std::lround(std::log2(std::min(needed, room)))), 1, 4);
      builder = {};
    }
  }
}

}  // namespace tyndall::test
