/// Damaged tables of lenses: read, or refused in one line.
#include <doctest/doctest.h>

#include <cmath>

#include "io/lens_file.h"
#include "support/damage.h"
#include "support/scratch.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

void read_lenses(const std::string& path) {
  for (const LensElement& e : read_lens_file(path)) {
    if (!std::isfinite(e.radius) || !(e.thickness >= 0) || !(e.aperture_radius > 0) || !(e.eta == 0 || e.eta >= 1))
      throw std::runtime_error("a lens that is none");
  }
}

}  // namespace

TEST_CASE("damaged lens files") {
  const std::string corpus = TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/lens/";
  const std::vector<std::string> seeds{corpus + "double.dat", corpus + "triplet.dat"};
  for (const std::string& seed : seeds) read_lenses(seed);
  const Verdict verdict = read_mutants(seeds, read_lenses, /*text=*/true);
  MESSAGE(verdict.str());
  CHECK(verdict.complaints.empty());
  // A file without its last rows, or whose last number has lost digits, is a table too.
  CHECK(verdict.accepted_truncations <= verdict.cases / 4);
}
