#include "tyndall/denoise.h"

#include <optional>

#include "denoise/collaborative.h"
#include "denoise/energy.h"
#include "denoise/fireflies.h"
#include "denoise/inputs.h"
#include "denoise/selection.h"
#include "denoise/share_out.h"
#include "denoise/variance.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

/// Radii over which variance is pooled: outlines are as wide as a pixel.
constexpr int kNoise = 3, kOutline = 1;
constexpr float kClear = 0.999f;  ///< transmittance of as good as nothing

/// Features without their noise.
struct CleanFeatures {
  std::vector<PaddedPlane> surfaces, media;
  PaddedPlane clear;  ///< 1 where no medium is before the surface, else 0; empty when that is not known

  CleanFeatures(const FeatureInputs& inputs, ThreadPool& pool) {
    const auto add = [&](const std::vector<Feature>& from, std::vector<PaddedPlane>& to) {
      for (const Feature& feature : from) {
        for (PaddedPlane& plane : prefiltered(feature, pool)) to.push_back(std::move(plane));
      }
    };
    add(inputs.surfaces, surfaces);
    add(inputs.media, media);
    if (inputs.transmittance) clear = clear_of(media[*inputs.transmittance], pool);
  }

  static PaddedPlane clear_of(const PaddedPlane& transmittance, ThreadPool& pool) {
    const int width = transmittance.width(), height = transmittance.height();
    return make_plane(width, height, pool, [&](int x, int y) { return transmittance.at(x, y) > kClear ? 1.0f : 0.0f; });
  }

  std::vector<const PaddedPlane*> explaining(Explained what) const {
    std::vector<const PaddedPlane*> list;
    for (const PaddedPlane& plane : media) list.push_back(&plane);
    if (what != Explained::by_media) {
      for (const PaddedPlane& plane : surfaces) list.push_back(&plane);
    }
    return list;
  }
};

/// What all components share.
struct Knowledge {
  CleanFeatures features;
  PaddedPlane weight;  ///< relative_weight of all light
};

bool without_noise(const Halves& halves) {
  for (const PaddedPlane& plane : halves.variance) {
    for (int y = 0; y < plane.height(); ++y) {
      for (int x = 0; x < plane.width(); ++x) {
        if (plane.at(x, y) > 0) return false;
      }
    }
  }
  return true;
}

void add(ColorPlanes& sum, const ColorPlanes& part) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < sum[c].height(); ++y) {
      for (int x = 0; x < sum[c].width(); ++x) sum[c].at(x, y) += part[c].at(x, y);
    }
  }
}

LightEstimate mean_of(const Halves& halves, ThreadPool& pool) {
  LightEstimate estimate(halves.width(), halves.height());
  for (std::size_t c = 0; c < 3; ++c) {
    estimate.values[c] = make_plane(halves.width(), halves.height(), pool, [&](int x, int y) { return halves.mean(c, x, y); });
    estimate.mse[c] = halves.variance[c];
  }
  return estimate;
}

LightEstimate filtered(const Halves& halves, const Component& component, const Knowledge& known, ThreadPool& pool) {
  if (without_noise(halves)) return mean_of(halves, pool);
  const PaddedPlane& clear = known.features.clear;
  const Selection select{.weight = known.weight,
                         .noise_radius = component.emitters ? kOutline : kNoise,
                         .unfiltered = component.emitters && !clear.empty() ? &clear : nullptr,
                         .states_errors = component.states_errors};
  return select(halves, regress(halves, known.features.explaining(component.explained), pool), pool);
}

/// Emitters as the camera sees them have sharp outlines, and no noise but of these: no neighbour knows of it, and small ones
/// would pass for fireflies. Only what media do to their light on the way is filtered.
LightEstimate denoise_component(Halves halves, const Component& component, const Knowledge& known, ThreadPool& pool) {
  const Energy energy(halves);
  std::optional<Fireflies> fireflies;
  if (!component.emitters) fireflies = take_out_fireflies(halves, pool);
  pool_variance(halves, component.emitters ? kOutline : kNoise, pool);
  LightEstimate estimate = filtered(halves, component, known, pool);
  if (fireflies) fireflies->give_back(estimate, pool);
  energy.restore(estimate.values, halves.variance, pool);
  return estimate;
}

/// All light with little noise and with its edges. A firefly, or a bright neighbour, would have the errors of dark pixels count
/// for nothing, and be stated as large as itself.
ColorPlanes quiet_light(const Image& image, ThreadPool& pool) {
  Halves halves = read_halves(image, "");
  take_out_fireflies(halves, pool);
  Feature light;
  for (std::size_t h = 0; h < 2; ++h) {
    for (PaddedPlane& plane : halves.values[h]) light.halves[h].push_back(std::move(plane));
  }
  std::vector<PaddedPlane> planes = prefiltered(light, pool);
  return {std::move(planes[0]), std::move(planes[1]), std::move(planes[2])};
}

/// What is stated relative to the picture's brightness counts by the filtered one: around a bright outline others are too
/// bright.
void add_relative(LightEstimate& total, ThreadPool& pool) {
  const PaddedPlane weight = relative_weight(total.values, pool);
  for (std::size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < weight.height(); ++y)
      for (int x = 0; x < weight.width(); ++x) total.mse[c].at(x, y) += total.relative[c].at(x, y) / weight.at(x, y);
  }
}

void store(const ColorPlanes& planes, Image& image, const std::string& prefix) {
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string name = prefix + kRgb[c];
    std::size_t i = 0;
    while (i < image.channels.size() && image.channels[i].name != name) ++i;
    Channel& channel = i < image.channels.size() ? image.channels[i] : image.add_channel(name);
    auto to = channel.values.begin();
    for (int y = 0; y < planes[c].height(); ++y) to = std::copy_n(planes[c].row(y), planes[c].width(), to);
  }
}

void add_noise(const Halves& halves, ColorPlanes& sum) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < halves.height(); ++y) {
      for (int x = 0; x < halves.width(); ++x) sum[c].at(x, y) += halves.raw_variance(c, x, y);
    }
  }
}

/// relMSE of `mean` with squared errors `squared`.
double relative_error(const ColorPlanes& squared, const ColorPlanes& mean) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < mean[c].height(); ++y) {
      for (int x = 0; x < mean[c].width(); ++x) {
        const double m = mean[c].at(x, y);
        sum += squared[c].at(x, y) / (m * m + 0.01);
      }
    }
  }
  return sum / (3.0 * mean[0].width() * mean[0].height());
}

std::string header_text(const std::vector<Component>& components, const std::vector<std::string>& missing) {
  std::string text = "first-order regression of";
  for (const Component& c : components) text += " " + (c.prefix.empty() ? "RGB" : c.prefix.substr(0, c.prefix.size() - 1));
  for (const std::string& aov : missing) text += "; without " + aov.substr(0, aov.find(':'));
  return text;
}

}  // namespace

std::vector<std::string> denoise_aovs() { return input_aovs(); }

/// Planes that are there at once: features in two halves, a component, its fits by two bandwidths, what selects among them, and
/// what was taken out.
std::size_t denoise_memory(std::size_t pixels) { return pixels * sizeof(float) * (2 * 11 + 11 + 15 + 20 + 20 + 25 + 9); }

Denoised denoise(const Image& image, const DenoiseSettings& settings, const std::string& name) {
  const Timer timer;
  const std::vector<Component> components = components_of(image, name);
  ThreadPool pool(settings.threads);
  FeatureInputs inputs = read_features(image);
  Denoised result{image, {}};
  result.report.missing = std::move(inputs.missing);
  const ColorPlanes light = read_light(image);
  const Knowledge known{CleanFeatures(inputs, pool), relative_weight(quiet_light(image, pool), pool)};
  inputs = {};
  LightEstimate total(image.width(), image.height());
  ColorPlanes noise = color_planes(image.width(), image.height());
  for (const Component& component : components) {
    Halves halves = read_halves(image, component.prefix);
    add_noise(halves, noise);
    const LightEstimate part = denoise_component(std::move(halves), component, known, pool);
    if (settings.components && !component.prefix.empty()) store(part.values, result.image, component.prefix);
    add(total.values, part.values);
    add(total.mse, part.mse);
    add(total.relative, part.relative);
  }
  add_relative(total, pool);
  const std::vector<std::string> groups = groups_of(image);
  for (const std::string& group : groups)
    store(denoise_component(read_halves(image, group), {group, Explained::by_all, false, false}, known, pool).values,
          result.image, group);
  share_out(total.values, groups, result.image);
  store(light, result.image, "noisy.");
  store(total.values, result.image, "");
  store(total.mse, result.image, "Mse.");
  result.image.attributes["tyndall/denoised"] = header_text(components, result.report.missing);
  result.report.noisy_relmse = relative_error(noise, total.values);
  result.report.relmse = relative_error(total.mse, total.values);
  result.report.seconds = timer.seconds();
  return result;
}

}  // namespace tyndall
