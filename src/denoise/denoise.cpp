#include "tyndall/denoise.h"
#include "tyndall/cryptomatte.h"

#include <optional>

#include "denoise/collaborative.h"
#include "denoise/energy.h"
#include "denoise/fireflies.h"
#include "denoise/inputs.h"
#include "denoise/selection.h"
#include "denoise/share_out.h"
#include "denoise/stated_errors.h"
#include "denoise/variance.h"
#include "tyndall/image_attributes.h"
#include "tyndall/relative_error.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

constexpr int kOutlineRadius = 1;  ///< for kNoiseRadius where outlines are as wide as a pixel
constexpr float kClear = 0.999f;   ///< transmittance of as good as nothing

/// Features without their noise, by half.
struct CleanFeatures {
  std::array<std::vector<PaddedPlane>, 2> surfaces, media;
  PaddedPlane clear;  ///< 1 where no medium is before the surface, else 0; empty when that is not known

  CleanFeatures(const FeatureInputs& inputs, ThreadPool& pool) {
    const auto add = [&](const std::vector<Feature>& from, std::array<std::vector<PaddedPlane>, 2>& to) {
      for (const Feature& feature : from) {
        Feature clean = prefiltered(feature, pool);
        for (std::size_t h = 0; h < 2; ++h) {
          for (PaddedPlane& plane : clean.halves[h]) to[h].push_back(std::move(plane));
        }
      }
    };
    add(inputs.surfaces, surfaces);
    add(inputs.media, media);
    if (inputs.transmittance) clear = clear_of(media[0][*inputs.transmittance], media[1][*inputs.transmittance], pool);
  }

  static PaddedPlane clear_of(const PaddedPlane& even, const PaddedPlane& odd, ThreadPool& pool) {
    return make_plane(even.width(), even.height(), pool,
                      [&](int x, int y) { return std::min(even.at(x, y), odd.at(x, y)) > kClear ? 1.0f : 0.0f; });
  }

  FeatureHalves explaining(Explained what) const {
    FeatureHalves list;
    for (std::size_t h = 0; h < 2; ++h) {
      for (const PaddedPlane& plane : media[h]) list[h].push_back(&plane);
      if (what != Explained::by_media) {
        for (const PaddedPlane& plane : surfaces[h]) list[h].push_back(&plane);
      }
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

LightEstimate mean_of(const Halves& halves, ThreadPool& pool) {
  LightEstimate estimate(halves.width(), halves.height());
  for (std::size_t c = 0; c < 3; ++c) {
    estimate.values[c] = make_plane(halves.width(), halves.height(), pool, [&](int x, int y) { return halves.mean(c, x, y); });
    estimate.mse[c] = halves.variance[c];
  }
  estimate.halves = halves.values;
  return estimate;
}

LightEstimate filtered(const Halves& halves, const Component& component, const Knowledge& known, ThreadPool& pool) {
  if (without_noise(halves)) return mean_of(halves, pool);
  const PaddedPlane& clear = known.features.clear;
  const Selection select{.weight = known.weight,
                         .noise_radius = component.emitters ? kOutlineRadius : kNoiseRadius,
                         .unfiltered = component.emitters && !clear.empty() ? &clear : nullptr};
  return select(halves, regress(halves, known.features.explaining(component.explained), pool), pool);
}

/// Emitters as the camera sees them have sharp outlines, and no noise but of these: no neighbour knows of it, and small ones
/// would pass for fireflies. Only what media do to their light on the way is filtered.
ColorPlanes denoise_component(Halves halves, const Component& component, const Knowledge& known, AllLight* all,
                              ThreadPool& pool) {
  const Energy energy(halves);
  std::optional<Fireflies> fireflies;
  if (!component.emitters) fireflies = take_out_fireflies(halves, pool);
  pool_variance(halves, component.emitters ? kOutlineRadius : kNoiseRadius, pool);
  LightEstimate estimate = filtered(halves, component, known, pool);
  if (all) all->add(halves, estimate);
  if (fireflies) fireflies->give_back(estimate.values, all ? &all->rare : nullptr, pool);
  energy.restore(estimate.values, halves.variance, pool);
  if (all) add_planes(all->filtered.values, estimate.values);
  return std::move(estimate.values);
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
  const Feature clean = prefiltered(light, pool);
  ColorPlanes mean;
  for (std::size_t c = 0; c < 3; ++c) {
    mean[c] = make_plane(image.width(), image.height(), pool,
                         [&](int x, int y) { return 0.5f * (clean.halves[0][c].at(x, y) + clean.halves[1][c].at(x, y)); });
  }
  return mean;
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
        sum += squared[c].at(x, y) / (m * m + kRelativeEpsilon);
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

std::vector<std::string> aovs_named(const std::string& name) {
  if (name == "Denoise") return denoise_aovs();
  if (name == "Cryptomatte") return {kMatteLayers.begin(), kMatteLayers.end()};
  return {name};
}

/// Planes that are there at once: the image once more with what is added to it, features in two halves and without noise, a
/// component, its fits by two bandwidths, what selects among them, all light in two halves, and what was taken out. The
/// features' first planes are gone when the latter are made, which leaves room for margins; the sums of tiles are the same for
/// any size.
std::size_t denoise_memory(std::size_t pixels) {
  constexpr std::size_t kImage = 58 + 6, kTiles = std::size_t{27} << 20;
  return kTiles + pixels * sizeof(float) * (kImage + 2 * 11 + 2 * 11 + 15 + 20 + 20 + 25 + 27 + 9);
}

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
  AllLight all(image.width(), image.height());
  ColorPlanes noise = color_planes(image.width(), image.height());
  for (const Component& component : components) {
    Halves halves = read_halves(image, component.prefix);
    add_noise(halves, noise);
    const ColorPlanes part = denoise_component(std::move(halves), component, known, &all, pool);
    if (settings.components && !component.prefix.empty()) store(part, result.image, component.prefix);
  }
  const ColorPlanes values = all.filtered.values, errors = stated_errors(std::move(all), known.weight, pool);
  const std::vector<std::string> groups = groups_of(image);
  for (const std::string& group : groups)
    store(denoise_component(read_halves(image, group), {group, Explained::by_all}, known, nullptr, pool), result.image, group);
  share_out(values, groups, result.image);
  store(light, result.image, "noisy.");
  store(values, result.image, "");
  store(errors, result.image, "Mse.");
  result.image.attributes[attributes::kDenoised] = header_text(components, result.report.missing);
  result.report.noisy_relmse = relative_error(noise, values);
  result.report.relmse = relative_error(errors, values);
  result.report.seconds = timer.seconds();
  return result;
}

}  // namespace tyndall
