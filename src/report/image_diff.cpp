#include "report/image_diff.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>
#include <tuple>

#include "report/channel_group.h"
#include "report/mean_image.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

bool wanted(const std::string& channel, const DiffSettings& settings) {
  const auto& list = settings.channels;
  const auto has = [&](const std::string& name) { return std::find(list.begin(), list.end(), name) != list.end(); };
  return list.empty() || has(channel) || has(group_of(channel));
}

void require_known(const Image& image, const Image& reference, const DiffSettings& settings) {
  for (const std::string& name : settings.channels) {
    const auto names = [&](const Channel& c) { return c.name == name || group_of(c.name) == name; };
    if (std::any_of(image.channels.begin(), image.channels.end(), names) ||
        std::any_of(reference.channels.begin(), reference.channels.end(), names)) {
      continue;
    }
    throw Error(Failure::usage, "neither image has a channel or group \"" + name + "\"; tyndall info lists the channels");
  }
}

std::string text(const PixelBounds& b) {
  return std::to_string(b.width()) + " x " + std::to_string(b.height()) + " pixels from (" + std::to_string(b.x0) + ", " +
         std::to_string(b.y0) + ")";
}

std::string text(const Chromaticities& c) {
  std::string text;
  for (const Vec2 xy : {c.red, c.green, c.blue, c.white}) {
    char part[32];
    std::snprintf(part, sizeof part, "%s%.4g %.4g", text.empty() ? "" : ", ", double{xy.x}, double{xy.y});
    text += part;
  }
  return text;
}

std::string primaries_difference(const Image& image, const Image& reference) {
  const auto a = image.chromaticities.value_or(Chromaticities{}), b = reference.chromaticities.value_or(Chromaticities{});
  constexpr float kSame = 1e-3f;  // files round them
  const auto same = [](Vec2 p, Vec2 q) { return std::abs(p.x - q.x) <= kSame && std::abs(p.y - q.y) <= kSame; };
  if (same(a.red, b.red) && same(a.green, b.green) && same(a.blue, b.blue) && same(a.white, b.white)) return {};
  return "chromaticities of red, green, blue and white are " + text(a) + ", the reference's " + text(b);
}

/// Values of the channel that are `bad`, when there are any.
template <typename Bad>
void find_values(const Image& image, const Channel& c, bool is_reference, Bad bad, std::vector<BadValues>& found) {
  BadValues values{c.name, is_reference, 0, 0, 0};
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (!bad(c.values[i]) || values.count++ > 0) continue;
    values.x = image.data.x0 + static_cast<int>(i % static_cast<std::size_t>(image.width()));
    values.y = image.data.y0 + static_cast<int>(i / static_cast<std::size_t>(image.width()));
  }
  if (values.count > 0) found.push_back(values);
}

/// Variances are looked at with the channels that they belong to: these are judged by them.
void find_bad_values(const Image& image, bool is_reference, const DiffSettings& settings, ImageDiff& diff) {
  constexpr std::string_view kVariance = "Variance.";
  for (const Channel& c : image.channels) {
    const bool is_variance = c.name.starts_with(kVariance);
    if (wanted(c.name, settings)) {
      find_values(
          image, c, is_reference, [](float v) { return !std::isfinite(v); }, diff.non_finite);
    }
    if (is_variance && (wanted(c.name, settings) || wanted(c.name.substr(kVariance.size()), settings))) {
      find_values(
          image, c, is_reference, [](float v) { return v < 0; }, diff.negative_variances);
    }
  }
}

/// The variances of a channel; none unless they can be believed.
const Channel* variances_of(const Image& image, const std::string& channel) {
  const Channel* variances = image.find("Variance." + channel);
  if (!variances) return nullptr;
  const bool negative = std::any_of(variances->values.begin(), variances->values.end(), [](float v) { return v < 0; });
  return negative ? nullptr : variances;
}

/// One standard error of the mean difference: by the variances of both, else by the spread over pixels (`squares`: sum of
/// squared differences).
void measure_bias_error(const Image& image, const Image& reference, double squares, ChannelDiff& diff) {
  const Channel *a = variances_of(image, diff.name), *b = variances_of(reference, diff.name);
  const auto n = static_cast<double>(required_channel(image, diff.name).values.size());
  diff.error_from_variance = a && b;
  if (a && b) {
    double variance = 0;
    const double of_a = sharing_of(image), of_b = sharing_of(reference);
    for (std::size_t i = 0; i < a->values.size(); ++i) variance += of_a * a->values[i] + of_b * b->values[i];
    diff.bias_error = std::sqrt(variance) / n;
  } else {
    diff.bias_error = std::sqrt(std::max(squares / n - diff.bias * diff.bias, 0.0) / std::max(n - 1, 1.0));
  }
}

ChannelDiff compare_channel(const Image& image, const Image& reference, const std::string& name) {
  const auto &a = required_channel(image, name).values, &b = required_channel(reference, name).values;
  ChannelDiff diff{.name = name, .x = image.data.x0, .y = image.data.y0, .equal = true};
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = static_cast<double>(a[i]) - b[i];
    const double distance = std::isnan(d) ? std::numeric_limits<double>::infinity() : std::abs(d);
    diff.mean += a[i];
    diff.reference_mean += b[i];
    squares += d * d;
    diff.equal = diff.equal && a[i] == b[i];
    if (distance <= diff.largest) continue;
    diff.largest = distance;
    diff.x = image.data.x0 + static_cast<int>(i % static_cast<std::size_t>(image.width()));
    diff.y = image.data.y0 + static_cast<int>(i / static_cast<std::size_t>(image.width()));
  }
  const auto n = static_cast<double>(a.size());
  diff.mean /= n;
  diff.reference_mean /= n;
  diff.bias = diff.mean - diff.reference_mean;
  measure_bias_error(image, reference, squares, diff);
  return diff;
}

/// R, G, B first, what describes the render last; within a group R, G, B in this order.
void put_in_order(std::vector<ChannelDiff>& channels) {
  const auto key = [](const ChannelDiff& c) {
    const std::string group = group_of(c.name), suffix = c.name.substr(c.name.rfind('.') + 1);
    const int rank = group == "RGB" ? 0 : (is_statistic(c.name) ? 2 : 1);
    const std::size_t color = suffix.size() == 1 ? std::string("RGB").find(suffix) : std::string::npos;
    return std::make_tuple(rank, group, color, c.name);
  };
  std::sort(channels.begin(), channels.end(), [&](const ChannelDiff& a, const ChannelDiff& b) { return key(a) < key(b); });
}

void group_channels(ImageDiff& diff) {
  for (const ChannelDiff& c : diff.channels) {
    const std::string group = group_of(c.name);
    if (diff.groups.empty() || diff.groups.back().name != group) diff.groups.push_back({group, {}, {}, {}});
    diff.groups.back().channels.push_back(c.name);
  }
}

bool has_rgb(const ImageDiff& diff) {
  return std::any_of(diff.groups.begin(), diff.groups.end(),
                     [](const GroupDiff& g) { return g.name == "RGB" && g.channels.size() == 3; });
}

void compare_channels(const Image& image, const Image& reference, const DiffSettings& settings, ImageDiff& diff) {
  for (const Channel& c : image.channels) {
    if (!wanted(c.name, settings)) continue;
    if (!reference.find(c.name)) {
      diff.only_in_image.push_back(c.name);
      continue;
    }
    diff.channels.push_back(compare_channel(image, reference, c.name));
  }
  for (const Channel& c : reference.channels) {
    if (wanted(c.name, settings) && !image.find(c.name)) diff.only_in_reference.push_back(c.name);
  }
  put_in_order(diff.channels);
  group_channels(diff);
}

}  // namespace

bool is_statistic(const std::string& channel) {
  return channel.starts_with("Variance") || channel == "SampleCount" || channel == "SampleWeight";
}

ImageDiff compare_images(const Image& image, const Image& reference, const DiffSettings& settings) {
  require_known(image, reference, settings);
  ImageDiff diff;
  diff.data = image.data;
  diff.primaries = primaries_difference(image, reference);
  if (!(image.data == reference.data)) {
    diff.windows = "the image has " + text(image.data) + ", the reference " + text(reference.data);
    return diff;
  }
  if (image.width() <= 0 || image.height() <= 0) throw Error(Failure::usage, "the images have no pixels");
  if (settings.reference_noise && !has_variances(reference)) {
    throw Error(Failure::usage, "the reference has no variances, so that its noise is unknown; render it with --aov Variance");
  }
  find_bad_values(image, false, settings, diff);
  find_bad_values(reference, true, settings, diff);
  compare_channels(image, reference, settings, diff);
  for (GroupDiff& group : diff.groups) {
    group.errors = measure_error(image, reference, group.channels);
    if (settings.reference_noise && group.name == "RGB" && group.channels.size() == 3) {
      group.without_noise = measure_error_without_noise(image, reference);
    }
  }
  if (!has_rgb(diff)) return diff;
  if (has_variances(image) && has_variances(reference) && diff.negative_variances.empty()) {
    diff.test = test_images(mean_image(image, 1), mean_image(reference, 1), settings.test);
  }
  const bool finite = std::none_of(diff.non_finite.begin(), diff.non_finite.end(),
                                   [](const BadValues& n) { return group_of(n.channel) == "RGB"; });
  if (settings.flip && finite) {
    diff.flip_ldr = flip_ldr(image, reference, settings.flip_settings);
    diff.flip_hdr = flip_hdr(image, reference, settings.flip_settings);
  }
  return diff;
}

}  // namespace tyndall
