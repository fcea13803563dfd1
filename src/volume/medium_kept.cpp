/// Media of files that were made for an earlier scene are taken from there.
#include <string_view>
#include <type_traits>

#include "tyndall/frames.h"
#include "volume/medium.h"
#include "volume/medium_data.h"

namespace tyndall {
namespace {

/// A medium, and what was said when it was made.
struct KeptMedium {
  MediumData data;
  std::vector<std::string> notes;
};

/// Bytes of values, so that two that differ anywhere have different ones.
class Details {
 public:
  template <typename... T>
  void add(const T&... values) {
    (add_one(values), ...);
  }
  const std::string& text() const { return text_; }

 private:
  void add_one(const std::string& value) { text_ += std::to_string(value.size()) + " " + value; }
  void add_one(const Phase& phase) {
    add(phase.index());
    std::visit([this](const auto& kind) { this->add(kind.parameters()); }, phase);
  }
  template <typename T>
  void add_one(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  std::string text_;
};

/// Everything but the file's content that the medium is made by. All fields are named, so that a new one is asked for its part.
std::string details_of(const Medium& medium, const VdbMedium& vdb, const MediumBuildOptions& options) {
  const auto& [kind, optics, to_world, name, where, group] = medium;
  const auto& [sigma_a, sigma_s, phase] = optics;
  const auto& [path, density, temperature, flame, density_given, temperature_given, scale, offset, Le_scale, Le, emission] =
      vdb;
  Details details;
  details.add(sigma_a, sigma_s, phase, to_world.matrix());
  details.add(density, temperature, flame, density_given, temperature_given, scale, offset, Le_scale, Le, emission);
  details.add(options.sanitize, options.float_bricks);
  return details.text();
}

}  // namespace

ParticipatingMedium build_medium(const Medium& medium, const MediumBuildOptions& options, std::vector<std::string>& notes) {
  const auto* vdb = std::get_if<VdbMedium>(&medium.kind);
  if (!vdb || !options.kept)
    return ParticipatingMedium(std::make_shared<const MediumData>(build_medium_data(medium, options, notes)));
  const KeptFiles::Use use{vdb->path, "medium " + medium.name, details_of(medium, *vdb, options)};
  const auto kept = options.kept->get<KeptMedium>(use, [&] {
    KeptMedium made;
    made.data = build_medium_data(medium, options, made.notes);
    return made;
  });
  notes.insert(notes.end(), kept->notes.begin(), kept->notes.end());
  return ParticipatingMedium(std::shared_ptr<const MediumData>(kept, &kept->data));
}

}  // namespace tyndall
