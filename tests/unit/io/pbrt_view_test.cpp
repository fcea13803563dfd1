#include "io/color.h"
#include "math/cie.h"
#include "support/scratch.h"
#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::error_of;
using test::read;

TEST_CASE("without any directive pbrt's defaults hold") {
  const Scene s = read("WorldBegin");
  CHECK(s.camera.kind == Camera::Kind::perspective);
  CHECK(s.camera.fov_degrees == 90);
  CHECK(s.camera.to_world.is_identity());
  CHECK_FALSE(s.camera.medium);
  CHECK(s.film.width == 1280);
  CHECK(s.film.height == 720);
  CHECK(s.film.imaging_ratio == 1);
  CHECK(s.film.max_component == kInfinity);
  CHECK(s.filter.kind == PixelFilter::Kind::gaussian);
  CHECK(s.settings.spp == 16);
  CHECK(s.settings.max_depth == 5);
  CHECK(s.source == "test.pbrt");
}

TEST_CASE("Camera") {
  const Scene s = read(R"(LookAt 0 0 -5 0 0 0 0 1 0
    Camera "perspective" "float fov" 40 "float lensradius" .1 "float focaldistance" 5 "float frameaspectratio" 2
      "float screenwindow" [-1 1 -.5 .5] WorldBegin)");
  CHECK(s.camera.fov_degrees == 40);
  CHECK(s.camera.lens_radius == .1f);
  CHECK(s.camera.focal_distance == 5);
  CHECK(*s.camera.frame_aspect_ratio == 2);
  CHECK(*s.camera.screen_window == std::array<float, 4>{-1, 1, -.5f, .5f});
  CHECK(s.camera.to_world.point({0, 0, 0}).z == doctest::Approx(-5));
  CHECK(read("Camera \"orthographic\" WorldBegin").camera.kind == Camera::Kind::orthographic);
  CHECK_CONTAINS(error_of("Camera \"orthographic\" \"float fov\" 3"), "has no parameter \"fov\"");
  CHECK_CONTAINS(error_of("Camera \"perspective\" \"float fov\" 180"), "fov must lie between");
  CHECK_CONTAINS(error_of("Camera \"perspective\" \"float screenwindow\" [1 2]"), "takes four numbers");
  CHECK_CONTAINS(error_of("Camera \"perspective\" \"float shutteropen\" 2"), "shutter does not open");
  CHECK_CONTAINS(error_of("Camera \"perspectiv\""), "did you mean \"perspective\"?");
}

TEST_CASE("spherical cameras: both mappings, and what pbrt passes over") {
  CHECK(read("Camera \"spherical\" WorldBegin").camera.kind == Camera::Kind::spherical_equal_area);
  CHECK(read("Camera \"spherical\" \"string mapping\" \"equalarea\" WorldBegin").camera.kind ==
        Camera::Kind::spherical_equal_area);
  const Camera camera = read(R"(Translate 0 0 5 Camera "spherical" "string mapping" "equirectangular" "float shutterclose" .5
    "float lensradius" .1 "float focaldistance" 5 "float screenwindow" [-2 2 -1 1] WorldBegin)")
                            .camera;
  CHECK(camera.kind == Camera::Kind::spherical_equirectangular);
  CHECK(camera.to_world.point({0, 0, 0}).z == -5);
  CHECK(camera.lens_radius == 0);
  CHECK_FALSE(camera.screen_window);
  CHECK_CONTAINS(error_of("Camera \"spherical\" \"string mapping\" \"mercator\""), "equirectangular");
  CHECK_CONTAINS(error_of("Camera \"spherical\" \"float fov\" 90"), "has no parameter \"fov\"");
}

TEST_CASE("realistic cameras: lenses, stop, focus, film") {
  test::Scratch folder;
  test::write_bytes(folder / "a.dat", "50 5 1.5 20\n0 1 0 12\n-50 40 1 20\n");
  const auto camera = [&](const std::string& parameters) {
    return "Camera \"realistic\" \"string lensfile\" \"" + (folder / "a.dat") + "\" " + parameters + " WorldBegin";
  };
  const Camera plain = read(camera("")).camera;
  CHECK(plain.kind == Camera::Kind::realistic);
  REQUIRE(plain.lenses);
  CHECK(plain.lenses->elements.size() == 3);
  CHECK(plain.lenses->elements[1].aperture_radius == 0.0005f);
  CHECK(plain.lenses->focus_distance == 10);
  CHECK(plain.lenses->stop == Lenses::Stop::circle);
  CHECK(plain.lenses->film_diagonal == doctest::Approx(0.035));
  const Camera set = read("Film \"rgb\" \"float diagonal\" 20 " +
                          camera("\"float aperturediameter\" 8 \"float focusdistance\" 2 \"string aperture\" \"star\""))
                         .camera;
  CHECK(set.lenses->elements[1].aperture_radius == 0.004f);
  CHECK(set.lenses->focus_distance == 2);
  CHECK(set.lenses->stop == Lenses::Stop::star);
  CHECK(set.lenses->film_diagonal == doctest::Approx(0.02));
  const SceneFile wide = read_scene_text(camera("\"float aperturediameter\" 13"), "test.pbrt");
  CHECK(wide.warnings.size() == 1);
  CHECK(wide.scene.camera.lenses->elements[1].aperture_radius == 0.006f);
  CHECK_CONTAINS(error_of("Camera \"realistic\""), "needs \"string lensfile\"");
  CHECK_CONTAINS(error_of(camera("\"string aperture\" \"leaf.png\"")), "images of an aperture are not supported");
  CHECK_CONTAINS(error_of(camera("\"float lensradius\" 1")), "has no parameter \"lensradius\"");
}

TEST_CASE("the camera's medium is the outside of the MediumInterface before it") {
  const Scene s =
      read(R"(MakeNamedMedium "fog" "string type" "homogeneous" MediumInterface "" "fog" Camera "perspective" WorldBegin)");
  CHECK(s.camera.medium == MediumId{0});
  CHECK_FALSE(
      read("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" Camera \"perspective\" MediumInterface \"fog\" WorldBegin")
          .camera.medium);
}

TEST_CASE("Film: size, crop, exposure") {
  const Film f =
      read(R"(Film "rgb" "integer xresolution" 200 "integer yresolution" 100 "string filename" "a.exr" "float iso" 200
    "float maxcomponentvalue" 10 "bool savefp16" false "float diagonal" 20 "string sensor" "cie1931" "float cropwindow" [.25 .5 0 .333]
    Camera "perspective" "float shutterclose" .25 WorldBegin)")
          .film;
  CHECK(f.width == 200);
  CHECK(f.height == 100);
  CHECK(f.filename == "a.exr");
  CHECK(f.imaging_ratio == doctest::Approx(0.5));
  CHECK(f.max_component == 10);
  CHECK(f.crop == PixelBounds{50, 0, 100, 34});
  CHECK_FALSE(f.gbuffer);
  const Film g = read(
                     "Film \"gbuffer\" \"integer xresolution\" 64 \"integer yresolution\" 64 \"integer pixelbounds\" [8 16 4 "
                     "99] WorldBegin")
                     .film;
  CHECK(g.gbuffer);
  CHECK(g.crop == PixelBounds{8, 4, 16, 64});
  CHECK_CONTAINS(error_of("Film \"rgb\" \"integer xresolution\" 0"), "xresolution must be from 1");
  CHECK_CONTAINS(error_of("Film \"rgb\" \"float cropwindow\" [.5 .5 0 1]"), "leaves no pixel");
  CHECK_CONTAINS(error_of("Film \"spectral\""), "not supported");
  CHECK_CONTAINS(error_of("Film \"rgb\" \"float gain\" 1"), "film \"rgb\" has no parameter \"gain\"");
}

TEST_CASE("sensor and white balance are part of the film's colours") {
  const auto film = [](const std::string& parameters) { return read("Film \"rgb\" " + parameters + " WorldBegin").film; };
  CHECK(film("\"string sensor\" \"cie1931\"").from_rec709 == Film().from_rec709);
  const auto warm = film("\"float whitebalance\" 4000").from_rec709,
             canon = film("\"string sensor\" \"canon_eos_5d\"").from_rec709;
  CHECK(transformed(warm, Rgb(1.0f)).b > 1.5f);
  CHECK(transformed(canon, Rgb(1.0f)).g == doctest::Approx(1).epsilon(0.02));
  CHECK(canon != film("\"string sensor\" \"canon_eos_5d\" \"float whitebalance\" 4000").from_rec709);
  CHECK_CONTAINS(error_of("Film \"rgb\" \"string sensor\" \"canon_eos_5\""), "did you mean \"canon_eos_5d");
  CHECK_CONTAINS(error_of("Film \"rgb\" \"float whitebalance\" -1"), "whitebalance must be 0");
  const auto warnings = [](const char* text) { return read_scene_text(text, "test.pbrt").warnings.size(); };
  CHECK(warnings("Film \"rgb\" \"string sensor\" \"nikon_d850\" WorldBegin") == 0);
  CHECK(warnings("Film \"rgb\" \"string sensor\" \"nikon_d850\" \"float maxcomponentvalue\" 2 WorldBegin") == 1);
}

TEST_CASE("the film is written in the colour space in force at Film") {
  const Film f = read("ColorSpace \"aces2065-1\" Film \"rgb\" ColorSpace \"srgb\" WorldBegin").film;
  CHECK(f.chromaticities.red.x == doctest::Approx(0.7347));
  CHECK(f.from_rec709[0] != 1);
  CHECK_CONTAINS(error_of("ColorSpace \"aces\""), "colour space \"aces\" is unknown");
}

TEST_CASE("PixelFilter") {
  struct Row {
    const char* name;
    PixelFilter::Kind kind;
    float radius;
  };
  using Kind = PixelFilter::Kind;
  for (const Row& row : {Row{"box", Kind::box, .5f},
                         {"triangle", Kind::triangle, 2},
                         {"gaussian", Kind::gaussian, 1.5f},
                         {"mitchell", Kind::mitchell, 2},
                         {"sinc", Kind::sinc, 4}}) {
    const PixelFilter f = read("PixelFilter \"" + std::string(row.name) + "\" \"float yradius\" 3 WorldBegin").filter;
    CHECK(f.kind == row.kind);
    CHECK(f.radius.x == row.radius);
    CHECK(f.radius.y == 3);
  }
  CHECK(read("PixelFilter \"mitchell\" \"float B\" .2 \"float C\" .4 WorldBegin").filter.c == .4f);
  CHECK(read("PixelFilter \"sinc\" \"float tau\" 5 WorldBegin").filter.tau == 5);
  CHECK(read("PixelFilter \"gaussian\" \"float sigma\" 1 WorldBegin").filter.sigma == 1);
  CHECK_CONTAINS(error_of("PixelFilter \"box\" \"float sigma\" 1"), "no parameter \"sigma\"");
  CHECK_CONTAINS(error_of("PixelFilter \"box\" \"float xradius\" 0"), "above 0");
  CHECK_CONTAINS(error_of("PixelFilter \"tent\""), "filter \"tent\" is unknown");
}
