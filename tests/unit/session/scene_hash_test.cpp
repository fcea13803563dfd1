#include "session/scene_hash.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <set>

#include "session/scene_fields.h"
#include "support/scratch.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;

namespace {

/// Every kind of thing a scene can hold, each once; all files named are `path`.
Scene everything(const std::string& path) {
  Scene s;
  s.camera.screen_window = {-1, 1, -1, 1};
  s.camera.frame_aspect_ratio = 1.5f;
  s.camera.medium = 0;
  s.camera.lenses.emplace().elements.emplace_back();
  s.textures = {{ConstantTexture{}, {}}, {ScaleTexture{}, {}}, {MixTexture{}, {}}, {CheckerboardTexture{}, {}}};
  using Filter = ImageTexture::Filter;
  s.textures.push_back({ImageTexture{.filter = Filter::elliptical, .path = path, .mapping = {}, .encoding = {}}, {}});
  const ConductorOptics optics{.reflectance = 0};
  s.materials = {{DiffuseMaterial{}, {}, {}},
                 {ConductorMaterial{optics, {}}, {}, {}},
                 {DielectricMaterial{}, {}, {}},
                 {ThinDielectricMaterial{}, {}, {}},
                 {DiffuseTransmissionMaterial{}, {}, {}},
                 {CoatedDiffuseMaterial{}, {}, {}},
                 {CoatedConductorMaterial{optics, {}, {}}, {}, {}},
                 {MixMaterial{}, {}, {}},
                 {InterfaceMaterial{}, {}, {}}};
  const std::vector<float> grid{1};
  const std::vector<Rgb> colors{Rgb(1.0f)};
  UniformGridMedium uniform;
  uniform.density = uniform.Le_scale = uniform.temperature = grid;
  RgbGridMedium rgb;
  rgb.sigma_a = rgb.sigma_s = rgb.Le = colors;
  VdbMedium vdb;
  vdb.path = path;
  s.media = {{HomogeneousMedium{}, {}, {}, {}, {}},
             {uniform, {}, {}, {}, {}},
             {rgb, {}, {}, {}, {}},
             {CloudMedium{}, {}, {}, {}, {}},
             {vdb, {}, {}, {}, {}}};
  s.boundaries = {{0, 0}};
  InfiniteLight sky;
  sky.path = path;
  sky.illuminance = 1.0f;
  sky.portal.emplace();
  GoniometricLight map;
  ProjectionLight image;
  map.path = image.path = path;
  map.power = image.power = 1.0f;
  s.lights = {{PointLight{}, {}}, {SpotLight{}, {}}, {DistantLight{}, {}}, {sky, {}}, {map, {}}, {image, {}}};
  AreaLight area;
  area.path = path;
  area.power = 1.0f;
  s.shapes = {{.kind = TriangleMesh{{{}}, {{}}, {{}}, {0}}, .emission = area, .boundary = 0, .alpha = 0},
              {.kind = BilinearMesh{{{}}, {{}}, {{}}, {0}}},
              {.kind = Sphere{}},
              {.kind = Disk{}},
              {.kind = Cylinder{}}};
  s.objects = {{"object", {{.kind = Sphere{}}}}};
  s.instances = {{0, {}}};
  return s;
}

/// Changes each single value below it in turn, calls `changed` with its address, and puts it back. Knows no struct:
/// what scene_fields.h knows is walked, so a new field is tested without a line here.
class Walk {
 public:
  explicit Walk(std::function<void(const void*)> changed) : changed_(std::move(changed)) {}

  template <typename T>
  void visit(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      change(value, !value);
    } else if constexpr (std::is_enum_v<T>) {
      change(value, static_cast<T>(static_cast<int>(value) + 1));
    } else if constexpr (std::is_arithmetic_v<T>) {
      change(value, std::isinf(static_cast<double>(value)) ? T{5} : static_cast<T>(value + T{1}));
    } else {
      std::apply([this](auto&... field) { (this->visit(field), ...); }, fields(value));
    }
  }
  void visit(RenderSettings&) {}  // has a test of its own
  void visit(std::string& text) { change(text, text + "x"); }
  void visit(Transform& t) { change(t, t * Transform::translate(0, 0.25, 0)); }
  void visit(Location& where) {
    visit(where.file);
    visit(where.line);
    visit(where.column);
  }
  template <typename T, std::size_t N>
  void visit(std::array<T, N>& values) {
    for (T& value : values) visit(value);
  }
  template <typename T>
  void visit(std::optional<T>& value) {
    if (value) visit(*value);
    change(value, value ? std::nullopt : std::optional<T>(T{}));
  }
  template <typename T>
  void visit(std::vector<T>& values) {
    for (T& value : values) visit(value);
    std::vector<T> longer = values;
    longer.emplace_back();
    change(values, longer);
    change(values, {});
  }
  void visit(Phase& phase) {
    for (const Phase& other : {Phase(HenyeyGreenstein{0.5f}), Phase(Rayleigh{}), Phase(Draine(0.5f, 1)), Phase(Draine(0.5f, 2)),
                               Phase(Draine(0.25f, 1)), Phase(Mie(5)), Phase(Mie(6))})
      change(phase, other);
  }
  template <typename... Kinds>
  void visit(std::variant<Kinds...>& value) {
    std::visit([this](auto& kind) { this->visit(kind); }, value);
  }

 private:
  template <typename T>
  void change(T& value, const T& to) {
    const T kept = value;
    value = to;
    changed_(&value);
    value = kept;
  }

  std::function<void(const void*)> changed_;
};

/// What may change without the right picture changing.
std::set<const void*> without_effect(Scene& s) {
  std::set<const void*> addresses{&s.source, &s.film.filename, &s.film.gbuffer};
  Walk collect([&](const void* address) { addresses.insert(address); });
  collect.visit(s.film.crop);
  if (s.camera.lenses) collect.visit(s.camera.lenses->where);
  for (Texture& t : s.textures) collect.visit(t.where);
  for (Material& m : s.materials) collect.visit(m.where), collect.visit(m.name);
  for (Medium& m : s.media) collect.visit(m.where), collect.visit(m.name);
  for (Medium& m : s.media) {
    if (auto* vdb = std::get_if<VdbMedium>(&m.kind)) collect.visit(vdb->emission_given);
  }
  for (Light& l : s.lights) collect.visit(l.where);
  for (Shape& shape : s.shapes) collect.visit(shape.where), collect.visit(shape.name);
  for (Object& o : s.objects) {
    collect.visit(o.name);
    for (Shape& shape : o.shapes) collect.visit(shape.where), collect.visit(shape.name);
  }
  return addresses;
}

}  // namespace

TEST_CASE("every value of a scene counts, but for names, places in files, crop and paths") {
  const test::Scratch scratch;
  const std::string path = scratch / "asset", moved = path + "x";
  test::write_bytes(path, "some content");
  test::write_bytes(moved, "other content");
  Scene scene = everything(path);
  const std::set<const void*> ignored = without_effect(scene);
  std::set<std::uint64_t> seen{hash_scene(scene)};
  const std::uint64_t base = *seen.begin();

  int changes = 0, missed = 0, wrong = 0;
  Walk walk([&](const void* address) {
    const std::uint64_t value = hash_scene(scene);
    if (ignored.contains(address)) {
      wrong += value != base ? 1 : 0;
    } else {
      ++changes;
      missed += seen.insert(value).second ? 0 : 1;  // neither the base's nor that of any other change
    }
  });
  walk.visit(scene);
  CHECK(wrong == 0);
  CHECK(missed == 0);
  CHECK(changes > 400);
  CHECK(hash_scene(scene) == base);

  // The walk led each path to a file of other content. One of the same content is the same scene.
  test::write_bytes(moved, "some content");
  CHECK(hash_scene(everything(moved)) == base);
  test::write_bytes(path, "some Content");
  CHECK(hash_scene(scene) != base);
}

TEST_CASE("another kind of the same thing is another scene") {
  std::set<std::uint64_t> seen;
  for (std::size_t i = 0; i < 3; ++i) {
    Scene scene;
    const decltype(Shape::kind) kinds[] = {Disk{}, Cylinder{}, Sphere{}};
    scene.shapes.push_back({.kind = kinds[i]});
    seen.insert(hash_scene(scene));
  }
  CHECK(seen.size() == 3);
}

TEST_CASE("each kind of camera is another scene, and the first has the hash that it always had") {
  std::set<std::uint64_t> seen;
  using Kind = Camera::Kind;
  for (const Kind kind : {Kind::perspective, Kind::orthographic, Kind::spherical_equal_area, Kind::spherical_equirectangular}) {
    Scene scene;
    scene.camera.kind = kind;
    seen.insert(hash_scene(scene));
  }
  Scene scene;
  scene.camera.kind = Kind::realistic;
  for (const float radius : {0.1f, 0.2f}) {
    scene.camera.lenses = Lenses{};
    scene.camera.lenses->elements = {{radius, 1, 1.5f, 1}};
    seen.insert(hash_scene(scene));
  }
  CHECK(seen.size() == 6);
  CHECK(hash_scene(Scene{}) == 5435084645036978678u);
}

TEST_CASE("a file that is gone is named") {
  CHECK_THROWS_WITH_AS(hash_scene(everything("/no/such/asset")), doctest::Contains("/no/such/asset: cannot be opened"), Error);
}

TEST_CASE("a built world and its images carry the hash; only the depth of the settings enters") {
  const std::string text = R"(Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    WorldBegin LightSource "point" "rgb I" [1 2 3] Shape "sphere" "float radius" 0.5)";
  const World world = build(read_scene_text(text, "a.pbrt", "here").scene);
  const World moved =
      build(read_scene_text("# a comment\n" + text, "b.pbrt", "there").scene, {.lights = {LightStrategy::power}});
  const RenderSettings plain;
  const std::string hash = world.scene_hash(plain);
  CHECK(hash.size() == 16);
  CHECK(hash == moved.scene_hash({.spp = 3,
                                  .time = 2.0,
                                  .seed = 9,
                                  .threads = 2,
                                  .lights = LightStrategy::power,
                                  .transmittance = TransmittanceStrategy::ratio,
                                  .aovs = {"N"},
                                  .crop = PixelBounds{0, 0, 1, 1},
                                  .reproducible = true}));
  CHECK(hash != world.scene_hash({.max_depth = 6}));
  const Image image = render(world, {.spp = 1}).image;
  CHECK(std::get<std::string>(image.attributes.at("tyndall/sceneHash")) == hash);
}
