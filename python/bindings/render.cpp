#include "tyndall/render.h"

#include <algorithm>

#include "define.h"
#include "numbers.h"
#include "settings.h"
#include "tyndall/compare.h"
#include "tyndall/memory.h"
#include "watch.h"

namespace tyndall::python {
namespace {

std::function<void()> call(const py::object& progress, const Progress& p) {
  return [&progress, p] {
    progress(python_class("tyndall.render", "Progress")(p.samples_done, p.fraction, p.seconds, p.remaining, p.preparing));
  };
}

py::dict from_report(const RenderReport& r) {
  py::list bad;
  for (const BadSample& b : r.bad_samples) bad.append(py::make_tuple(b.x, b.y, b.sample));
  const auto asked = [](const std::optional<AskedLights>& a) -> py::object {
    if (!a) return py::none();
    return py::make_tuple(a->candidates, a->shadow_rays);
  };
  py::dict work;
  for (const auto& [name, part] : kWorkParts) work[name] = r.work.*part;
  return py::dict("samples"_a = r.samples, "seconds"_a = r.seconds, "stopped"_a = r.stopped, "paths"_a = r.paths,
                  "rays"_a = r.rays, "shadow_rays"_a = r.shadow_rays, "density_lookups"_a = r.density_lookups,
                  "non_finite"_a = r.non_finite, "majorant_violations"_a = r.majorant_violations, "caps_hit"_a = r.caps_hit,
                  "parity_errors"_a = r.parity_errors, "at_vertices"_a = asked(r.at_vertices),
                  "along_segments"_a = asked(r.along_segments), "sharing"_a = r.sharing,
                  "collisions_shared"_a = r.collisions_shared, "emission_sought"_a = r.emission_sought, "pairs"_a = r.pairs,
                  "guiding"_a = r.guiding, "work"_a = work, "bad_samples"_a = bad);
}

/// (image, report)
py::tuple render_world(const World& world, const RenderSettings& settings, const py::object& progress) {
  Watched watched;
  RenderControl control{.stop = &watched.stop};
  if (!progress.is_none()) control.progress = [&](const Progress& p) { watched.tell(call(progress, p)); };
  std::optional<Rendering> rendering;
  run_watched(watched, [&] { rendering = render(world, settings, control); });
  return py::make_tuple(from_image(std::move(rendering->image)), from_report(rendering->report));
}

/// None: what the machine allows.
std::size_t to_memory(py::handle gigabytes) {
  return memory_limit(unless_none(gigabytes, [](py::handle given) { return positive("max_memory", given); }));
}

struct BuildOptions {
  bool sanitize = false;
  std::size_t max_memory;
};

World build_scene(const Scene& scene, const RenderSettings& settings, const BuildOptions& options) {
  const BuildSettings how{.lights = {settings.lights},
                          .volume_lights = settings.emission != EmissionStrategy::paths,
                          .sanitize = options.sanitize,
                          .threads = settings.threads,
                          .max_memory = options.max_memory};
  Watched watched;
  std::optional<World> world;
  run_watched(watched, [&] { world.emplace(build(scene, how)); });
  return std::move(*world);
}

MethodRace to_race(const Scene& scene, const py::dict& methods, const py::dict& plan) {
  const auto seconds = [&](const char* name) {
    return unless_none(plan[name], [&](py::handle value) { return positive(name, value); });
  };
  RenderSettings base = scene.settings;
  base.adaptive = false;  // but for methods that ask for it
  MethodRace race;
  for (const auto& [name, options] : methods)
    race.methods.push_back({to_name(name, "the name of a method"), with_method(base, as<py::dict>(options, "a method"))});
  race.seconds = seconds("time");
  race.samples = unless_none(plan["spp"], [](py::handle value) { return whole("spp", value, 1, kMostSamples); });
  race.seeds = whole("seeds", plan["seeds"], 2, 1000);
  race.seed = seed("seed", plan["seed"]);
  race.reference_relmse = positive("reference_error", plan["reference_error"]);
  race.reference_seconds = seconds("reference_time");
  race.threads = whole("threads", plan["threads"], 0, kMostThreads);
  race.max_memory = to_memory(plan["max_memory"]);
  for (NamedMethod& m : race.methods) m.settings.threads = race.threads;
  if (!plan["reference"].is_none()) race.reference = to_image(plan["reference"]);
  return race;
}

/// (results as JSON, reference, images by method)
py::tuple compare_methods(const Scene& scene, const py::dict& methods, const py::dict& plan, const py::object& progress) {
  const MethodRace race = to_race(scene, methods, plan);
  Watched watched;
  MethodRaceControl control{.stop = &watched.stop};
  if (!progress.is_none()) {
    control.progress = [&](double fraction) { watched.tell([&progress, fraction] { progress(fraction); }); };
  }
  std::optional<MethodRaceResult> result;
  run_watched(watched, [&] { result = race_methods(scene, race, control); });
  py::dict images;
  for (NamedImage& i : result->images) images[from_name(i.name)] = from_image(std::move(i.image));
  return py::make_tuple(result->json, from_image(std::move(result->reference)), images);
}

}  // namespace

void define_render(py::module_& m) {
  py::class_<World>(m, "World")
      .def("render", [](const World& world, const Scene& scene, const py::dict& options,
                        const py::object& progress) { return render_world(world, with_options(scene, options), progress); })
      .def("notes", [](const World& world) {
        py::list notes;
        for (const std::string& note : world.summary().notes) notes.append(from_text(note));
        return notes;
      });
  m.def("build", [](const Scene& scene, const py::dict& options, bool sanitize, py::handle max_memory) {
    return build_scene(scene, with_options(scene, options), {sanitize, to_memory(max_memory)});
  });
  m.def("compare", compare_methods);
  m.def("aov_names", [] {
    py::list names;
    for (const std::string_view name : aov_names()) names.append(py::str(std::string(name)));
    return names;
  });
  m.def("version", [] { return std::string(version()); });
}

}  // namespace tyndall::python
