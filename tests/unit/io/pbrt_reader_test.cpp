/// Whole files: Include, Import, the list of problems, and the scenes of tests/scenes/bad.
#include <algorithm>
#include <map>
#include <regex>

#include "unit/io/reader_checks.h"

using namespace tyndall;

TEST_CASE("Include reads on in place; names start at the folder of the top file") {
  const test::TempFolder folder;
  folder.write("parts/a.pbrt", "Translate 1 0 0\nInclude \"parts/b.pbrt\"\n");
  folder.write("parts/b.pbrt", "AttributeBegin\nShape \"sphere\"\n");
  const std::string top = folder.write("top.pbrt", "WorldBegin\nInclude \"parts/a.pbrt\"\nAttributeEnd\nShape \"sphere\"");
  const Scene s = read_scene(top).scene;
  REQUIRE(s.shapes.size() == 2);
  CHECK(s.shapes[1].to_world.point({0, 0, 0}) == Vec3{1, 0, 0});
  CHECK(s.shapes[0].where.str() == folder.path() + "/parts/b.pbrt:2:1");
  CHECK(s.source == top);
}

TEST_CASE("Import keeps its graphics state to itself and its names for all") {
  const test::TempFolder folder;
  folder.write(
      "a.pbrt",
      "Translate 1 0 0\nMakeNamedMaterial \"m\" \"string type\" \"dielectric\"\nNamedMaterial \"m\"\nShape \"sphere\"\n");
  const std::string text = "WorldBegin\nImport \"a.pbrt\"\nShape \"sphere\"\nNamedMaterial \"m\"\nShape \"sphere\"\n";
  const Scene s = read_scene_text(text, "test.pbrt", folder.path()).scene;
  REQUIRE(s.shapes.size() == 3);
  CHECK(s.shapes[0].to_world.point({0, 0, 0}) == Vec3{1, 0, 0});
  CHECK(s.shapes[1].to_world.is_identity());
  CHECK(s.shapes[1].material == 0);
  CHECK(s.shapes[2].material == s.shapes[0].material);
  folder.write("open.pbrt", "AttributeBegin\n");
  CHECK_CONTAINS(test::message_of([&] { read_scene_text("WorldBegin Import \"open.pbrt\"", "test.pbrt", folder.path()); }),
                 "open.pbrt:1:1: AttributeBegin is not closed");
  folder.write("end.pbrt", "AttributeEnd\n");
  CHECK_CONTAINS(
      test::message_of([&] { read_scene_text("WorldBegin AttributeBegin Import \"end.pbrt\"", "test.pbrt", folder.path()); }),
      "AttributeEnd closes nothing");
  CHECK_CONTAINS(test::error_of("Import \"a.pbrt\""), "Import stands before WorldBegin");
  folder.write("system.pbrt", "Translate 2 0 0\nCoordinateSystem \"mine\"\nCoordSysTransform \"mine\"\nShape \"sphere\"\n");
  const auto after = [&](const std::string& directive) {
    return read_scene_text("WorldBegin\n" + directive + " \"system.pbrt\"\nCoordSysTransform \"mine\"\n", "test.pbrt",
                           folder.path());
  };
  CHECK(after("Include").scene.shapes.size() == 1);
  CHECK_CONTAINS(test::message_of([&] { after("Import"); }), "\"mine\" is not defined");
}

TEST_CASE("circles of Include end in an error") {
  const test::TempFolder folder;
  folder.write("a.pbrt", "Include \"b.pbrt\"");
  folder.write("b.pbrt", "Include \"a.pbrt\"");
  CHECK_CONTAINS(test::message_of([&] { read_scene(folder.path() + "/a.pbrt"); }),
                 "includes itself or is nested deeper than 64");
  CHECK(check_scene(folder.path() + "/a.pbrt").errors.size() == 2);  // and no WorldBegin
  for (int i = 0; i < 100; ++i) folder.write("n" + std::to_string(i), "Include \"n" + std::to_string(i + 1) + "\"");
  CHECK_CONTAINS(test::message_of([&] { read_scene(folder.path() + "/n0"); }),
                 "/n64:1:9: file \"n65\" includes itself or is nested");
}

TEST_CASE("a parameter list goes on after the end of an included file, but not of an imported one") {
  const test::TempFolder folder;
  folder.write("tail.pbrt", "Translate 1 0 0\nShape \"sphere\" \"float zmax\" 0.25");
  folder.write("outer.pbrt", "Include \"tail.pbrt\"");
  const auto read = [&](const std::string& text) {
    return read_scene_text("WorldBegin\n" + text, "test.pbrt", folder.path()).scene;
  };
  for (const std::string file : {"tail.pbrt", "outer.pbrt"}) {
    const Scene s = read("Include \"" + file + "\"\n\"float radius\" 0.6 \"float phimax\" 300 Shape \"sphere\"");
    REQUIRE(s.shapes.size() == 2);
    const auto sphere = std::get<Sphere>(s.shapes[0].kind);
    CHECK(sphere.radius == 0.6f);
    CHECK(sphere.z_max == 0.25f);
    CHECK(sphere.phi_max_degrees == 300);
  }
  CHECK_CONTAINS(test::message_of([&] { read("Include \"tail.pbrt\" \"float radus\" 1"); }),
                 "test.pbrt:2:21: shape \"sphere\" has no parameter \"radus\"");
  CHECK_CONTAINS(test::message_of([&] { read("Include \"tail.pbrt\" \"float zmax\" 1"); }), "\"zmax\" is given twice");
  CHECK_CONTAINS(test::message_of([&] { read("Import \"tail.pbrt\" \"float radius\" 1"); }), "expected a directive");
  CHECK_CONTAINS(test::message_of([&] { read("\"float radius\" 1"); }), "expected a directive");
}

TEST_CASE("warnings are given once, with the first place") {
  const SceneFile file = test::read_world_file("\nTransformBegin TransformEnd\nTransformBegin TransformEnd");
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0].where.str() == "test.pbrt:2:1");
}

TEST_CASE("check lists every problem and none that follows from another") {
  const SceneCheck check = check_scene(std::string(TYNDALL_SOURCE_DIR) + "/tests/scenes/bad/several.pbrt");
  const char* expected[] = {":2:22: fov must lie between 0 and 180", ":3:34: expected an integer",
                            ":5:25: medium type \"vapour\"",         ":8:3: unknown directive \"Shpe\"",
                            ":9:18: radius must be above 0",         ":12:21: parameter \"I\" has a negative component"};
  REQUIRE(check.errors.size() == std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) CHECK_CONTAINS(check.errors[i], expected[i]);
  CHECK(check.scene.shapes.size() == 1);
}

TEST_CASE("check gives up after a hundred errors") {
  const test::TempFolder folder;
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 1000; ++i) text += "Shap \"sphere\"\n";
  const SceneCheck check = check_scene(folder.write("a.pbrt", text));
  CHECK(check.errors.size() == 101);
  CHECK_CONTAINS(check.errors.back(), "more errors are not shown");
}

TEST_CASE("a missing or late WorldBegin is one error") {
  const test::TempFolder folder;
  const std::string shapes = "AttributeBegin\nAttributeEnd\nShape \"sphere\"\nShape \"sphere\"\n";
  CHECK(check_scene(folder.write("a.pbrt", "Material \"diffuse\"\n" + shapes)).errors.size() == 1);
  CHECK(check_scene(folder.write("b.pbrt", "Material \"diffuse\"\n" + shapes + "Camera \"perspective\" WorldBegin\n" + shapes))
            .errors.size() == 1);
  CHECK(check_scene(folder.write("c.pbrt", "WorldBegin\n" + shapes + "Camera \"perspective\"\n")).errors.size() == 1);
}

TEST_CASE("check of a good and of an absent file") {
  const test::TempFolder folder;
  CHECK(check_scene(folder.write("a.pbrt", "WorldBegin\nShape \"sphere\"")).errors.empty());
  CHECK(check_scene(folder.path() + "/absent.pbrt").errors.size() == 1);
}

TEST_CASE("reading survives any truncation and any damaged byte") {
  const std::string whole = R"(Film "rgb" "integer xresolution" [ 48 ] # c
    LookAt 0 1 -4 0 0 0 0 1 0 Camera "perspective" "float fov" 40 WorldBegin AttributeBegin
    MakeNamedMedium "m" "string type" "homogeneous" "spectrum sigma_s" [200 1 900 2] MediumInterface "m" ""
    Texture "t" "spectrum" "checkerboard" "rgb tex1" [.1 .2 .3] Material "diffuse" "texture reflectance" "t"
    AreaLightSource "diffuse" "blackbody L" 3000 Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]
    ObjectBegin "o" Shape "sphere" ObjectEnd ObjectInstance "o" AttributeEnd)";
  CHECK(test::error_of(whole) == "no error");
  const auto survives = [](const std::string& text) {
    try {
      read_scene_text(text, "test.pbrt", "/nonexistent");
    } catch (const Error& e) {
      CHECK(test::contains(e.what(), "test.pbrt"));
    }
  };
  for (std::size_t cut = 0; cut < whole.size(); ++cut) survives(whole.substr(0, cut));
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const char c : {'"', '[', ']', '#', '\n', '\\', '-', '9', '\0'}) {
      std::string text = whole;
      text[i] = c;
      survives(text);
    }
}

TEST_CASE("each bad scene gives its one error: file, line, column, what, and what to do") {
  const std::map<std::string, std::string> expected{
      {"bad_count", ":4:22: parameter \"P\" has 8 values"},
      {"bad_medium_type", ":4:23: medium type \"homogenous\" is unknown; did you mean \"homogeneous\""},
      {"bad_number", ":4:13: \"2,5\" is not a number"},
      {"includes_itself", "includes itself"},
      {"index_out_of_range", ":5:3: index 3 "},
      {"misplaced_directive", ":4:1: Sampler stands after WorldBegin"},
      {"missing_file", ":4:17: file \"absent.ply\" does not exist"},
      {"missing_include", ":4:9: file \"absent.pbrt\" does not exist"},
      {"no_world", "without WorldBegin"},
      {"repeated_parameter", ":4:33: parameter \"radius\" is given twice"},
      {"singular_transform", ":6:3: the transformation is singular since line 5"},
      {"truncated_ply", ":4:17: "},
      {"unclosed_block", ":4:1: AttributeBegin is not closed"},
      {"unclosed_list", "add the missing ]"},
      {"unclosed_string", ":4:7: string is not closed"},
      {"undefined_material", ":5:15: material \"golt\" is not defined"},
      {"undefined_medium", ":4:17: medium \"smoke\" is not defined"},
      {"undefined_object", ":4:16: object \"tree\" is not defined"},
      {"undefined_texture", ":4:20: spectrum texture \"wood\" is not defined"},
      {"unknown_directive", ":4:1: unknown directive \"Shap\"; did you mean \"Shape\""},
      {"unknown_parameter", ":5:3: shape \"sphere\" has no parameter \"radus\"; did you mean \"radius\""},
      {"unopened_block", ":5:1: AttributeEnd closes nothing"},
      {"unsupported_material", ":4:1: material \"subsurface\" is not supported"},
      {"wrong_type", ":4:21: parameter \"from\" of light \"point\" is a point3, not a string"},
  };
  const std::string folder = std::string(TYNDALL_SOURCE_DIR) + "/tests/scenes/bad/";
  for (const auto& [name, part] : expected) {
    const std::string path = folder + name + ".pbrt";
    INFO(path);
    const SceneCheck check = check_scene(path);
    REQUIRE(check.errors.size() == 1);
    CHECK_CONTAINS(check.errors[0], part);
    CHECK(check.errors[0] == test::message_of([&] { read_scene(path); }));
    if (name != "no_world") CHECK(std::regex_search(check.errors[0], std::regex("\\.pbrt:[0-9]+:[0-9]+: .*;")));
  }
}
