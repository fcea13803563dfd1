// The program in README: a ball under a light, by hand.
#include <tyndall/io.h>
#include <tyndall/render.h>

int main() {
  using namespace tyndall;
  Scene scene;
  scene.film.width = scene.film.height = 256;
  scene.camera.fov_degrees = 45;
  scene.camera.to_world = Transform::look_at({0, 1, -4}, {0, 0, 0}, {0, 1, 0}).inverse();
  scene.textures.push_back({ConstantTexture{{0.7f, 0.5f, 0.3f}}, {}});
  scene.materials.push_back({DiffuseMaterial{.reflectance = 0}, "clay", {}});
  scene.shapes.push_back({.kind = Sphere{.radius = 1}, .material = 0});
  scene.lights.push_back({PointLight{.position = {2, 3, -3}, .I = Rgb(30)}, {}});
  const Rendering picture = render(build(std::move(scene)), {.spp = 16});
  write_exr(picture.image, "ball.exr");
}
