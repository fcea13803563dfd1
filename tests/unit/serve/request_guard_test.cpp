#include "serve/request_guard.h"

#include <doctest/doctest.h>

namespace tyndall {
namespace {

const RequestGuard kGuard("render7", "secret");

int status_of(const HttpRequest& request) {
  const auto refusal = kGuard.refusal(request);
  return refusal ? refusal->status : 200;
}

HttpRequest get(const std::string& host) { return {.method = "GET", .path = "/", .host = host}; }

HttpRequest post() {
  return {.method = "POST", .path = "/cancel", .host = "127.0.0.1:80", .origin = "http://127.0.0.1:80", .token = "secret"};
}

TEST_CASE("request guard: hosts that nobody else can have are served") {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "localhost", "localhost:9000", "[::1]:8080", "[::1]", "10.1.2.3:80",
                           "render7:8080", "Render7:8080", "LOCALHOST", "[fe80::1]:80"}) {
    CAPTURE(host);
    CHECK(status_of(get(host)) == 200);
  }
}

TEST_CASE("request guard: a name that was made to resolve here is refused") {
  for (const char* host : {"", "evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example:8080",
                           "[::1].evil.example", "render7.evil.example", "evil.example:localhost", "[evil]:80", "[]:80", ":80",
                           "127.0.0.1@evil.example", "[::1", "xn--localhost"}) {
    CAPTURE(host);
    CHECK(status_of(get(host)) == 403);
    HttpRequest request = post();
    request.host = host;
    request.origin = "http://" + request.host;
    CHECK(status_of(request) == 403);
  }
}

TEST_CASE("request guard: without a host of its own it knows none but addresses and localhost") {
  const RequestGuard guard("", "secret");
  CHECK(guard.refusal(get("")));
  CHECK(guard.refusal(get(":80")));
  CHECK_FALSE(guard.refusal(get("127.0.0.1:80")));
}

TEST_CASE("request guard: a change takes the page's origin and its token") {
  CHECK(status_of(post()) == 200);
  for (const char* origin : {"", "null", "http://evil.example", "https://127.0.0.1:80", "http://127.0.0.1",
                             "http://127.0.0.1:81", "http://localhost:80", "http://127.0.0.1:80/"}) {
    CAPTURE(origin);
    HttpRequest request = post();
    request.origin = origin;
    CHECK(status_of(request) == 403);
  }
  for (const char* token : {"", "secre", "secrets", "Secret"}) {
    CAPTURE(token);
    HttpRequest request = post();
    request.token = token;
    CHECK(status_of(request) == 403);
  }
  HttpRequest request = post();
  request.token = "";
  CHECK(RequestGuard("", "").refusal(request));
}

TEST_CASE("request guard: methods beside GET and POST are refused") {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "HEAD", "CONNECT", "get"}) {
    CAPTURE(method);
    HttpRequest request = post();
    request.method = method;
    CHECK(status_of(request) == 405);
  }
}

TEST_CASE("request guard: tokens are 128 bits, and others each time") {
  const std::string a = random_token(), b = random_token();
  CHECK(a.size() == 32);
  CHECK(a.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK(a != b);
}

}  // namespace
}  // namespace tyndall
