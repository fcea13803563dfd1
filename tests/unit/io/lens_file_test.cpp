#include "io/lens_file.h"

#include <doctest/doctest.h>

#include "support/scratch.h"

using namespace tyndall;

namespace {

std::string error_of(const std::string& text) {
  try {
    read_lens_text(text, "a.dat");
  } catch (const Error& error) {
    CHECK(error.failure() == Failure::scene);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a lens file: four numbers a surface, in mm, with comments") {
  const std::string text = "# a lens\n34 5 1.5 22 # front\r\n-60\t4 1 20\n\n0 3 0 12";
  const std::vector<LensElement> elements = read_lens_text(text, "a.dat");
  REQUIRE(elements.size() == 3);
  CHECK(elements[0].radius == doctest::Approx(0.034));
  CHECK(elements[0].thickness == doctest::Approx(0.005));
  CHECK(elements[0].eta == 1.5f);
  CHECK(elements[1].aperture_radius == doctest::Approx(0.010));
  CHECK(elements[2].radius == 0);
  test::Scratch folder;
  test::write_bytes(folder / "b.dat", text);
  CHECK(read_lens_file(folder / "b.dat").size() == 3);
}

TEST_CASE("lens files that cannot be used are refused with the place") {
  CHECK(error_of("# nothing\n") == "a.dat:2:1: has no lenses; give rows of radius, thickness, eta and diameter in mm");
  CHECK(error_of("34 5 1.5\n") == "a.dat:2:1: the file ends before a diameter; a row has radius, thickness, eta and diameter");
  CHECK(error_of("34 5 x 22").starts_with("a.dat:1:6: expected an index of refraction"));
  CHECK(error_of("34 -5 1.5 22").starts_with("a.dat:1:4: a thickness must not be negative"));
  CHECK(error_of("34 5 0.5 22").starts_with("a.dat:1:6: an index of refraction must be from 1"));
  CHECK(error_of("34 5 1.5 0").starts_with("a.dat:1:10: a diameter must be at least 0.001"));
  CHECK(error_of("34 5 1.5 2e6").starts_with("a.dat:1:10: a diameter must not be above 1e6"));
  CHECK(error_of("0 5 0 2\n34 5 1.5 2\n0 5 0 2").find("a second stop") != std::string::npos);
  CHECK(error_of("0 5 0 2").find("a stop without lenses") != std::string::npos);
  std::string many;
  for (int i = 0; i < 1001; ++i) many += "34 5 1.5 2\n";
  CHECK(error_of(many).find("more than 1000") != std::string::npos);
}
