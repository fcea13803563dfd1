#include "report/command_words.h"

#include <doctest/doctest.h>

namespace tyndall {
namespace {

const CommandWords::Names kOutput{"-o", "--output"}, kSpp{"--spp"};

TEST_CASE("options are words of their own, whatever files are called") {
  CommandWords command("tyndall render my-old.pbrt --spp 64 -o 'my-old dir/it'\\''s 1.exr'");
  CHECK(command.value(kOutput) == "my-old dir/it's 1.exr");
  CHECK(command.value(kSpp) == "64");
  CHECK_FALSE(command.value({"--seed"}).has_value());
  command.change(kOutput, "b's 2.exr");
  command.drop(kSpp);
  command.add("--seed", "3");
  CHECK(command.str() == "tyndall render my-old.pbrt -o 'b'\\''s 2.exr' --seed 3");
}

TEST_CASE("all spellings of an option are changed") {
  CommandWords command("t --spp=4 -oa.exr --spp 8 --output=b.exr --spp-like 2");
  CHECK(command.value(kSpp) == "8");
  CHECK(command.value(kOutput) == "b.exr");
  command.change(kOutput, "c");
  command.change(kSpp, "16");
  CHECK(command.str() == "t '--spp=16' -oc --spp 16 '--output=c' --spp-like 2");
  command.drop(kSpp);
  CHECK(command.str() == "t -oc '--output=c' --spp-like 2");
  CHECK(CommandWords("").str().empty());
  CHECK(CommandWords("t ''").str() == "t ''");
  CHECK(CommandWords("t --spp").str() == "t --spp");
}

}  // namespace
}  // namespace tyndall
