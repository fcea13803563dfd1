/// Every file of the seed corpora, and what fuzzing has found before, through its target.
#include <doctest/doctest.h>

#include <filesystem>

#include "fuzz/targets.h"
#include "support/scratch.h"

using namespace tyndall;

TEST_CASE("the fuzzing corpora") {
  const std::string corpus = TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/";
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
