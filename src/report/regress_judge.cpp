#include "report/regress_judge.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "report/channel_group.h"
#include "report/image_test.h"
#include "report/regress_reference.h"

namespace tyndall {
namespace {

/// Of the last letter: R G B and X Y Z in their order, a single channel first.
std::size_t place_in_layer(const std::string& channel) {
  const bool one_of_many = channel.size() == 1 ? channel != "A" && channel != "Z" : channel.find('.') != std::string::npos;
  if (!one_of_many) return 0;
  const std::size_t place = std::string("RGBXYZ").find(channel.back());
  return place == std::string::npos ? 0 : place % 3;
}

/// Channels that the layer has not are 0 and without noise, which tells the test nothing.
std::optional<MeanImage> layer_image(const Image& image, const Layer& layer, int runs) {
  MeanImage result{image.width(), image.height(), {}};
  const std::size_t pixels = static_cast<std::size_t>(image.width()) * image.height();
  for (int k = 0; k < 3; ++k) {
    result.channels[k].resize(pixels, Estimate{0, 0, static_cast<double>(runs - 1)});
    if (layer.channels[k].empty()) continue;
    const Channel* mean = image.find(layer.channels[k]);
    const Channel* variance = image.find("Variance." + layer.channels[k]);
    if (mean == nullptr || variance == nullptr) return std::nullopt;
    for (std::size_t i = 0; i < pixels; ++i) {
      result.channels[k][i].mean = mean->values[i];
      result.channels[k][i].variance = variance->values[i];
    }
  }
  return result;
}

std::vector<Layer> layers_of_either(const Image& a, const Image& b) {
  std::vector<Layer> layers = layers_of(a);
  for (const Layer& other : layers_of(b)) {
    const auto same_name = [&](const Layer& l) { return l.name == other.name; };
    if (std::none_of(layers.begin(), layers.end(), same_name)) layers.push_back(other);
  }
  return layers;
}

LayerTest summary(const std::string& name, const ImageTest& t) {
  LayerTest test{.what = name, .same = t.same, .verdict = t.verdict, .alarms = t.alarms, .blocks = t.blocks};
  test.worst_p = t.worst_block.welch.p;
  test.mean_difference = t.relative_bias;
  test.mean_error = t.relative_error;
  test.uniformity_p = *std::min_element(t.uniformity_p.begin(), t.uniformity_p.end());
  return test;
}

}  // namespace

std::vector<Layer> layers_of(const Image& image) {
  std::vector<Layer> layers;
  for (const Channel& c : image.channels) {
    if (!is_tested_channel(c.name)) continue;
    const std::string name = group_of(c.name);
    auto layer = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; });
    if (layer == layers.end()) layer = layers.insert(name == "RGB" ? layers.begin() : layers.end(), {name, {}});
    layer->channels[place_in_layer(c.name)] = c.name;
  }
  return layers;
}

std::vector<LayerTest> judge(const Image& render, const Image& reference, double level) {
  const int runs = run_counts(render, "the render").runs, reference_runs = run_counts(reference, "the reference").runs;
  std::vector<LayerTest> tests;
  for (const Layer& layer : layers_of_either(render, reference)) {
    const auto a = layer_image(render, layer, runs), b = layer_image(reference, layer, reference_runs);
    if (!a || !b) {
      tests.push_back(
          {.what = layer.name, .verdict = "the " + std::string(a ? "reference" : "render") + " has no such channels"});
    } else {
      tests.push_back(summary(layer.name, test_images(*a, *b, {.family_level = level})));
    }
  }
  return tests;
}

double layer_mean(const Image& image, const Layer& layer) {
  double sum = 0;
  int count = 0;
  for (const std::string& name : layer.channels) {
    const Channel* channel = name.empty() ? nullptr : image.find(name);
    if (channel == nullptr || channel->values.empty()) continue;
    sum += std::accumulate(channel->values.begin(), channel->values.end(), 0.0) / static_cast<double>(channel->values.size());
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace tyndall
