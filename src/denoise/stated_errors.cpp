#include "denoise/stated_errors.h"

#include <algorithm>

#include "denoise/judged_error.h"
#include "denoise/variance.h"

namespace tyndall {
namespace {

/// Of the noise: light of one colour has none in the others.
float share_of_channel(const Halves& halves, std::size_t c, int x, int y) {
  float sum = 0;
  for (const PaddedPlane& plane : halves.variance) sum += plane.at(x, y);
  return sum > 0 ? halves.variance[c].at(x, y) / sum : 1.0f / 3;
}

ColorPlanes squares_apart(const AllLight& light, ThreadPool& pool) {
  ColorPlanes squares;
  for (std::size_t c = 0; c < 3; ++c) {
    squares[c] = make_plane(light.rendered.width(), light.rendered.height(), pool, [&](int x, int y) {
      const float apart = light.filtered.apart[c].at(x, y);
      return light.rendered.share[0] * light.rendered.share[1] * apart * apart;
    });
  }
  return squares;
}

/// Of what is filtered. What is not is known by pixel, in LightEstimate::mse.
JudgedError judge_filtered(const AllLight& light, const PaddedPlane& weight, ThreadPool& pool) {
  const LightEstimate& filtered = light.filtered;
  JudgedError judged = judge(light.rendered, {&filtered.halves[0], &filtered.halves[1]}, weight, pool);
  const PaddedPlane unfiltered = pooled_relative(filtered.mse, weight, pool);
  judged.error = make_plane(weight.width(), weight.height(), pool,
                            [&](int x, int y) { return judged.error.at(x, y) - unfiltered.at(x, y); });
  judged.variance = pooled_relative(squares_apart(light, pool), weight, pool);
  return judged;
}

}  // namespace

AllLight::AllLight(int width, int height)
    : rendered{{color_planes(width, height), color_planes(width, height)}, {}, color_planes(width, height)},
      filtered(width, height),
      rare(color_planes(width, height)) {}

void AllLight::add(const Halves& rendered_part, const LightEstimate& filtered_part) {
  rendered.share = rendered_part.share;
  for (std::size_t h = 0; h < 2; ++h) {
    add_planes(rendered.values[h], rendered_part.values[h]);
    add_planes(filtered.halves[h], filtered_part.halves[h]);
  }
  add_planes(filtered.apart, filtered_part.apart);
  add_planes(filtered.mse, filtered_part.mse);
}

/// What is stated relative to the picture counts by the picture as it ended up: around a bright outline others are too bright.
/// What is filtered is off by no more than its own noise, or that around it, and what was changed.
ColorPlanes stated_errors(AllLight light, const PaddedPlane& weight, ThreadPool& pool) {
  pool_variance(light.rendered, kNoiseRadius, pool);
  const PaddedPlane expected = expected_error(judge_filtered(light, weight, pool), pool);
  const PaddedPlane final_weight = relative_weight(light.filtered.values, pool);
  ColorPlanes errors;
  for (std::size_t c = 0; c < 3; ++c) {
    errors[c] = make_plane(weight.width(), weight.height(), pool, [&](int x, int y) {
      const float filtered = share_of_channel(light.rendered, c, x, y) * expected.at(x, y) / final_weight.at(x, y);
      const float noise = std::max(light.rendered.variance[c].at(x, y), light.rendered.raw_variance(c, x, y));
      const float apart = light.filtered.values[c].at(x, y) - light.rendered.mean(c, x, y);
      return std::min(filtered, noise + apart * apart) + light.filtered.mse[c].at(x, y) + light.rare[c].at(x, y);
    });
  }
  return errors;
}

}  // namespace tyndall
