/// From the scene's description of a medium to one that can be tracked.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "math/hash.h"
#include "tyndall/error.h"
#include "volume/brick_builder.h"
#include "volume/medium.h"
#include "volume/medium_data.h"
#include "volume/vdb_medium.h"

namespace tyndall {
namespace {

struct BuildContext {
  const Medium& medium;
  const MediumBuildOptions& options;
  std::vector<std::string>& notes;

  std::string name() const { return "medium \"" + medium.name + "\""; }
  [[noreturn]] void fail(const std::string& what) const { throw Error(medium.where, name() + ": " + what); }
};

std::string shortest(double v) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", v);
  return text.data();
}

Box3d box_of(const Bounds3& b) { return {{{b.min.x, b.min.y, b.min.z}}, {{b.max.x, b.max.y, b.max.z}}}; }

GridVec to_vec3d(const Index3& i) {
  return {{static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])}};
}

/// World box of the box [lo, hi] + offset of index space, rounded outward.
Bounds3 world_bounds(const Transform& index_to_world, const Box3d& box, const GridVec& offset) {
  Bounds3 result;
  if (box.empty()) return result;
  const Transform::Matrix& m = index_to_world.matrix();
  for (int i = 0; i < 3; ++i) {
    const std::size_t row = static_cast<std::size_t>(i);
    double lo = m[row][3], hi = m[row][3];
    for (int j = 0; j < 3; ++j) {
      const double a = m[row][static_cast<std::size_t>(j)] * (box.lo[j] + offset[j]);
      const double b = m[row][static_cast<std::size_t>(j)] * (box.hi[j] + offset[j]);
      lo += std::min(a, b);
      hi += std::max(a, b);
    }
    result.min[i] = static_cast<float>(lo);
    result.max[i] = static_cast<float>(hi);
    if (result.min[i] > lo) result.min[i] = std::nextafter(result.min[i], -kInfinity);
    if (result.max[i] < hi) result.max[i] = std::nextafter(result.max[i], kInfinity);
  }
  return result;
}

// ---------------------------------------------------------------------------------------- homogeneous, cloud

void build(const HomogeneousMedium& homogeneous, const BuildContext&, MediumData& data) {
  data.kind = MediumData::Kind::homogeneous;
  data.bounds = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  if (is_black(homogeneous.Le)) return;
  data.emission.kind = EmissionField::Kind::constant;
  data.emission.Le = homogeneous.Le;
}

void build(const CloudMedium& cloud, const BuildContext& context, MediumData& data) {
  data.kind = MediumData::Kind::cloud;
  data.cloud = cloud;
  data.clip = box_of(cloud.bounds);
  data.density.to_local = Affine::of(context.medium.to_world.inverse());
  data.bounds = world_bounds(context.medium.to_world, data.clip, {});

  constexpr std::uint64_t kSamples = 4096;
  const Vec3 extent = cloud.bounds.extent();
  double sum = 0;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const auto uniform = [&](std::uint64_t axis) { return unit_float(hash(i, axis)); };
    sum += cloud_density(cloud, cloud.bounds.min + extent * Vec3{uniform(0), uniform(1), uniform(2)});
  }
  data.cloud_mean = static_cast<float>(sum / kSamples);
}

// --------------------------------------------------------------------------------------------- dense grids

/// Samples at the centres of nx*ny*nz equal cells of a box, index 0 being the first sample.
class CellGrid {
 public:
  CellGrid(const BuildContext& context, const Bounds3& bounds, int nx, int ny, int nz) : context_(context), size_{nx, ny, nz} {
    const Vec3 e = bounds.extent();
    if (!(e.x > 0 && e.y > 0 && e.z > 0)) context.fail("its box p0 p1 has no volume; give it two different corners");
    if (nx < 1 || ny < 1 || nz < 1) context.fail("nx, ny and nz must be at least 1");
    const Transform cells = Transform::translate(-0.5, -0.5, -0.5) *
                            Transform::scale(nx / double{e.x}, ny / double{e.y}, nz / double{e.z}) *
                            Transform::translate(-bounds.min.x, -bounds.min.y, -bounds.min.z);
    world_to_index_ = cells * context.medium.to_world.inverse();
  }

  std::size_t count() const { return std::size_t(size_[0]) * std::size_t(size_[1]) * std::size_t(size_[2]); }
  const std::array<int, 3>& size() const { return size_; }
  const Transform& world_to_index() const { return world_to_index_; }
  /// The box in the index space of `grid`, relative to its origin.
  Box3d box(const BrickGrid& grid) const {
    Box3d b;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      const auto origin = static_cast<double>(grid.origin()[axis]);
      b.lo[i] = -0.5 - origin;
      b.hi[i] = size_[axis] - 0.5 - origin;
    }
    return b;
  }

  /// `planes`: one array of count() a channel. The grid is empty if all are 0.
  PlacedGrid place(std::vector<std::vector<float>> planes, const std::string& what, bool negative_to_zero = true) const {
    for (const std::vector<float>& plane : planes)
      if (plane.size() != count())
        context_.fail("has " + std::to_string(plane.size()) + " values of " + what + "; nx*ny*nz is " +
                      std::to_string(count()));
    return place(DenseSource(size_, std::move(planes)), what, negative_to_zero);
  }
  PlacedGrid place(const DenseSource& source, const std::string& what, bool negative_to_zero, const Index3& first = {}) const {
    const VoxelRules rules{negative_to_zero, context_.options.sanitize, std::nullopt, {}};
    const VoxelReport found = inspect(source, rules);
    if (found.non_finite > 0 && !rules.sanitize)
      context_.fail(std::to_string(found.non_finite) + " values of " + what +
                    " are NaN or infinite; --sanitize sets them to 0");
    if (found.negative > 0 && negative_to_zero)
      context_.notes.push_back("warning: " + context_.name() + ": " + std::to_string(found.negative) + " negative values of " +
                               what + " (lowest " + std::to_string(found.lowest) + ") were set to 0");
    PlacedGrid placed;
    placed.grid = build_brick_grid(source, {rules, context_.options.float_bricks});
    GridVec offset = to_vec3d(placed.grid.origin());
    for (int i = 0; i < 3; ++i) offset[i] += static_cast<double>(first[static_cast<std::size_t>(i)]);
    placed.to_local = Affine::of(world_to_index_).minus(offset);
    return placed;
  }

 private:
  const BuildContext& context_;
  std::array<int, 3> size_;
  Transform world_to_index_;
};

void finish_grid(const Transform& index_to_world, const Box3d& clip, const GridVec& origin, MediumData& data) {
  data.kind = MediumData::Kind::grid;
  data.clip = clip;
  data.bounds = world_bounds(index_to_world, clip, origin);
}

/// Whether temperatures between the extremes of `grid` emit at all.
bool emits(const PlacedGrid& grid, float scale, float offset) {
  const ValueRange range = grid.grid.range();
  return std::max((range.min - offset) * scale, (range.max - offset) * scale) > BlackbodyTable::kMin;
}

/// A temperature gives colour and radiance by itself.
void warn_of_Le(const BuildContext& context) {
  context.notes.push_back("warning: " + context.name() +
                          ": Le is ignored beside temperatures; leave out either, or use Lescale");
}

void build(const UniformGridMedium& uniform, const BuildContext& context, MediumData& data) {
  const CellGrid cells(context, uniform.bounds, uniform.nx, uniform.ny, uniform.nz);
  data.density = cells.place({uniform.density}, "density");
  const BrickGrid& grid = data.density.grid;
  finish_grid(cells.world_to_index().inverse(), overlap(grid.support(), cells.box(grid)), to_vec3d(grid.origin()), data);

  EmissionField& emission = data.emission;
  emission.factor = uniform.Le_factor;
  if (!(uniform.Le_factor > 0)) return;
  if (!uniform.temperature.empty()) {
    if (!is_black(uniform.Le)) warn_of_Le(context);
    emission.values = cells.place({uniform.temperature}, "temperature", false);
    emission.temperature_scale = uniform.temperature_scale;
    emission.temperature_offset = uniform.temperature_offset;
    if (emits(*emission.values, uniform.temperature_scale, uniform.temperature_offset))
      emission.kind = EmissionField::Kind::blackbody;
  } else if (!is_black(uniform.Le)) {
    emission.Le = uniform.Le;
    emission.kind = EmissionField::Kind::constant;
  }
  if (emission.kind != EmissionField::Kind::none && !uniform.Le_scale.empty())
    emission.scale = cells.place({uniform.Le_scale}, "Lescale");
}

/// Three planes of `values`; of ones in and around the box when there are none.
void append_planes(const std::vector<Rgb>& values, const std::array<int, 3>& size, std::vector<std::vector<float>>& planes) {
  const std::array<int, 3> padded{size[0] + 2, size[1] + 2, size[2] + 2};
  const std::size_t count = std::size_t(padded[0]) * std::size_t(padded[1]) * std::size_t(padded[2]);
  for (int c = 0; c < 3; ++c) {
    std::vector<float> plane(count, values.empty() ? 1.0f : 0.0f);
    std::size_t from = 0;
    for (int z = 0; z < size[2] && !values.empty(); ++z)
      for (int y = 0; y < size[1]; ++y)
        for (int x = 0; x < size[0]; ++x)
          plane[(static_cast<std::size_t>(z + 1) * std::size_t(padded[1]) + static_cast<std::size_t>(y + 1)) *
                    std::size_t(padded[0]) +
                static_cast<std::size_t>(x + 1)] = values[from++][c];
    planes.push_back(std::move(plane));
  }
}

void build(const RgbGridMedium& rgb, const BuildContext& context, MediumData& data) {
  const CellGrid cells(context, rgb.bounds, rgb.nx, rgb.ny, rgb.nz);
  for (const std::vector<Rgb>* values : {&rgb.sigma_a, &rgb.sigma_s, &rgb.Le})
    if (!values->empty() && values->size() != cells.count())
      context.fail("has " + std::to_string(values->size()) + " colours in a grid; nx*ny*nz is " +
                   std::to_string(cells.count()));

  // One layer more on every side: where a coefficient is not given it is 1 right up to the faces of the box.
  const std::array<int, 3> padded{rgb.nx + 2, rgb.ny + 2, rgb.nz + 2};
  std::vector<std::vector<float>> planes;
  append_planes(rgb.sigma_a, cells.size(), planes);
  append_planes(rgb.sigma_s, cells.size(), planes);
  const Index3 first{-1, -1, -1};
  data.density = cells.place(DenseSource(padded, std::move(planes)), "sigma", true, first);
  data.optics.sigma_a = data.optics.sigma_s = Rgb{rgb.scale};
  const BrickGrid& grid = data.density.grid;
  Box3d box = cells.box(grid);
  GridVec origin = to_vec3d(grid.origin());
  for (int i = 0; i < 3; ++i) {
    box.lo[i] += 1;
    box.hi[i] += 1;
    origin[i] -= 1;
  }
  finish_grid(cells.world_to_index().inverse(), overlap(grid.support(), box), origin, data);

  if (rgb.Le.empty()) return;
  std::vector<std::vector<float>> emitted(3);
  for (const Rgb& Le : rgb.Le)
    for (int c = 0; c < 3; ++c) emitted[static_cast<std::size_t>(c)].push_back(Le[c]);
  data.emission.values = cells.place(std::move(emitted), "Le");
  if (!data.emission.values->grid.empty()) data.emission.kind = EmissionField::Kind::rgb_grid;
}

// ------------------------------------------------------------------------------------------------------ vdb

void build(const VdbMedium& vdb, const BuildContext& context, MediumData& data) {
  VdbGrids grids = load_vdb_grids(context.medium, vdb, context.options, context.notes);
  const Box3d clip = grids.density.grid.support();
  finish_grid(grids.density_to_world, clip, to_vec3d(grids.density.grid.origin()), data);
  data.density = std::move(grids.density);

  EmissionField& emission = data.emission;
  emission.factor = vdb.Le_scale;
  if (!(vdb.Le_scale > 0)) return;
  const bool hot = grids.temperature && emits(*grids.temperature, vdb.temperature_scale, vdb.temperature_offset);
  const bool burns = grids.flame && !grids.flame->grid.empty();
  if (grids.flame && !burns) return;
  if (hot) {
    if (vdb.Le != Rgb(1.0f)) warn_of_Le(context);
    emission.kind = EmissionField::Kind::blackbody;
    emission.values = std::move(grids.temperature);
    emission.temperature_scale = vdb.temperature_scale;
    emission.temperature_offset = vdb.temperature_offset;
  } else if (burns && !is_black(vdb.Le)) {
    emission.kind = EmissionField::Kind::constant;
    emission.Le = vdb.Le;
  }
  if (burns && emission.kind != EmissionField::Kind::none) emission.scale = std::move(grids.flame);
  if (emission.kind == EmissionField::Kind::none && vdb.emission_given)
    context.notes.push_back("warning: " + context.name() +
                            ": emits nothing, as all temperatures of its file are too low; scale them, or name a flame grid");
}

/// Denormals are flushed to zero while rendering, and what lies near the largest float overflows: a medium that comes to
/// something only as the product of two such numbers would vanish without a word.
void require_range(const BuildContext& context, const MediumData& data) {
  if (data.kind != MediumData::Kind::grid) return;
  constexpr float kLeast = 0x1p-104f, kMost = 0x1p120f;
  const auto fits = [](float v) { return v >= kLeast && v <= kMost; };
  const bool is_rgb = std::holds_alternative<RgbGridMedium>(context.medium.kind);
  const auto refuse = [&](float density, const char* sigma, float most) {
    const std::string values = is_rgb ? "values of sigma_a and sigma_s up to " : "densities up to ";
    const std::string factor = is_rgb ? "a scale" : std::string("scale * ") + sigma;
    context.fail(values + shortest(density) + " times " + factor + " of " + shortest(most / context.options.unit) +
                 " cannot be reckoned with; bring both nearer to 1");
  };
  for (int channel = 0; channel < data.density.grid.channels(); ++channel) {
    const float density = data.density.grid.range(channel).max;
    for (const auto& [name, sigma] : {std::pair{"sigma_a", data.optics.sigma_a}, {"sigma_s", data.optics.sigma_s}}) {
      const float most = max_component(sigma);
      if (double{density} * most > 1e-9 && !(fits(density) && fits(most) && fits(density * most))) refuse(density, name, most);
    }
  }
}

}  // namespace

MediumData build_medium_data(const Medium& medium, const MediumBuildOptions& options, std::vector<std::string>& notes) {
  const BuildContext context{medium, options, notes};
  MediumData data;
  data.optics = medium.optics;
  std::visit([&](const auto& kind) { build(kind, context, data); }, medium.kind);
  require_range(context, data);
  // What cannot absorb cannot emit either.
  if (is_black(data.optics.sigma_a)) data.emission = {};
  if (data.emission.kind == EmissionField::Kind::blackbody) data.emission.table.emplace();
  return data;
}

}  // namespace tyndall
