/// Volume files that are missing, foreign, old, cut off or changed.
#include <doctest/doctest.h>

#include "support/scratch.h"
#include "unit/volume/vdb_import.h"

using namespace tyndall;
using namespace tyndall::test;

// OpenVDB loses the node it is reading when a file ends too early.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(*-reserved-identifier,*-naming): the sanitizer's name
extern "C" const char* __lsan_default_suppressions() { return "leak:readTopology\n"; }

TEST_CASE("files that are missing, foreign, old or cut off are errors of one line") {
  const test::Scratch scratch;
  CHECK(contains(error_of(scratch / "none.vdb"), "no such file"));
  test::write_bytes(scratch / "empty.vdb", "");
  CHECK(contains(error_of(scratch / "empty.vdb"), "too short"));
  test::write_bytes(scratch / "text.vdb", "this is no volume at all");
  CHECK(contains(error_of(scratch / "text.vdb"), "neither an OpenVDB nor a NanoVDB"));
  CHECK(contains(error_of("/"), "folder"));

  // Header of a NanoVDB 0.0.28 file.
  std::string old = test::read_bytes(kData + "ball_float_zip.nvdb");
  old.replace(8, 4, std::string("\x1c\0\0\0", 4));
  test::write_bytes(scratch / "old.nvdb", old);
  CHECK(contains(error_of(scratch / "old.nvdb"), "version 0.0.28"));

  VdbGrid grid;
  Rng rng(3);
  grid.voxels = speckles(rng, {0, 0, 0}, 20, 500);
  test::write_vdb(scratch / "whole.vdb", {grid});
  for (const std::string& whole : {scratch / "whole.vdb", kData + "ball_float_zip.nvdb", kData + "ball_fpn_zip.nvdb"}) {
    const std::string bytes = test::read_bytes(whole);
    int accepted = 0, long_message = 0;
    for (int i = 0; i < 200; ++i) {
      test::write_bytes(scratch / "cut",
                        bytes.substr(0, static_cast<std::size_t>(rng.uniform() * static_cast<float>(bytes.size()))));
      const std::string message = error_of(scratch / "cut");
      accepted += message == "no error" ? 1 : 0;
      long_message += message.size() > 600 || contains(message, "\n") ? 1 : 0;
    }
    CHECK(accepted == 0);
    CHECK(long_message == 0);
  }
}

TEST_CASE(".nvdb: a changed bit is an error or changes nothing") {
  const test::Scratch scratch;
  for (const char* file : {"ball_fp16_zip.nvdb", "ball_float_blosc.nvdb"}) {  // Blosc has no checksum of its own
    CAPTURE(file);
    const std::string bytes = test::read_bytes(kData + file);
    const Import whole = import(kData + file);
    Rng rng(5);
    int refused = 0, different = 0;
    for (int i = 0; i < 150; ++i) {
      std::string mutant = bytes;
      mutant[static_cast<std::size_t>(rng.uniform() * static_cast<float>(mutant.size()))] ^=
          static_cast<char>(1 << static_cast<int>(rng.uniform() * 8));
      test::write_bytes(scratch / "mutant.nvdb", mutant);
      try {
        const Import loaded = import(scratch / "mutant.nvdb");
        for (int p = 0; p < 200; ++p) {
          const Vec3 at{rng.uniform() * 6, rng.uniform() * 6, rng.uniform() * 6};
          different += loaded.medium.at(at).sigma_a == whole.medium.at(at).sigma_a ? 0 : 1;
        }
      } catch (const Error&) {
        ++refused;
      }
    }
    CHECK(refused > 100);
    CHECK(different == 0);
  }
}
