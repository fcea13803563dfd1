#include "session/scene_check.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "tyndall/render.h"

namespace tyndall {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// What an error says of a scene; empty: it can be built.
std::string complaint(Scene scene) {
  try {
    build(std::move(scene));
  } catch (const Error& error) {
    CHECK(error.failure() == Failure::scene);
    return error.what();
  }
  return {};
}

Scene ball() {
  Scene scene;
  scene.film.width = scene.film.height = 4;
  scene.camera.to_world = Transform::look_at({0, 1, -4}, {0, 0, 0}, {0, 1, 0}).inverse();
  scene.textures.push_back({ConstantTexture{Rgb(0.5f)}, {}});
  scene.materials.push_back({DiffuseMaterial{.reflectance = 0}, "clay", {}});
  scene.shapes.push_back({.kind = Sphere{.radius = 1}, .material = 0});
  return scene;
}

/// A light of default values but for what `change` sets.
template <typename Kind, typename Change>
std::string with_light(Change change) {
  Kind light{};
  change(light);
  Scene scene = ball();
  scene.lights.push_back({std::move(light), {"hall.pbrt", 7, 3}});
  return complaint(std::move(scene));
}

std::string with_medium(decltype(Medium::kind) kind, MediumOptics optics = {}) {
  Scene scene = ball();
  scene.media.push_back({std::move(kind), optics, {}, "smoke", {}});
  return complaint(std::move(scene));
}

template <typename Change>
std::string changed(Change change) {
  Scene scene = ball();
  change(scene);
  return complaint(std::move(scene));
}

void require_says(const std::string& complaint, const std::string& part) {
  CAPTURE(complaint);
  CHECK(complaint.find(part) != std::string::npos);
}

TEST_CASE("lights that cannot be are refused by build, with their place and what is wrong") {
  CHECK(with_light<PointLight>([](auto& l) { l.I = Rgb(1); }).empty());
  CHECK(with_light<PointLight>([](auto& l) { l.position.x = kNan; }) ==
        "hall.pbrt:7:3: the point light has position nan 0 0; give three finite numbers");
  for (const Rgb color : {Rgb(kNan), Rgb(kInf), Rgb(-1), Rgb(0, -1, 0)}) {
    const auto set_I = [&](auto& l) { l.I = color; };
    require_says(with_light<PointLight>(set_I), "the point light has I ");
    require_says(with_light<SpotLight>(set_I), "the spot light has I ");
    require_says(with_light<GoniometricLight>(set_I), "the goniometric light has I ");
    require_says(with_light<ProjectionLight>(set_I), "the projection light has I ");
    require_says(with_light<DistantLight>([&](auto& l) { l.direction = {0, -1, 0}, l.E = color; }), "has E ");
    require_says(with_light<InfiniteLight>([&](auto& l) { l.L = color; }), "has L ");
  }
  for (const float angle : {0.0f, -1.0f, 181.0f, kNan})
    require_says(with_light<SpotLight>([&](auto& l) { l.cone_angle_degrees = angle; }), "cone_angle_degrees");
  for (const float angle : {-1.0f, 31.0f, kNan})
    require_says(with_light<SpotLight>([&](auto& l) { l.falloff_start_degrees = angle; }), "falloff_start_degrees");
  for (const Vec3 direction : {Vec3{}, Vec3{kNan, 0, 1}, Vec3{1e30f, 0, 0}, Vec3{1e-30f, 0, 0}})
    require_says(with_light<DistantLight>([&](auto& l) { l.direction = direction; }), "has direction");
  for (const float fov : {0.0f, 180.0f, kNan})
    require_says(with_light<ProjectionLight>([&](auto& l) { l.fov_degrees = fov; }), "fov_degrees");
  for (const float power : {-1.0f, kNan, kInf}) {
    require_says(with_light<GoniometricLight>([&](auto& l) { l.power = power; }), "has power");
    require_says(with_light<ProjectionLight>([&](auto& l) { l.power = power; }), "has power");
    require_says(with_light<InfiniteLight>([&](auto& l) { l.illuminance = power; }), "has illuminance");
  }
}

TEST_CASE("a light's colour may lie outside Rec.709") {
  CHECK(with_light<PointLight>([](auto& l) { l.position = {0, 2, 0}, l.I = {1, -0.2f, 0.1f}; }).empty());
}

TEST_CASE("shapes that emit what cannot be are refused, in objects too") {
  for (const bool in_object : {false, true}) {
    Scene scene = ball();
    AreaLight light;
    light.L = Rgb(1);
    light.power = -3.0f;
    scene.shapes[0].emission = light;
    if (in_object) {
      scene.objects.push_back({"o", scene.shapes});
      scene.shapes.clear();
    }
    require_says(complaint(scene), "the area light has power -3");
  }
}

TEST_CASE("cameras, films and filters that cannot be are refused") {
  for (const float fov : {0.0f, -10.0f, 180.0f, kNan})
    require_says(changed([&](Scene& s) { s.camera.fov_degrees = fov; }), "the camera has fov_degrees");
  CHECK(changed([](Scene& s) { s.camera.fov_degrees = 0, s.camera.kind = Camera::Kind::orthographic; }).empty());
  for (const float radius : {-1.0f, kNan, kInf})
    require_says(changed([&](Scene& s) { s.camera.lens_radius = radius; }), "lens_radius");
  for (const float distance : {-1.0f, 0.0f, kNan})
    require_says(changed([&](Scene& s) { s.camera.focal_distance = distance; }), "focal_distance");
  require_says(changed([](Scene& s) { s.camera.frame_aspect_ratio = 0.0f; }), "frame_aspect_ratio");
  require_says(changed([](Scene& s) { s.camera.screen_window = {1, 1, 0, 1}; }), "screen_window");
  require_says(changed([](Scene& s) { s.camera.screen_window = {0, kNan, 0, 1}; }), "screen_window");
  require_says(changed([](Scene& s) { s.camera.kind = Camera::Kind::realistic; }), "realistic without lenses");
  require_says(changed([](Scene& s) { s.source = "a.pbrt", s.film.width = 0; }), "a.pbrt: the film has 0 x 4 pixels");
  require_says(changed([](Scene& s) { s.film.height = 2'000'000'000; }), "pixels");
  for (const float ratio : {0.0f, -1.0f, kNan})
    require_says(changed([&](Scene& s) { s.film.imaging_ratio = ratio; }), "imaging_ratio");
  require_says(changed([](Scene& s) { s.film.max_component = kNan; }), "max_component");
  require_says(changed([](Scene& s) { s.filter.radius.x = kInf; }), "the pixel filter has radius.x inf");
  require_says(changed([](Scene& s) { s.filter.sigma = 0; }), "sigma");
}

TEST_CASE("media that cannot be are refused") {
  CHECK(with_medium(HomogeneousMedium{}).empty());
  require_says(with_medium(HomogeneousMedium{.Le = Rgb(kNan)}), "medium \"smoke\" has Le");
  for (const Rgb sigma : {Rgb(-1), Rgb(1, -0.1f, 1), Rgb(kNan), Rgb(kInf)}) {
    require_says(with_medium(HomogeneousMedium{}, {.sigma_a = sigma}), "sigma_a");
    require_says(with_medium(HomogeneousMedium{}, {.sigma_s = sigma}), "sigma_s");
  }
  for (const float g : {-1.5f, 2.0f, kNan})
    require_says(with_medium(HomogeneousMedium{}, {.phase = HenyeyGreenstein{g}}), "has g");
  require_says(with_medium(HomogeneousMedium{}, {.phase = Mie{kNan}}), "has diameter");
  require_says(with_medium(CloudMedium{.density = -1}), "has density -1");
  require_says(with_medium(CloudMedium{.bounds = {{0, 0, 0}, {1, kNan, 1}}}), "has bounds.max");
  require_says(with_medium(CloudMedium{.bounds = {{0, 0, 0}, {1, 0, 1}}}), "without a volume");
  UniformGridMedium grid;
  grid.density = {1};
  CHECK(with_medium(grid).empty());
  grid.Le_factor = -1;
  require_says(with_medium(grid), "has Le_factor");
}

TEST_CASE("densities that are too large are told of in the units of the scene") {
  Scene scene = ball();
  scene.shapes[0].kind = Sphere{.radius = 1000};
  UniformGridMedium grid;
  grid.density = {1e37f};
  scene.media.push_back({grid, {.sigma_a = Rgb(0), .sigma_s = Rgb(7)}, {}, "smoke", {}});
  CHECK(complaint(scene) ==
        "medium \"smoke\": densities up to 1e+37 times scale * sigma_s of 7 cannot be reckoned with; bring both nearer to 1");
  RgbGridMedium rgb;
  rgb.sigma_s = {Rgb(1e37f)};
  rgb.scale = 7;
  scene.media[0].kind = rgb;
  require_says(complaint(scene), "values of sigma_a and sigma_s up to 1e+37 times a scale of 7 cannot");
}

TEST_CASE("textures and materials that cannot be are refused") {
  require_says(changed([](Scene& s) { s.textures[0].kind = ConstantTexture{Rgb(kNan)}; }), "texture has a value");
  require_says(changed([](Scene& s) {
                 s.textures.push_back({NoiseTexture{.to_texture = {}, .octaves = 1000}, {}});
               }),
               "octaves");
  require_says(changed([](Scene& s) { s.textures.push_back({DirectionMixTexture{0, 0, {}}, {}}); }), "has direction");
  require_says(changed([](Scene& s) { s.materials[0].displacement_scale = kNan; }),
               "material \"clay\" has displacement_scale nan");
  require_says(changed([](Scene& s) {
                 CoatedDiffuseMaterial coated{};
                 coated.coating.max_depth = 0;
                 s.materials[0].kind = coated;
               }),
               "coating");
}

}  // namespace
}  // namespace tyndall
