/// Damaged photometric files: read, or refused in one line.
#include <doctest/doctest.h>

#include <cmath>

#include "support/damage.h"
#include "support/scratch.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

void read_web(const std::string& path) {
  const PhotometricWeb web = read_ies(path);
  if (web.candela.size() != web.vertical_degrees.size() * web.horizontal_degrees.size())
    throw std::runtime_error("a table of a wrong size");
  for (const float I : web.candela)
    if (!(I >= 0 && std::isfinite(I))) throw std::runtime_error("an intensity that is none");
}

}  // namespace

TEST_CASE("damaged .ies files") {
  const std::string corpus = TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/ies/";
  const std::vector<std::string> seeds{corpus + "street.ies", corpus + "tilted.ies"};
  for (const std::string& seed : seeds) read_web(seed);
  const Verdict verdict = read_mutants(seeds, read_web, /*text=*/true);
  MESSAGE(verdict.str());
  CHECK(verdict.complaints.empty());
  CHECK(verdict.accepted_truncations <= verdict.cases / 100);  // a last number that has lost digits is a number
}
