#include "cli/summary.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

namespace tyndall::cli {
namespace {

std::string mebibytes(std::size_t bytes) { return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20)); }

/// Where not all pixels have as many.
std::string range_of_samples(const RenderReport& r) {
  if (r.least_samples == r.most_samples) return {};
  return fmt::format(" in work, {} to {} a pixel", r.least_samples, r.most_samples);
}

/// One sample a pixel tells no error.
std::string estimated_error(const RenderReport& r) {
  if (!std::isfinite(r.estimated_relmse)) return {};
  return fmt::format("  error   estimated relMSE {:.3g}, in the worst part of the picture {:.3g}\n", r.estimated_relmse,
                     r.worst_relmse);
}

std::string bad_samples(const RenderReport& r) {
  std::string text;
  for (const BadSample& b : r.bad_samples) text += fmt::format("  not finite: pixel {},{} sample {}\n", b.x, b.y, b.sample);
  return text;
}

/// Infinity is no number in JSON.
nlohmann::json known(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

/// What the render decided for itself.
std::string measured_budget(const RenderReport& r) {
  std::string text;
  if (r.at_vertices && r.along_segments) {
    text =
        fmt::format("{} lights and {} shadow rays at first vertices, {} and {} along first segments", r.at_vertices->candidates,
                    r.at_vertices->shadow_rays, r.along_segments->candidates, r.along_segments->shadow_rays);
  }
  const auto tell = [&](const std::optional<bool>& is, const char* yes, const char* no) {
    if (is) text += (text.empty() ? "" : "; ") + std::string(*is ? yes : no);
  };
  tell(r.sharing, "pixels share", "pixels share nothing");
  tell(r.collisions_shared, "collisions shared", "collisions not shared");
  tell(r.emission_sought, "emission sought", "emission not sought");
  tell(r.pairs, "lights along segments", "lights at collisions");
  tell(r.guiding, "guided", "not guided");
  return text.empty() ? text : "  budget  " + text + "\n";
}

nlohmann::ordered_json budget_json(const RenderReport& r) {
  const auto asked = [](const AskedLights& a) -> nlohmann::ordered_json {
    return {{"candidates", a.candidates}, {"shadow_rays", a.shadow_rays}};
  };
  nlohmann::ordered_json j;
  if (r.at_vertices) j = {{"at_vertices", asked(*r.at_vertices)}, {"along_segments", asked(*r.along_segments)}};
  const auto tell = [&](const char* name, const std::optional<bool>& is) {
    if (is) j[name] = *is;
  };
  tell("sharing", r.sharing);
  tell("collisions_shared", r.collisions_shared);
  tell("emission_sought", r.emission_sought);
  tell("pairs", r.pairs);
  tell("guiding", r.guiding);
  return j;
}

}  // namespace

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

std::string as_text(const Summary& s) {
  const RenderReport& r = s.render;
  const double rays = static_cast<double>(r.rays + r.shadow_rays);
  std::string text;
  text += fmt::format("{}: {}x{}, {} spp{}{}\n", s.output, s.width, s.height, r.samples, range_of_samples(r),
                      r.stopped ? ", stopped early" : "");
  text += fmt::format(
      "  time    read {:.2f}s, build {:.2f}s (geometry {:.2f}, volumes {:.2f}, lights {:.2f}), render {:.2f}s, write {:.2f}s\n",
      s.read_seconds, s.build_seconds, s.build.geometry_seconds, s.build.volume_seconds, s.build.light_seconds, r.seconds,
      s.write_seconds);
  text += fmt::format("  scene   {} triangles, {} lights, {} media\n", s.build.triangles, s.build.lights, s.build.media);
  text += fmt::format("  work    {} paths, {} rays, {} shadow rays ({:.2f} M rays/s), {} density lookups\n", r.paths, r.rays,
                      r.shadow_rays, rays / std::max(r.seconds, 1e-9) * 1e-6, r.density_lookups);
  text += measured_budget(r);
  text += fmt::format("  memory  peak {}, geometry {}, volumes {}, lights {}\n", mebibytes(peak_memory()),
                      mebibytes(s.build.geometry_bytes), mebibytes(s.build.volume_bytes), mebibytes(s.build.light_bytes));
  text += fmt::format("  health  {} non-finite samples, {} majorant violations, {} caps hit, {} boundary parity errors\n",
                      r.non_finite, r.majorant_violations, r.caps_hit, r.parity_errors);
  text += estimated_error(r);
  if (s.denoised) {
    const bool keeps_noisy = std::string_view(s.output).ends_with(".exr");
    text += fmt::format("  denoise {:.2f}s, estimated relMSE {:.3g} before and {:.3g} after{}\n", s.denoised->seconds,
                        s.denoised->noisy_relmse, s.denoised->relmse, keeps_noisy ? "; as rendered in noisy.R .G .B" : "");
  }
  if (r.unrendered > 0) {
    text += fmt::format("  stopped in the first pass: {} of {} pixels have no sample and are black\n", r.unrendered,
                        std::int64_t{s.width} * s.height);
  }
  return text + bad_samples(r);
}

std::string as_json(const Summary& s) {
  const RenderReport& r = s.render;
  nlohmann::ordered_json j;
  j["version"] = version();
  j["output"] = s.output;
  j["width"] = s.width;
  j["height"] = s.height;
  j["samples"] = r.samples;
  j["least_samples"] = r.least_samples;
  j["most_samples"] = r.most_samples;
  j["stopped"] = r.stopped;
  j["relmse"] = {{"estimated", known(r.estimated_relmse)}, {"worst", known(r.worst_relmse)}};
  j["unrendered"] = r.unrendered;
  j["seconds"] = {{"read", s.read_seconds},
                  {"build", s.build_seconds},
                  {"geometry", s.build.geometry_seconds},
                  {"volumes", s.build.volume_seconds},
                  {"lights", s.build.light_seconds},
                  {"render", r.seconds},
                  {"write", s.write_seconds}};
  j["scene"] = {{"triangles", s.build.triangles}, {"lights", s.build.lights}, {"media", s.build.media}};
  j["paths"] = r.paths;
  j["rays"] = r.rays;
  j["shadow_rays"] = r.shadow_rays;
  j["density_lookups"] = r.density_lookups;
  if (auto budget = budget_json(r); !budget.empty()) j["budget"] = std::move(budget);
  j["memory"] = {{"peak", peak_memory()},
                 {"geometry", s.build.geometry_bytes},
                 {"volumes", s.build.volume_bytes},
                 {"lights", s.build.light_bytes}};
  j["non_finite"] = r.non_finite;
  j["majorant_violations"] = r.majorant_violations;
  j["caps_hit"] = r.caps_hit;
  j["parity_errors"] = r.parity_errors;
  j["bad_samples"] = nlohmann::json::array();
  for (const BadSample& b : r.bad_samples) j["bad_samples"].push_back({{"x", b.x}, {"y", b.y}, {"sample", b.sample}});
  j["notes"] = s.build.notes;
  if (s.denoised) {
    j["denoised"] = {
        {"seconds", s.denoised->seconds}, {"noisy_relmse", s.denoised->noisy_relmse}, {"relmse", s.denoised->relmse}};
  }
  return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace tyndall::cli
