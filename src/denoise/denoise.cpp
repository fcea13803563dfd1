#include "tyndall/denoise.h"

#include "denoise/collaborative.h"
#include "denoise/energy.h"
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

LightEstimate mean_of(const Halves& halves, ThreadPool& pool) {
  LightEstimate estimate;
  for (std::size_t c = 0; c < 3; ++c) {
    estimate.values[c] = make_plane(halves.width(), halves.height(), pool, [&](int x, int y) { return halves.mean(c, x, y); });
    estimate.mse[c] = halves.variance[c];
  }
  return estimate;
}

/// Emitters as the camera sees them have sharp outlines, and no noise but of these: no neighbour knows of it, and small ones
/// would pass for fireflies. Only what media do to their light on the way is filtered.
LightEstimate denoise_component(Halves halves, const Component& component, const Knowledge& known, ThreadPool& pool) {
  const Energy energy(halves);
  if (!component.emitters) take_out_fireflies(halves, pool);
  pool_variance(halves, component.emitters ? kOutline : kNoise, pool);
  if (without_noise(halves)) return mean_of(halves, pool);
  const PaddedPlane& clear = known.features.clear;
  const Selection select{known.weight, component.emitters && !clear.empty() ? &clear : nullptr};
  LightEstimate estimate = select(halves, regress(halves, known.features.explaining(component.explained), pool), pool);
  energy.restore(estimate.values, halves.variance, pool);
  return estimate;
}

void add(ColorPlanes& sum, const ColorPlanes& part) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (int y = 0; y < sum[c].height(); ++y) {
      for (int x = 0; x < sum[c].width(); ++x) sum[c].at(x, y) += part[c].at(x, y);
    }
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

/// Planes that are there at once: features in two halves, a component, its fits by two bandwidths, and what selects among them.
std::size_t denoise_memory(std::size_t pixels) { return pixels * sizeof(float) * (2 * 11 + 11 + 9 + 20 + 20 + 16); }

Denoised denoise(const Image& image, const DenoiseSettings& settings, const std::string& name) {
  const Timer timer;
  const std::vector<Component> components = components_of(image, name);
  ThreadPool pool(settings.threads);
  FeatureInputs inputs = read_features(image);
  Denoised result{image, {}};
  result.report.missing = std::move(inputs.missing);
  const ColorPlanes light = read_light(image);
  const Knowledge known{CleanFeatures(inputs, pool), relative_weight(light, pool)};
  inputs = {};
  LightEstimate total{color_planes(image.width(), image.height()), color_planes(image.width(), image.height())};
  ColorPlanes noise = color_planes(image.width(), image.height());
  for (const Component& component : components) {
    Halves halves = read_halves(image, component.prefix);
    add_noise(halves, noise);
    const LightEstimate part = denoise_component(std::move(halves), component, known, pool);
    if (settings.components && !component.prefix.empty()) store(part.values, result.image, component.prefix);
    add(total.values, part.values);
    add(total.mse, part.mse);
  }
  const std::vector<std::string> groups = groups_of(image);
  for (const std::string& group : groups)
    store(denoise_component(read_halves(image, group), {group, Explained::by_all}, known, pool).values, result.image, group);
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
