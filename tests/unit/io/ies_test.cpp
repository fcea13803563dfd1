#include <doctest/doctest.h>

#include <string>

#include "support/scratch.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

const std::string kHead = "IESNA:LM-63-1995\r\n[TEST] of ours\r\n[MANUFAC] none, 1 2 3\r\nTILT=NONE\r\n";

/// Factors 2 * 0.5 * 3, three vertical and two horizontal angles.
std::string table(const std::string& counts = "2 1000 2 3 2 1 2", const std::string& angles = "0 45 90\n0 90\n",
                  const std::string& rest = "0 0 0 0.5 3 100\n") {
  return kHead + counts + " " + rest + angles + "1 2,3\n4 5 6\n";
}

std::string error_of(const std::string& text) {
  try {
    read_ies_text(text, "a.ies");
  } catch (const Error& error) {
    CHECK(error.failure() == Failure::scene);
    return error.what();
  }
  return "no error";
}

TEST_CASE("a photometric file: angles, and candela times its factors") {
  const PhotometricWeb web = read_ies_text(table(), "a.ies");
  CHECK(web.vertical_degrees == std::vector<float>{0, 45, 90});
  CHECK(web.horizontal_degrees == std::vector<float>{0, 90});
  // Of two lamps the candela are those of both; multiplier, ballast and ballast-lamp factor make 3.
  CHECK(web.candela == std::vector<float>{3, 6, 9, 12, 15, 18});
  test::Scratch folder;
  test::write_bytes(folder / "b.IES", table());
  CHECK(read_ies(folder / "b.IES").candela == web.candela);
}

TEST_CASE("since LM-63-2019 the third factor is none, and before 1991 files have no first line") {
  std::string text = table();
  CHECK(read_ies_text("IES:LM-63-2019" + text.substr(16), "a.ies").candela[0] == 1);
  CHECK(read_ies_text(text.substr(18), "a.ies").candela[0] == 3);
}

TEST_CASE("factors of tilted lamps are passed over, and what follows the table") {
  std::string text = table() + "\x1a";
  text.replace(text.find("TILT=NONE"), 9, "TILT=INCLUDE\n1\n3\n0 45 90\n1 .9 .8");
  CHECK(read_ies_text(text, "a.ies").candela[0] == 3);
}

TEST_CASE("photometric files that cannot be used are refused with the place") {
  CHECK(error_of("") == "a.ies:1:1: is no photometric file: a line \"TILT=\" is missing; give an IES LM-63 file");
  CHECK(error_of(table("2 1000 2 3 2 2 2")).starts_with("a.ies:5:14: photometry of type B is not supported"));
  CHECK(error_of(table("2 1000 2 3 2 7 2")).find("must be 1 (C)") != std::string::npos);
  CHECK(error_of(table("2 1000 2 3.5 2 1 2")).find("number of vertical angles must be a whole one") != std::string::npos);
  CHECK(error_of(table("2 1000 2 3 1e9 1 2")).find("number of horizontal angles") != std::string::npos);
  CHECK(error_of(table("0 1000 2 3 2 1 2")).find("number of lamps") != std::string::npos);
  CHECK(error_of(table("2 1000 -2 3 2 1 2")).find("must not be negative") != std::string::npos);
  CHECK(error_of(table("2 1000 2 3 2 1 2", "0 90 45\n0 90\n")).starts_with("a.ies:6:6: vertical angles must increase"));
  CHECK(error_of(table("2 1000 2 3 2 1 2", "0 90 185\n0 90\n")).find("from 0 to 180") != std::string::npos);
  CHECK(error_of(table("2 1000 2 3 2 1 2", "0 45 90\n0 80\n")).starts_with("a.ies:7:3: horizontal angles of type C"));
  CHECK(error_of(table("2 1000 2 3 2 1 2", "0 45 x\n0 90\n")).starts_with("a.ies:6:6: expected a vertical angle"));
  CHECK(error_of(table("2 1000 2 4 2 1 2", "0 45 60 90\n0 90\n")).find("ends before a candela value") != std::string::npos);
  std::string negative = table();
  negative.replace(negative.find("5 6"), 1, "-5");
  CHECK(error_of(negative).starts_with("a.ies:9:3: candela must not be negative"));
}

}  // namespace
}  // namespace tyndall
