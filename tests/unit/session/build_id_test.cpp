#include "session/build_id.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string_view>

namespace tyndall {
namespace {

TEST_CASE("the libraries that reckon for a picture are known by their content") {
  const auto libraries = reckoning_libraries();
  for (const std::string_view name : {"libembree", "libopenvdb", "libOpenEXR", "libImath", "libm.", "libc."}) {
    const auto found =
        std::find_if(libraries.begin(), libraries.end(), [&](const auto& l) { return l.name.starts_with(name); });
    REQUIRE_MESSAGE(found != libraries.end(), name);
    CHECK(found->name.find('/') == std::string::npos);
    CHECK(found->id.size() >= 16);
    CHECK(found->id.find_first_not_of("0123456789abcdef") == std::string::npos);
  }
  for (std::size_t i = 1; i < libraries.size(); ++i) CHECK(libraries[i - 1].id != libraries[i].id);
}

TEST_CASE("version, program and libraries are each in the build's name") {
  CHECK(std::count(build_id().begin(), build_id().end(), '-') == 2);
  CHECK(&build_id() == &build_id());
}

}  // namespace
}  // namespace tyndall
