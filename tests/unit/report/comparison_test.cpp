#include "tyndall/compare.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tyndall/io.h"
#include "tyndall/render.h"
#include "unit/report/pictures.h"

namespace tyndall {
namespace {

using nlohmann::json;

constexpr const char* kScene = R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 8
Camera "perspective" "float fov" 50
WorldBegin
LightSource "point" "rgb I" [ 1 2 3 ] "point3 from" [ 1 1 2 ]
LightSource "point" "rgb I" [ 1 1 1 ] "point3 from" [ -3 1 2 ]
Translate 0 0 4
Shape "sphere" "float radius" 1.5
)";

Scene scene() { return read_scene_text(kScene, "test.pbrt").scene; }

RenderSettings by(LightStrategy lights) {
  RenderSettings settings;
  settings.lights = lights;
  return settings;
}

MethodRace two_methods() {
  MethodRace race;
  race.methods = {{"even", by(LightStrategy::uniform)}, {"strong", by(LightStrategy::power)}};
  race.samples = 4;
  race.seeds = 2;
  race.reference_relmse = 0.1;
  return race;
}

Failure failure_of(const MethodRace& race) {
  try {
    race_methods(scene(), race);
  } catch (const Error& e) {
    return e.failure();
  }
  return Failure::run_time;
}

TEST_CASE("images held against each other, as JSON") {
  const Image grey = test::flat(8, 8, 0.5, 0.5, 0.5), other = test::flat(8, 8, 0.5, 0.75, 0.5);
  CHECK(json::parse(diff_images(grey, grey))["same"] == true);
  const json found = json::parse(diff_images(other, grey));
  CHECK(found["same"] == false);
  CHECK(found["criterion"] == "--exact");
  CHECK(found["channels"][1]["name"] == "G");
  CHECK(found["channels"][1]["bias"] == doctest::Approx(0.25));
  CHECK(json::parse(diff_images(other, grey, {.max_error = 0.3}))["same"] == true);
  CHECK(json::parse(diff_images(other, grey, {.channels = {"R"}}))["same"] == true);
  CHECK(json::parse(diff_images(other, grey, {.flip = false}))["flip"].is_null());
  CHECK_THROWS_AS(diff_images(grey, grey, {.channels = {"Z"}}), Error);
}

TEST_CASE("methods race for the same samples, against a reference that they make or are given") {
  double told = 0;
  const MethodRaceResult made = race_methods(scene(), two_methods(), {.progress = [&](double f) { told = f; }});
  const json found = json::parse(made.json);
  CHECK(told == doctest::Approx(1));
  REQUIRE(found["variants"].size() == 2);
  CHECK(found["variants"][1]["name"] == "strong");
  CHECK(found["variants"][1]["samples"] == 4);
  CHECK(found["settings"]["seeds"] == json::array({1, 2}));
  REQUIRE(made.images.size() == 2);
  CHECK(made.images[1].name == "strong");
  CHECK(made.images[1].image.width() == 16);

  MethodRace again = two_methods();
  again.reference = made.reference;
  const json same = json::parse(race_methods(scene(), again).json);
  CHECK(same["reference"]["source"] == "the reference");
  CHECK(same["variants"][0]["mse"] == found["variants"][0]["mse"]);
}

TEST_CASE("races that cannot be are refused") {
  MethodRace race = two_methods();
  race.methods.clear();
  CHECK(failure_of(race) == Failure::usage);
  race = two_methods();
  race.seconds = 1;
  CHECK(failure_of(race) == Failure::usage);
  race = two_methods();
  race.seeds = 1;
  CHECK(failure_of(race) == Failure::usage);
  race = two_methods();
  race.reference = test::flat(4, 4, 1, 1, 1);
  CHECK(failure_of(race) == Failure::scene);
}

TEST_CASE("a race that is stopped before a seed is complete says so") {
  const std::atomic<bool> stop = true;
  CHECK_THROWS_WITH_AS(race_methods(scene(), two_methods(), {.stop = &stop}),
                       "the comparison was stopped before a seed was complete", Error);
}

}  // namespace
}  // namespace tyndall
