#include "serve/listener.h"

#include <doctest/doctest.h>

#include <string>

#include "tyndall/error.h"
#include "unit/serve/http_client.h"

namespace tyndall {
namespace {

/// What went wrong, and the message.
struct Failed {
  Failure failure{};
  std::string message;
};
template <typename Try>
Failed failed(const Try& attempt) {
  try {
    attempt();
  } catch (const Error& e) {
    return {e.failure(), e.what()};
  }
  FAIL("no error");
  return {};
}

TEST_CASE("listener: what may stand behind --serve") {
  CHECK(serve_address("").host == "127.0.0.1");
  CHECK(serve_address("").port == 0);
  CHECK(serve_address("8080").host == "127.0.0.1");
  CHECK(serve_address("8080").port == 8080);
  CHECK(serve_address("render7:80").host == "render7");
  CHECK(serve_address("[::1]:80").host == "::1");
  CHECK(serve_address("[::1]:80").port == 80);
  for (const char* text : {"smoke.pbrt", "80a", "-1", "65536", "127.0.0.1:", ":80", "99999999999", "host:port", " 80", "80 "}) {
    CAPTURE(text);
    const Failed f = failed([&] { serve_address(text); });
    CHECK(f.failure == Failure::usage);
    CHECK(f.message.find("--serve " + std::string(text)) != std::string::npos);
  }
}

TEST_CASE("listener: this machine only, unless it is told") {
  const Listener here(serve_address(""));
  CHECK(here.is_loopback());
  CHECK(here.port() > 0);
  CHECK(test::HttpClient(here.port()).connected());
  CHECK_FALSE(Listener(serve_address("0.0.0.0:0")).is_loopback());
}

TEST_CASE("listener: a port that is taken, a host that is another machine's, one that nobody has") {
  const Listener first(serve_address(""));
  const std::string taken = std::to_string(first.port());
  const Failed second = failed([&] { Listener again(serve_address(taken)); });
  CHECK(second.failure == Failure::run_time);
  CHECK(second.message.find("give another port") != std::string::npos);
  CHECK(second.message.find(taken) != std::string::npos);
  CHECK(failed([] { Listener other(serve_address("192.0.2.1:0")); }).failure == Failure::run_time);
  CHECK(failed([] { Listener nobody(serve_address("no.such.host.invalid:80")); }).failure == Failure::usage);
}

}  // namespace
}  // namespace tyndall
