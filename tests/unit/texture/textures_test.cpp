#include <doctest/doctest.h>

#include <cmath>

#include "support/scratch.h"
#include "texture/textures.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

using namespace tyndall;
using doctest::Approx;

namespace {

Texture texture(decltype(Texture::kind) kind) { return {std::move(kind), Location{"scene.pbrt", 7, 3}}; }
Texture constant(float v) { return texture(ConstantTexture{Rgb(v)}); }

/// 2 x 2: black, red / green, blue; the rows from the top.
void write_corners(const std::string& path) {
  Image image;
  image.data = image.display = {0, 0, 2, 2};
  image.channels = {{"R", {0, 1, 0, 0}}, {"G", {0, 0, 1, 0}}, {"B", {0, 0, 0, 1}}};
  write_exr(image, path);
}

ImageTexture image_texture(const std::string& path) {
  ImageTexture t;
  t.path = path;
  t.filter = ImageTexture::Filter::point;
  return t;
}

std::string reason(const std::vector<Texture>& textures) {
  try {
    build_textures(textures);
  } catch (const Error& error) {
    CHECK(error.failure() == Failure::scene);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("scale and mix of constants fold to constants, in any order of definition") {
  const Textures t = build_textures(
      {texture(MixTexture{1, 2, 3}), constant(1), constant(3), constant(0.25f), texture(ScaleTexture{0, 5}), constant(2)});
  CHECK(t.constant(0) == Rgb(1.5f));
  CHECK(t.constant(4) == Rgb(3.0f));
  const Textures s = build_textures({texture(ScaleTexture{1, 2}), texture(ScaleTexture{2, 2}), constant(3)});
  CHECK(s.constant(0) == Rgb(27.0f));
  CHECK(s.eval_float(0, {}) == 27.0f);
}

TEST_CASE("numbers of images may be negative, colours not; as in pbrt-v4") {
  const test::Scratch folder;
  Image image;
  image.data = image.display = {0, 0, 1, 1};
  image.channels = {{"Y", {-0.5f}}};
  write_exr(image, folder / "below.exr");
  ImageTexture inverted = image_texture(folder / "below.exr");
  inverted.invert = true;
  const Textures t = build_textures({texture(image_texture(folder / "below.exr")), texture(inverted)});
  CHECK(t.eval_float(0, {{0.5f, 0.5f}, {}}) == -0.5f);
  CHECK(t.eval_float(1, {{0.5f, 0.5f}, {}}) == 1.5f);
  CHECK(t.eval(0, {{0.5f, 0.5f}, {}}) == Rgb());
}

TEST_CASE("a checkerboard alternates from the cell at the origin, in 2D and 3D") {
  CheckerboardTexture board{2, {}, 1, 2};
  board.mapping.scale = {4, 2};
  const Textures t = build_textures({texture(board), constant(1), constant(5)});
  CHECK_FALSE(t.is_constant(0));
  CHECK(t.eval(0, {{0.1f, 0.1f}, {}}) == Rgb(1.0f));
  CHECK(t.eval(0, {{0.3f, 0.1f}, {}}) == Rgb(5.0f));
  CHECK(t.eval(0, {{0.3f, 0.6f}, {}}) == Rgb(1.0f));
  CHECK(t.eval(0, {{-0.1f, 0.1f}, {}}) == Rgb(5.0f));
  CHECK(t.eval_float(0, {{-0.1f, -0.1f}, {}}) == 1.0f);

  CheckerboardTexture cubes{3, {}, 1, 2};
  cubes.mapping.to_texture = Transform::translate(0, 0, 1);
  const Textures c = build_textures({texture(cubes), constant(1), constant(5)});
  CHECK(c.eval(0, {{}, {0.5f, 0.5f, 0.5f}}) == Rgb(5.0f));  // z is 1.5 there
  CHECK(c.eval(0, {{}, {0.5f, -0.5f, 0.5f}}) == Rgb(1.0f));
  CHECK(c.eval(0, {{}, {-0.5f, -0.5f, -0.5f}}) == Rgb(1.0f));
  CHECK(c.eval(0, {{}, {-0.5f, 1.5f, 2.5f}}) == Rgb(5.0f));
}

TEST_CASE("v points up: the image's top row lies at v near 1") {
  const test::Scratch folder;
  write_corners(folder / "a.exr");
  const Textures t = build_textures({texture(image_texture(folder / "a.exr"))});
  CHECK(t.eval(0, {{0.25f, 0.75f}, {}}) == Rgb());
  CHECK(t.eval(0, {{0.75f, 0.75f}, {}}) == Rgb(1, 0, 0));
  CHECK(t.eval(0, {{0.25f, 0.25f}, {}}) == Rgb(0, 1, 0));
  CHECK(t.eval(0, {{0.75f, 0.25f}, {}}) == Rgb(0, 0, 1));
  CHECK(t.eval(0, {{1.75f, -0.75f}, {}}) == Rgb(0, 0, 1));
}

TEST_CASE("scale comes before invert, and negative results are black") {
  const test::Scratch folder;
  write_corners(folder / "a.exr");
  ImageTexture t = image_texture(folder / "a.exr");
  t.filter = ImageTexture::Filter::bilinear;
  t.scale = 2;
  t.invert = true;
  const Textures textures = build_textures({texture(t)});
  CHECK(textures.eval(0, {{0.75f, 0.75f}, {}}) == Rgb(0, 1, 1));
  CHECK(textures.eval_float(0, {{0.75f, 0.75f}, {}}) == Approx(1 - 2 / 3.0));
  CHECK(textures.eval_float(0, {{0.25f, 0.75f}, {}}) == 1.0f);
}

TEST_CASE("the colour space's matrix applies to colours, not to scalars") {
  const test::Scratch folder;
  write_corners(folder / "a.exr");
  ImageTexture t = image_texture(folder / "a.exr");
  t.filter = ImageTexture::Filter::bilinear;
  t.to_rec709 = {1, -1, 0, 0, 0.5f, 0, 0, 0, 1};
  const Textures textures = build_textures({texture(t)});
  CHECK(textures.eval(0, {{0.25f, 0.25f}, {}}) == Rgb(0, 0.5f, 0));  // red would be -1
  CHECK(textures.eval_float(0, {{0.25f, 0.25f}, {}}) == Approx(1 / 3.0));
}

// Filters and channels as in pbrt-v4.
TEST_CASE("scalars of an image are its alpha where it has any; else the mean of its colour, or the first channel") {
  const test::Scratch folder;
  Image image;
  image.data = image.display = {0, 0, 2, 1};
  image.channels = {{"R", {0.5f, 1}}, {"G", {1, 1}}, {"B", {1, 1}}, {"A", {0.25f, 1}}};
  write_exr(image, folder / "leaf.exr");
  image.channels.pop_back();
  write_exr(image, folder / "wall.exr");
  const TextureQuery first{{0.25f, 0.5f}, {}};
  using Filter = ImageTexture::Filter;
  for (const Filter filter : {Filter::point, Filter::bilinear, Filter::trilinear, Filter::elliptical}) {
    ImageTexture leaf = image_texture(folder / "leaf.exr"), wall = image_texture(folder / "wall.exr");
    leaf.filter = wall.filter = filter;
    const Textures t = build_textures({texture(leaf), texture(wall)});
    const bool knows_all = filter == Filter::bilinear || filter == Filter::trilinear;
    CHECK(t.eval_float(0, first) == Approx(knows_all ? 0.25 : 0.5));
    CHECK(t.eval_float(1, first) == Approx(knows_all ? 2.5 / 3 : 0.5));
    CHECK(t.eval(0, first) == t.eval(1, first));
  }
}

TEST_CASE("textures of one file share its image, whatever else differs") {
  const test::Scratch folder;
  write_corners(folder / "a.exr");
  write_corners(folder / "b.exr");
  ImageTexture a = image_texture(folder / "a.exr"), bright = a, b = image_texture(folder / "b.exr"), linear = a;
  bright.scale = 2;
  linear.encoding = "linear";
  const Textures t = build_textures({texture(a), texture(bright), texture(b), texture(linear)});
  CHECK(t.image_count() == 3);
  CHECK(t.eval(1, {{0.75f, 0.75f}, {}}) == Rgb(2, 0, 0));
  CHECK(t.memory_bytes() == 3 * 4 * sizeof(Rgb));
}

TEST_CASE("mappings of points: spherical, cylindrical, planar") {
  TextureMapping m;
  m.kind = TextureMapping::Kind::spherical;
  const auto at = [&](Vec3 p) { return map_to_texture(m, {{9, 9}, p}); };
  CHECK(at({0, 0, 2}).x == Approx(0));
  CHECK(at({0, 3, 0}).x == Approx(0.5));
  CHECK(at({0, 3, 0}).y == Approx(0.25));
  CHECK(at({0, -3, 0}).y == Approx(0.75));
  m.kind = TextureMapping::Kind::cylindrical;
  CHECK(at({1, 0, 0.3f}).x == Approx(0.5));
  CHECK(at({0, 1, 0.3f}).x == Approx(0.75));
  CHECK(at({0, 1, 0.3f}).y == Approx(0.3));
  m.kind = TextureMapping::Kind::planar;
  m.v1 = {2, 0, 0};
  m.v2 = {0, 0, 1};
  m.offset = {0.5f, -1};
  m.to_texture = Transform::translate(1, 0, 0);
  CHECK(at({3, 5, 7}).x == Approx(8.5));
  CHECK(at({3, 5, 7}).y == Approx(6));
  m = {};
  m.scale = {2, 3};
  m.offset = {0.5f, 0.25f};
  CHECK(map_to_texture(m, {{1, 1}, {}}).x == Approx(2.5));
  CHECK(map_to_texture(m, {{1, 1}, {}}).y == Approx(3.25));
}

TEST_CASE("wrong references and missing files are errors at the texture's place") {
  CHECK(reason({texture(ScaleTexture{0, 1}), constant(1)}).find("scene.pbrt:7:3: ") == 0);
  CHECK(reason({texture(ScaleTexture{1, 2}), texture(MixTexture{2, 2, 0}), constant(1)}).find("itself") != std::string::npos);
  CHECK(reason({texture(ScaleTexture{1, 1})}).find("existing") != std::string::npos);
  const std::string missing = reason({texture(image_texture("nowhere.png"))});
  CHECK(missing.find("scene.pbrt:7:3: ") == 0);
  CHECK(missing.find("nowhere.png") != std::string::npos);
}

TEST_CASE("a long chain of textures needs no deep stack to build") {
  std::vector<Texture> chain;
  for (TextureId i = 0; i < 100000; ++i) chain.push_back(texture(ScaleTexture{i + 1, 100001}));
  chain.push_back(constant(3));
  chain.push_back(constant(1));
  CHECK(build_textures(chain).constant(0) == Rgb(3.0f));
}

TEST_CASE("shared inputs are no circle") {
  const Textures t =
      build_textures({texture(MixTexture{1, 2, 3}), texture(ScaleTexture{3, 3}), texture(ScaleTexture{1, 3}), constant(0.5f)});
  CHECK(t.constant(0)->r == Approx(0.5 * 0.25 + 0.5 * 0.125));
}

TEST_CASE("dots are discs in cells; bilerp goes on beyond its corners; directionmix turns with the normal") {
  const Textures dots = build_textures({texture(DotsTexture{{}, 1, 2}), constant(1), constant(0)});
  double inside = 0;
  constexpr int kSide = 400;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) inside += dots.eval_float(0, {{x * 0.1f - 20, y * 0.1f - 20}, {}}) / (kSide * kSide);
  CHECK(inside == Approx(kPi * 0.35 * 0.35 / 2).epsilon(0.1));  // half of the cells hold one

  BilerpTexture corners;
  corners.v00 = Rgb(1, 0, 0), corners.v01 = Rgb(2, 0, 1), corners.v10 = Rgb(3, 0, 0), corners.v11 = Rgb(8, 4, 0);
  const Textures bilerp = build_textures({texture(corners)});
  CHECK(bilerp.eval(0, {{0, 1}, {}}) == corners.v01);
  CHECK(bilerp.eval(0, {{1, 0}, {}}) == corners.v10);
  CHECK(bilerp.eval(0, {{0.5f, 0.5f}, {}}) == Rgb(3.5f, 1, 0.25f));
  CHECK(bilerp.eval(0, {{2, 0}, {}}) == Rgb(5, 0, 0));

  const Textures mix = build_textures({texture(DirectionMixTexture{1, 2, {0, 1, 0}}), constant(5), constant(1)});
  CHECK(mix.eval_float(0, {.uv = {}, .p = {}, .n = {0, -1, 0}}) == 5);
  CHECK(mix.eval_float(0, {.uv = {}, .p = {}, .n = {1, 0, 0}}) == 1);
  CHECK(mix.eval_float(0, {.uv = {}, .p = {}, .n = {0.8f, 0.6f, 0}}) == Approx(0.6 * 5 + 0.4));
}

TEST_CASE("octaves of noise fade as the footprint grows, to their mean") {
  const auto noise = [](NoiseTexture::Kind kind, int octaves) {
    NoiseTexture t;
    t.kind = kind;
    t.octaves = octaves;
    return build_textures({texture(t)});
  };
  using Kind = NoiseTexture::Kind;
  const auto at = [](const Textures& t, Vec3 p, float width) {
    const Footprint footprint{{width, 0, 0}, {0, width, 0}, {}, {}};
    return t.eval_float(0, {.uv = {}, .p = p, .n = {}, .footprint = &footprint});
  };
  const Textures one = noise(Kind::fbm, 1), eight = noise(Kind::fbm, 8), wrinkled = noise(Kind::wrinkled, 8);
  CHECK(one.uses_footprint(0));
  CHECK_FALSE(build_textures({constant(1)}).uses_footprint(0));
  CHECK(build_textures({texture(ScaleTexture{1, 2}), texture(NoiseTexture{}), constant(2)}).uses_footprint(0));
  const Vec3 p{0.3f, 0.4f, 0.7f};
  CHECK(one.eval_float(0, {{}, p}) == at(one, p, 1e-6f));
  // Width w shows -1 - log2(w) octaves: two at 1/8, and one at 1/4 of which the first is whole.
  CHECK(at(eight, p, 0.125f) == Approx(at(noise(Kind::fbm, 2), p, 1e-6f)));
  CHECK(at(eight, p, 0.25f) == Approx(at(one, p, 1e-6f)));
  CHECK(at(eight, p, 1) == 0);
  double mean_wrinkle = 0, square = 0;
  for (int i = 0; i < 4096; ++i) {
    const float x = 0.37f * static_cast<float>(i), y = std::fmod(0.731f * static_cast<float>(i), 97.0f);
    mean_wrinkle += at(noise(Kind::wrinkled, 1), {x, y, 0.5f}, 1e-6f) / 4096;
    square += std::pow(at(one, {x, y, 0.5f}, 1e-6f), 2) / 4096;
  }
  CHECK(mean_wrinkle == Approx(0.2).epsilon(0.25));
  CHECK(square > 0.02);
  CHECK(at(wrinkled, p, 1) == Approx(0.2 * (1 + (1 - std::pow(0.5, 8)) / 0.5)));  // each octave's 0.2, the fading one once more
}

TEST_CASE("marble runs in layers along y and keeps to its colours") {
  NoiseTexture t;
  t.kind = NoiseTexture::Kind::marble;
  t.variation = 0;
  const Textures marble = build_textures({texture(t)});
  for (float y = -8; y < 8; y += 0.05f) {
    const Rgb c = marble.eval(0, {{}, {0, y, 0}});
    CHECK(c == marble.eval(0, {{}, {5, y, 3}}));
    CHECK(max_component(c) <= 0.91f);
    CHECK(std::min({c.r, c.g, c.b}) >= 0.29f);
  }
  // sin = -1: the first colours, which are equal.
  CHECK(marble.eval(0, {{}, {0, -kPi / 2, 0}}).r == Approx(0.87).epsilon(1e-4));
}
