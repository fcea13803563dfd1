#include "support/noise.h"

#include <numeric>
#include <utility>

#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall::test {

Noise noise_of(const std::string& text, JointStrategy joint, int spp) {
  SceneFile file = read_scene_text(text, "noise.pbrt");
  RenderSettings settings = file.scene.settings;
  settings.spp = spp;
  settings.joint = joint;
  settings.aovs = {"Variance"};
  const Image image = render(build(std::move(file.scene)), settings).image;
  const auto sum = [&](const char* channel) {
    const auto& values = image.find(channel)->values;
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  return {sum("Variance.R"), sum("R")};
}

}  // namespace tyndall::test
