/// Every file of the seed corpora, and what fuzzing has found before, through its target; and damaged copies of them.
#include <doctest/doctest.h>

#include <filesystem>

#include "fuzz/targets.h"
#include "support/mutant.h"
#include "support/sanitized.h"
#include "support/scratch.h"

using namespace tyndall;

namespace {

const std::string corpus = TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/";

}  // namespace

// With sanitizers this is a commit's fuzzing: whatever damage makes of a file, no memory is touched that is not its own.
TEST_CASE("damaged copies of the fuzzing corpora") {
  for (const fuzz::Target& target : fuzz::kTargets) {
    CAPTURE(target.name);
    const std::uint64_t copies = test::kSanitized && !target.slow ? 100 : 10;  // of each file and each kind of damage
    for (const auto& entry : std::filesystem::directory_iterator(corpus + target.name)) {
      INFO(entry.path().string());
      const std::string whole = test::read_bytes(entry.path().string());
      for (const auto damage :
           {test::Damage::truncation, test::Damage::bit_flips, test::Damage::overwrite, test::Damage::number}) {
        for (std::uint64_t seed = 0; seed < copies; ++seed) {
          const test::Mutant mutant = test::mutant_of(whole, damage, seed);
          INFO(mutant.how);
          REQUIRE_NOTHROW(target.run(mutant.bytes));
        }
      }
    }
  }
}

TEST_CASE("the fuzzing corpora") {
  for (const fuzz::Target& target : fuzz::kTargets) {
    CAPTURE(target.name);
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus + target.name)) {
      INFO(entry.path().string());
      CHECK_NOTHROW(target.run(test::read_bytes(entry.path().string())));
      ++files;
    }
    CHECK(files > 0);
  }
}
