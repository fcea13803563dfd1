#include <algorithm>
#include <sstream>

#include "session/film_buffer.h"
#include "session/slice_header.h"
#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/slice.h"

namespace tyndall {
namespace {

Film film_of(const Image& header, const std::string& path) {
  Film film;
  film.width = header.display.width();
  film.height = header.display.height();
  if (header.chromaticities) film.chromaticities = *header.chromaticities;
  const auto* rows = header.attribute<std::array<float, 16>>(attributes::kFilmSpace);
  if (!rows) refuse_slice(path, "has no attribute " + std::string(attributes::kFilmSpace));
  std::copy_n(rows->begin(), film.from_rec709.size(), film.from_rec709.begin());
  return film;
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  return names;
}

std::vector<std::string> groups_of(const Image& header) {
  const auto* names = header.attribute<std::string>(attributes::kLightGroups);
  return names ? split(*names) : std::vector<std::string>();
}

/// "": without a deep image.
std::string deep_layout_of(const Image& header) {
  const auto* text = header.attribute<std::string>(attributes::kDeepLayout);
  return text ? *text : "";
}

std::optional<DeepLayout> deep_of(const Image& header, const std::string& path) {
  if (!header.attributes.contains(attributes::kDeepLayout)) return std::nullopt;
  const auto layout = DeepLayout::parse(text_attribute(header, path, attributes::kDeepLayout));
  if (!layout) refuse_slice(path, "attribute " + std::string(attributes::kDeepLayout) + " is damaged");
  return layout;
}

/// Those that `asked` names, and what merging tells besides.
std::vector<Aov> aovs_of(std::vector<std::string> asked, const std::string& path) {
  asked.insert(asked.end(), {"Variance", "SampleCount"});
  try {
    return parse_aovs(asked);
  } catch (const Error&) {
    refuse_slice(path, "attribute " + std::string(attributes::kAovs) + " names channels that this Tyndall does not know");
  }
}

}  // namespace

class SliceSum::Impl {
 public:
  Impl(const Image& header, const std::string& path)
      : asked_(split(text_attribute(header, path, attributes::kAovs))),
        deep_layout_(deep_layout_of(header)),
        film_(film_of(header, path), header.data, {aovs_of(asked_, path), groups_of(header), deep_of(header, path)}) {}

  void add(const Image& slice, const std::string& path) {
    const auto info = slice_info(slice, path);
    if (!info || slice.data != film_.crop()) refuse_slice(path, "is no slice of these");
    if (!film_.has_sums(slice) || hash_of_sums(slice) != text_attribute(slice, path, attributes::kSumHash))
      refuse_slice(path, "is damaged: its sums do not fit their checksum");
    film_.add_sums(slice);
    same_depth_ = same_depth_ && deep_layout_of(slice) == deep_layout_;
    samples_ += info->range.count;
  }

  Image image(bool with_variance) const {
    Image image = film_.image(samples_);
    if (with_variance) return image;
    const auto asked = [&](const std::string& aov) { return std::find(asked_.begin(), asked_.end(), aov) != asked_.end(); };
    std::erase_if(image.channels, [&](const Channel& c) {
      return (c.name.starts_with("Variance.") && !asked("Variance")) || (c.name == "SampleCount" && !asked("SampleCount"));
    });
    return image;
  }

  /// Sums in other bins, or of fewer slices, would be those of another picture.
  std::optional<DeepImage> deep_image() const { return same_depth_ ? film_.deep_image(samples_) : std::nullopt; }

  int samples() const { return samples_; }
  double estimated_relmse() const { return film_.estimated_relmse(samples_); }

 private:
  std::vector<std::string> asked_;
  std::string deep_layout_;
  FilmBuffer film_;
  bool same_depth_ = true;
  int samples_ = 0;
};

SliceSum::SliceSum(const Image& header, const std::string& path) : impl_(std::make_unique<Impl>(header, path)) {}
SliceSum::SliceSum(SliceSum&&) noexcept = default;
SliceSum& SliceSum::operator=(SliceSum&&) noexcept = default;
SliceSum::~SliceSum() = default;

void SliceSum::add(const Image& slice, const std::string& path) { impl_->add(slice, path); }
int SliceSum::samples() const { return impl_->samples(); }
double SliceSum::estimated_relmse() const { return impl_->estimated_relmse(); }
std::optional<DeepImage> SliceSum::deep_image() const { return impl_->deep_image(); }
Image SliceSum::image(bool with_variance) const { return impl_->image(with_variance); }

}  // namespace tyndall
