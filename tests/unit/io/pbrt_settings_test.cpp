#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::error_of;

namespace {

RenderSettings settings(const std::string& directives) { return test::read(directives + " WorldBegin").settings; }

}  // namespace

TEST_CASE("Sampler gives samples and seed") {
  CHECK(settings("Sampler \"zsobol\" \"integer pixelsamples\" 128 \"integer seed\" 7").spp == 128);
  CHECK(settings("Sampler \"zsobol\" \"integer pixelsamples\" 128 \"integer seed\" 7").seed == 7);
  CHECK(settings("Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5 \"bool jitter\" true").spp == 15);
  CHECK(settings("Sampler \"independent\"").spp == 4);
  CHECK(settings("Sampler \"halton\" \"string randomization\" \"none\"").spp == 16);
  CHECK_CONTAINS(error_of("Sampler \"sobul\""), "did you mean \"sobol\" or");
  CHECK_CONTAINS(error_of("Sampler \"sobol\" \"integer pixelsamples\" 0"), "at least 1");
}

TEST_CASE("Integrator gives depth and light sampler") {
  CHECK(settings("Integrator \"volpath\" \"integer maxdepth\" 30").max_depth == 30);
  CHECK(settings("Integrator \"path\"").max_depth == 5);
  CHECK(settings("Integrator \"volpath\" \"string lightsampler\" \"power\"").lights == LightStrategy::power);
  CHECK(settings("Integrator \"volpath\" \"string lightsampler\" \"uniform\"").lights == LightStrategy::uniform);
  CHECK(settings("Integrator \"volpath\" \"string lightsampler\" \"exhaustive\"").lights == LightStrategy::exhaustive);
  CHECK(settings("Integrator \"volpath\" \"string lightsampler\" \"bvh\"").lights == LightStrategy::tree);
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"string lightsampler\" \"bvx\""), "did you mean \"bvh\"?");
  CHECK_CONTAINS(error_of("Integrator \"volpaht\""), "did you mean \"volpath\"");
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"integer maxdepth\" -1"), "at least 0");
  CHECK(settings("Integrator \"volpath\" \"integer maxdepth\" 2147483647").max_depth == 1 << 20);
}

TEST_CASE("media that pbrt's path integrator passes over are rendered, and that is said") {
  const auto warnings = [](const std::string& integrator, const std::string& world) {
    return read_scene_text("Integrator \"" + integrator + "\" WorldBegin " + world, "test.pbrt").warnings.size();
  };
  const std::string medium = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"";
  CHECK(warnings("path", medium) == 1);
  CHECK(warnings("path", "") == 0);
  CHECK(warnings("volpath", medium) == 0);
}

TEST_CASE("Tyndall's own options stand on the Integrator line") {
  const RenderSettings s =
      settings(R"(Integrator "volpath" "string lights" "uniform" "string transmittance" "ratio" "integer spp" 9
    "integer seed" 5 "float time" 2.5 "integer threads" 2 "string aov" ["Albedo" "N"] "bool reproducible" true "integer crop" [1 2 3 4]
    "integer max-depth" 12)");
  CHECK(s.lights == LightStrategy::uniform);
  CHECK(s.transmittance == TransmittanceStrategy::ratio);
  CHECK(s.spp == 9);
  CHECK(s.seed == 5);
  CHECK(*s.time == 2.5);
  CHECK(s.threads == 2);
  CHECK(s.aovs == std::vector<std::string>{"Albedo", "N"});
  CHECK(s.reproducible);
  CHECK(*s.crop == PixelBounds{1, 3, 2, 4});
  CHECK(s.max_depth == 12);
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"string lights\" \"tree-binari\""), "did you mean \"tree-binary\"?");
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"string aov\" \"Albdo\""), "did you mean \"Albedo\"?");
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"float time\" 0"), "above 0 seconds");
}

TEST_CASE("a crop on the Integrator line is cut to the frame with a warning, and refused where nothing is left") {
  const std::string film = " Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 20";
  CHECK(*settings("Integrator \"volpath\" \"integer crop\" [-5 100 3 99]" + film).crop == PixelBounds{0, 3, 40, 20});
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"integer crop\" [100 200 0 10]" + film + " WorldBegin"),
                 "crop leaves no pixel");
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"integer crop\" [5 5 0 10]" + film + " WorldBegin"), "crop leaves no pixel");
}

TEST_CASE("a limit of time or error alone leaves the samples open") {
  CHECK(settings("Integrator \"volpath\" \"float time\" 3").spp == std::numeric_limits<int>::max());
  CHECK(settings("Integrator \"volpath\" \"float error\" 0.01 Sampler \"sobol\"").spp == std::numeric_limits<int>::max());
  CHECK(settings("Integrator \"volpath\" \"float error\" 0.01 Sampler \"sobol\" \"integer pixelsamples\" 9").spp == 9);
  CHECK(settings("Integrator \"volpath\" \"float time\" 3 \"integer spp\" 7").spp == 7);
  CHECK(*settings("Integrator \"volpath\" \"float error\" 0.01").error == doctest::Approx(0.01));
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"float error\" 0"), "above 0");
}

TEST_CASE("candidates, splitting and shadow rays") {
  const RenderSettings s =
      settings("Integrator \"volpath\" \"integer candidates\" 8 \"float splitting\" 0.5 \"integer shadow-rays\" 2");
  CHECK(s.candidates == 8);
  CHECK(s.splitting == 0.5f);
  CHECK(s.shadow_rays == 2);
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"float splitting\" 1.5"), "from 0 to 1");
  CHECK_CONTAINS(error_of("Integrator \"volpath\" \"integer candidates\" -1"), "at least 0");
  for (const char* name : {"candidates", "shadow-rays", "threads"}) {
    const std::string count = std::string("Integrator \"volpath\" \"integer ") + name + "\" ";
    CHECK_CONTAINS(error_of(count + "4097"), "at most 4096");
    CHECK_NOTHROW(settings(count + "4096"));
  }
}

TEST_CASE("spp and seed of the Integrator win over the Sampler's, in either order") {
  CHECK(settings("Sampler \"sobol\" \"integer pixelsamples\" 64 Integrator \"volpath\" \"integer spp\" 9").spp == 9);
  CHECK(settings("Integrator \"volpath\" \"integer spp\" 9 \"integer seed\" 3 Sampler \"sobol\" \"integer pixelsamples\" 64")
            .spp == 9);
  CHECK(settings("Integrator \"volpath\" \"integer seed\" 3 Sampler \"sobol\" \"integer seed\" 4").seed == 3);
}

TEST_CASE("what is known and not honoured is a warning") {
  const auto warnings = [](const std::string& text) {
    return read_scene_text(text + " WorldBegin", "test.pbrt").warnings.size();
  };
  CHECK(warnings("Integrator \"bdpt\" \"bool visualizestrategies\" false") == 1);
  CHECK(warnings("Integrator \"volpath\" \"bool regularize\" true") == 1);
  CHECK(warnings("Integrator \"volpath\" \"integer maxdepth\" 2147483647") == 1);
  CHECK(warnings("Integrator \"volpath\" \"bool regularize\" false") == 0);
  CHECK(warnings("Option \"disablepixeljitter\" true") == 1);
  CHECK(warnings("Option \"disablepixeljitter\" false Option \"wavefront\" true") == 0);
  CHECK(warnings("Accelerator \"kdtree\" \"integer maxdepth\" 3") == 0);
}

TEST_CASE("Option") {
  CHECK(settings("Option \"seed\" 42").seed == 42);
  CHECK(settings("Option \"string render-coord-sys\" \"world\"").seed == 0);
  CHECK_CONTAINS(error_of("Option \"sead\" 1"), "did you mean \"seed\"?");
  CHECK_CONTAINS(error_of("Option \"seed\""), "no value");
}
