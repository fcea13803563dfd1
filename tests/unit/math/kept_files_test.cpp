#include <doctest/doctest.h>

#include "support/scratch.h"
#include "tyndall/frames.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Reads files through `kept`, and counts how often that was needed.
struct Reader {
  KeptFiles kept;
  int reads = 0;

  std::string read(const std::string& path, const std::string& details = "") {
    return *kept.get<std::string>({path, "text", details}, [&] {
      ++reads;
      return read_bytes(path);
    });
  }
};

}  // namespace

TEST_CASE("what was made of a file is made once, and again when the file or the details change") {
  const Scratch folder;
  Reader r;
  write_bytes(folder / "a", "one");
  CHECK(r.read(folder / "a") == "one");
  CHECK(r.read(folder / "a") == "one");
  CHECK(r.reads == 1);
  CHECK(r.kept.made() == 1);
  CHECK(r.kept.reused() == 1);
  r.read(folder / "a", "otherwise");
  CHECK(r.reads == 2);
  write_bytes(folder / "a", "two");
  CHECK(r.read(folder / "a", "otherwise") == "two");
  CHECK(r.reads == 3);
  CHECK(r.read(folder / "none") == "");
  CHECK(r.read(folder / "none") == "");
  CHECK(r.reads == 5);
}

TEST_CASE("two uses of a file stand beside each other") {
  const Scratch folder;
  write_bytes(folder / "a", "12");
  KeptFiles kept;
  const auto text = kept.get<std::string>({folder / "a", "text"}, [&] { return read_bytes(folder / "a"); });
  const auto number = kept.get<int>({folder / "a", "number"}, [] { return 12; });
  CHECK(*text == "12");
  CHECK(*number == 12);
  CHECK(kept.get<int>({folder / "a", "number"}, [] { return 13; }) == number);
}

TEST_CASE("what the next scene does not ask for is forgotten, and freed when nobody has it") {
  const Scratch folder;
  Reader r;
  for (const char* name : {"a", "b"}) write_bytes(folder / name, name);
  r.kept.begin_scene();
  const std::weak_ptr<const int> a = r.kept.get<int>({folder / "a", "number"}, [] { return 1; });
  r.read(folder / "b");
  r.kept.begin_scene();
  r.read(folder / "b");
  CHECK_FALSE(a.expired());
  r.kept.drop_others();
  CHECK(a.expired());
  r.read(folder / "b");
  CHECK(r.reads == 1);
}
