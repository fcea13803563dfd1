#include "volume/vdb_medium.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "tyndall/error.h"
#include "volume/brick_builder.h"
#include "volume/vdb_file.h"

namespace tyndall {
namespace {

using Names = std::vector<std::string>;

const Names kDensityAliases{"density", "smoke", "fog"};
const Names kTemperatureAliases{"temperature", "heat"};
const Names kFlameAliases{"flame", "flames", "fire", "burn"};

/// Another name of the same thing may stand in for an expected one, never for a particular one that was asked for.
Names stand_ins(const std::string& name, bool given, const Names& aliases) {
  return !given || std::find(aliases.begin(), aliases.end(), name) != aliases.end() ? aliases : Names{};
}

std::string in_quotes(const std::string& name) { return "\"" + printable(name) + "\""; }

/// Finds, checks and converts the grids of one file.
class GridLoader {
 public:
  GridLoader(const Medium& medium, const std::string& path, const MediumBuildOptions& options, std::vector<std::string>& notes)
      : medium_(medium), path_(path), options_(options), notes_(notes), file_(open()) {}

  /// Index of the grid called `name`, else of the first alias there is. "density[1]" is the second of that name.
  std::optional<std::size_t> find(const std::string& name, const Names& aliases) {
    if (std::optional<std::size_t> exact = find_name(name)) return exact;
    for (const std::string& alias : aliases)
      if (std::optional<std::size_t> other = find_name(alias)) return other;
    return std::nullopt;
  }

  /// The only grid that can be a density, whatever its name.
  std::optional<std::size_t> only_fog() const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < file_->grids().size(); ++i) {
      const VolumeGridEntry& grid = file_->grids()[i];
      if (grid.values != VolumeGridEntry::Values::scalar || grid.level_set) continue;
      if (found) return std::nullopt;
      found = i;
    }
    return found;
  }

  const VolumeGridEntry& entry(std::size_t grid) const { return file_->grids()[grid]; }

  struct Use {
    std::string role;
    bool vectors = false;    ///< a vec3 grid will do
    bool level_set = false;  ///< so will a level set
    bool negative_to_zero = true;
  };
  PlacedGrid load(std::size_t index, const Use& use, Transform* to_world = nullptr) {
    refuse_unfit(entry(index), use);
    refuse_large(entry(index));
    const VolumeGrid grid = file_->load(index);
    const VoxelRules rules{use.negative_to_zero, options_.sanitize, grid.clip, grid.background};
    report(entry(index), inspect(*grid.source, rules), rules);
    const Transform index_to_world = medium_.to_world * grid.index_to_world;
    if (to_world) *to_world = index_to_world;
    PlacedGrid placed;
    placed.grid = build_bricks(entry(index), *grid.source, rules);
    taken_ += placed.grid.memory_bytes();
    if (placed.grid.empty()) note(use.role + " grid " + in_quotes(entry(index).name) + " is empty");
    const Index3& origin = placed.grid.origin();
    placed.to_local =
        Affine::of(index_to_world.inverse())
            .minus({{static_cast<double>(origin[0]), static_cast<double>(origin[1]), static_cast<double>(origin[2])}});
    return placed;
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(medium_.where, path_ + ": " + what); }
  void note(const std::string& what) { notes_.push_back(std::filesystem::path(path_).filename().string() + ": " + what); }
  std::string listing() const {
    std::string names;
    for (const VolumeGridEntry& grid : file_->grids())
      names += (names.empty() ? "" : ", ") + in_quotes(grid.name) + " (" + grid.type + ")";
    return names.empty() ? "no grids" : names;
  }

 private:
  std::unique_ptr<VolumeFile> open() const {
    try {
      return open_volume(path_, options_.most_memory);
    } catch (const Error& e) {
      throw Error(medium_.where, e.what());
    }
  }

  std::optional<std::size_t> find_name(const std::string& name) {
    const std::vector<std::size_t> exact = all_called(name);
    if (!exact.empty()) {
      if (exact.size() > 1)
        note(std::to_string(exact.size()) + " grids are called " + in_quotes(name) + "; the first is used, write " +
             in_quotes(name + "[1]") + " for the second");
      return exact.front();
    }
    const std::size_t bracket = name.rfind('[');
    if (bracket == std::string::npos || name.back() != ']') return std::nullopt;
    const std::string digits = name.substr(bracket + 1, name.size() - bracket - 2);
    if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    const std::vector<std::size_t> same = all_called(name.substr(0, bracket));
    const auto which = static_cast<std::size_t>(std::stoul(digits));
    return which < same.size() ? std::optional(same[which]) : std::nullopt;
  }
  /// By their names, else by what these look like in messages.
  std::vector<std::size_t> all_called(const std::string& name) const {
    const auto found_by = [&](const auto& name_of) {
      std::vector<std::size_t> found;
      for (std::size_t i = 0; i < file_->grids().size(); ++i)
        if (name_of(file_->grids()[i].name) == name) found.push_back(i);
      return found;
    };
    std::vector<std::size_t> found = found_by([](const std::string& true_name) { return true_name; });
    return found.empty() ? found_by(printable) : found;
  }

  void refuse_unfit(const VolumeGridEntry& grid, const Use& use) const {
    const std::string who = use.role + " grid " + in_quotes(grid.name);
    if (grid.values == VolumeGridEntry::Values::other)
      fail(who + " is of type " + grid.type + ", which holds no density; name a float or vec3 grid of: " + listing());
    if (grid.values == VolumeGridEntry::Values::vector && !use.vectors)
      fail(who + " is of type " + grid.type + "; it must hold one number a voxel");
    if (grid.level_set && !use.level_set)
      fail(who +
           " is a level set, a surface; convert it to a fog volume (OpenVDB's sdfToFogVolume, Houdini's VDB Convert) or mesh "
           "it");
    if (!grid.linear) fail(who + " has a frustum transform; resample it to a linear one");
  }

  std::size_t left() const { return options_.most_memory - std::min(taken_, options_.most_memory); }
  static double values_of(const VolumeGridEntry& grid) {
    const double channels = grid.values == VolumeGridEntry::Values::vector ? 3 : 1;
    return static_cast<double>(grid.leaves) * VoxelSource::kLeafVoxels * channels;
  }

  /// The voxels while they are read, and the bricks made of them.
  void refuse_large(const VolumeGridEntry& grid) const {
    constexpr double kBricks = 3;
    const double bytes = values_of(grid) * (static_cast<double>(grid.read_bytes) + kBricks);
    if (bytes > static_cast<double>(left()))
      fail_large("grid " + in_quotes(grid.name) + " is estimated to need " + gigabytes(bytes) + " of memory");
  }
  /// Only leaves are known before: boxes of one value, and what lies alone, make bricks too.
  BrickGrid build_bricks(const VolumeGridEntry& grid, const VoxelSource& source, const VoxelRules& rules) const {
    const double most = std::max(0.0, static_cast<double>(left()) - values_of(grid) * static_cast<double>(grid.read_bytes));
    try {
      return build_brick_grid(source, {rules, options_.float_bricks, static_cast<std::size_t>(std::min(most, 0x1p62))});
    } catch (const GridTooLarge&) {
      fail_large("grid " + in_quotes(grid.name) + " becomes more bricks than " + gigabytes(most) + " of memory hold");
    }
  }
  static std::string gigabytes(double bytes) { return std::to_string(bytes * 1e-9) + " GB"; }
  [[noreturn]] void fail_large(const std::string& what) const {
    fail(what + " where only " + gigabytes(static_cast<double>(left())) +
         " are left; raise --max-memory or use a coarser volume");
  }

  void report(const VolumeGridEntry& grid, const VoxelReport& found, const VoxelRules& rules) {
    if (found.non_finite > 0) {
      const Index3& i = found.first_non_finite;
      const std::string what = "grid " + in_quotes(grid.name) + ": " + std::to_string(found.non_finite) +
                               " voxels are NaN or infinite, the first at index (" + std::to_string(i[0]) + ", " +
                               std::to_string(i[1]) + ", " + std::to_string(i[2]) + ")";
      if (!rules.sanitize) fail(what + "; --sanitize sets them to 0");
      note(what + "; they were set to 0");
    }
    if (found.negative > 0 && rules.negative_to_zero)
      note("warning: grid " + in_quotes(grid.name) + ": " + std::to_string(found.negative) + " negative voxels (lowest " +
           std::to_string(found.lowest) + ") were set to 0");
  }

  const Medium& medium_;
  const std::string& path_;
  const MediumBuildOptions& options_;
  std::vector<std::string>& notes_;
  std::unique_ptr<VolumeFile> file_;
  std::size_t taken_ = 0;  // bytes of the grids made so far
};

std::size_t density_index(GridLoader& loader, const VdbMedium& vdb) {
  if (const auto found = loader.find(vdb.density_grid, stand_ins(vdb.density_grid, vdb.density_grid_given, kDensityAliases)))
    return *found;
  if (vdb.density_grid_given) loader.fail("has no grid " + in_quotes(vdb.density_grid) + "; it holds " + loader.listing());
  if (const auto only = loader.only_fog()) return *only;
  loader.fail("has no grid called density, smoke or fog; name one with \"string gridname\" of: " + loader.listing());
}

}  // namespace

VdbGrids load_vdb_grids(const Medium& medium, const VdbMedium& vdb, const MediumBuildOptions& options,
                        std::vector<std::string>& notes) {
  GridLoader loader(medium, vdb.path, options, notes);
  VdbGrids grids;
  const std::size_t density = density_index(loader, vdb);
  std::string chosen = "density grid " + in_quotes(loader.entry(density).name);
  grids.density = loader.load(density, {.role = "density", .vectors = true}, &grids.density_to_world);

  const auto temperature =
      loader.find(vdb.temperature_grid, stand_ins(vdb.temperature_grid, vdb.temperature_grid_given, kTemperatureAliases));
  if (!temperature && vdb.temperature_grid_given)
    loader.fail("has no grid " + in_quotes(vdb.temperature_grid) + "; it holds " + loader.listing());
  // One that was not asked for by name stops nothing.
  if (temperature && (vdb.temperature_grid_given || vdb.Le_scale > 0)) {
    const VolumeGridEntry& entry = loader.entry(*temperature);
    const bool fits = entry.values == VolumeGridEntry::Values::scalar && entry.linear;
    if (fits || vdb.temperature_grid_given) {
      chosen += ", temperature grid " + in_quotes(entry.name);
      grids.temperature = loader.load(*temperature, {.role = "temperature", .level_set = true, .negative_to_zero = false});
    } else {
      loader.note("temperature grid " + in_quotes(entry.name) + " is passed over: it holds no numbers, or in a frustum");
    }
  }
  if (!vdb.flame_grid.empty()) {
    const auto flame = loader.find(vdb.flame_grid, stand_ins(vdb.flame_grid, true, kFlameAliases));
    if (!flame) loader.fail("has no grid " + in_quotes(vdb.flame_grid) + "; it holds " + loader.listing());
    chosen += ", flame grid " + in_quotes(loader.entry(*flame).name);
    grids.flame = loader.load(*flame, {.role = "flame"});
  }
  loader.note(chosen);
  return grids;
}

}  // namespace tyndall
