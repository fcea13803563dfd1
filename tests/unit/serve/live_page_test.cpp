#include "serve/live_page.h"

#include <doctest/doctest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "unit/serve/http_client.h"

namespace tyndall {
namespace {

using test::body_of;
using test::status_of;

Image small_image(float value) {
  Image image;
  image.data = {5, 7, 8, 9};
  image.display = {0, 0, 20, 20};
  for (const char* name : {"R", "G", "B"}) image.add_channel(name).values.assign(6, value);
  return image;
}

LivePage::Setup setup_with(std::function<void()> cancel) {
  LivePage::Setup setup;
  setup.title = "a <b>scene</b>.pbrt";
  setup.cancel = std::move(cancel);
  setup.last_words = 600;
  return setup;
}

struct Served {
  std::atomic<int> cancelled{0};
  LivePage page{setup_with([this] { ++cancelled; })};
  int port = std::stoi(page.url().substr(page.url().rfind(':') + 1));

  std::string get(const std::string& path) { return test::ask(port, "GET", path); }
  nlohmann::json state(const std::string& path = "/state") { return nlohmann::json::parse(body_of(get(path))); }
  std::string token() {
    const std::string text = get("/"), key = "\"token\":\"";
    const std::size_t begin = text.find(key) + key.size();
    return text.substr(begin, 32);
  }
  int post(const std::string& path, const std::string& token, const std::string& origin) {
    return status_of(
        test::ask(port, "POST", path, "Origin: " + origin + "\r\nX-Tyndall-Token: " + token + "\r\nContent-Length: 0\r\n"));
  }
  std::string origin() const { return "http://127.0.0.1:" + std::to_string(port); }
};

TEST_CASE("live page: the page, and a policy that lets nothing but its own script run") {
  Served served;
  const std::string answer = served.get("/");
  CHECK(status_of(answer) == 200);
  CHECK(served.page.is_loopback());
  CHECK(served.page.url() == served.origin() + "/");
  const std::size_t nonce = answer.find("script-src 'nonce-");
  REQUIRE(nonce != std::string::npos);
  CHECK(answer.find("default-src 'none'") != std::string::npos);
  CHECK(answer.find("frame-ancestors 'none'") != std::string::npos);
  CHECK(answer.find("<script nonce=\"" + answer.substr(nonce + 18, 32) + "\">") != std::string::npos);
  CHECK(answer.find("<title>Tyndall: a &lt;b&gt;scene") != std::string::npos);
  CHECK(answer.find("<b>scene") == std::string::npos);
}

TEST_CASE("live page: nothing else is served, whatever it is called") {
  Served served;
  served.page.show({small_image(1)});
  for (const char* path : {"/index.html",
                           "//",
                           "/..",
                           "/../etc/passwd",
                           "/%2e%2e/etc/passwd",
                           "/page.js",
                           "/state/",
                           "/state/a",
                           "/state/a/b",
                           "/state/a/1/2",
                           "/state/0123456789abcdef0123456789abcdef0/1",
                           "/picture",
                           "/picture/1",
                           "/picture/1/1",
                           "/picture/0/0",
                           "/picture/2/0",
                           "/picture/1/-1",
                           "/picture/1/0/0",
                           "/picture/1/0x0",
                           "/picture/1/99999999999999999999",
                           "/cancel",
                           "/file:///etc/passwd"}) {
    CAPTURE(path);
    CHECK(status_of(served.get(path)) == 404);
  }
  CHECK(status_of(served.get("/picture/1/0")) == 200);
  CHECK(status_of(test::ask(served.port, "GET", "/state", "Host: evil.example\r\n")) == 403);
  CHECK(status_of(test::ask(served.port, "GET", "/picture/1/0", "Host: evil.example\r\n")) == 403);
  CHECK(status_of(test::ask(served.port, "GET", "/", "Host: evil.example\r\n")) == 403);
}

TEST_CASE("live page: where the render stands") {
  Served served;
  CHECK(served.state()["stage"] == "building");
  CHECK(served.state()["pictures"].empty());
  CHECK(served.state()["relmse"].is_null());
  served.page.begin("rendering", "out \"1\".exr", "denoising");
  served.page.show(Progress{.samples_done = 12, .fraction = 0.25, .seconds = 3, .remaining = 9});
  served.page.show({small_image(1), std::vector<float>(6, 0.01f), 0.02});
  const nlohmann::json state = served.state();
  CHECK(state["stage"] == "rendering");
  CHECK(state["next"] == "denoising");
  CHECK(state["output"] == "out \"1\".exr");
  CHECK(state["samples"] == 12);
  CHECK(state["fraction"] == 0.25);
  CHECK(state["remaining"] == 9);
  CHECK(state["relmse"] == 0.02);
  REQUIRE(state["pictures"].size() == 2);
  CHECK(
      state["pictures"][0] ==
      nlohmann::json{{"name", "rendered"}, {"kind", "light"}, {"planes", 3}, {"x", 5}, {"y", 7}, {"width", 3}, {"height", 2}});
  CHECK(state["pictures"][1]["kind"] == "error");
  CHECK(state["pictures"][1]["planes"] == 1);
}

TEST_CASE("live page: pictures are those of the version, and an older one is not there any more") {
  Served served;
  served.page.show({small_image(1), std::vector<float>(6, 0.5f)});
  std::string ones;
  for (int i = 0; i < 18; ++i) ones += std::string("\x00\x3c", 2);  // 1 as a half float
  CHECK(body_of(served.get("/picture/1/0")) == ones);
  CHECK(body_of(served.get("/picture/1/1")).size() == 12);
  served.page.show({small_image(2)});
  CHECK(status_of(served.get("/picture/1/0")) == 404);
  CHECK(body_of(served.get("/picture/2/0")).substr(0, 2) == std::string("\x00\x40", 2));
  CHECK(status_of(served.get("/picture/2/1")) == 404);
}

TEST_CASE("live page: what was denoised stays beside what is rendered, until another picture begins") {
  Served served;
  served.page.begin("rendering", "1.exr");
  served.page.show({small_image(1), std::vector<float>(6, 0.5f)});
  Image denoised = small_image(3);
  for (const char* name : {"noisy.R", "noisy.G", "noisy.B"}) denoised.add_channel(name);
  served.page.show_denoised(denoised, 0);
  CHECK(served.state()["pictures"][1]["name"] == "denoised");
  served.page.show({small_image(2), std::vector<float>(6, 0.5f)});
  CHECK(served.state()["pictures"].size() == 3);
  CHECK(body_of(served.get("/picture/3/1")).substr(0, 2) == std::string("\x00\x42", 2));
  served.page.show({denoised});
  CHECK(served.state()["pictures"].size() == 2);
  served.page.show({small_image(2)});
  served.page.begin("rendering", "2.exr");
  CHECK(served.state()["pictures"].size() == 1);
}

TEST_CASE("live page: a picture is wanted while somebody looks, and not too often") {
  Served served;
  CHECK_FALSE(served.page.wants_picture());
  served.get("/state");  // a script that asks for numbers only
  CHECK_FALSE(served.page.is_watched());
  served.get("/state/viewer/0");
  CHECK(served.page.is_watched());
  CHECK(served.page.wants_picture());
  CHECK(served.page.wants_denoised());
  served.page.show({.image = small_image(1), .seconds = 1000});
  CHECK_FALSE(served.page.wants_picture());
  CHECK(served.page.wants_denoised());
}

TEST_CASE("live page: cancel takes a POST of the page itself, and works once") {
  Served served;
  const std::string token = served.token(), origin = served.origin();
  CHECK(status_of(served.get("/cancel")) == 404);
  CHECK(served.post("/cancel", token, "http://evil.example") == 403);
  CHECK(served.post("/cancel", "0", origin) == 403);
  CHECK(served.post("/", token, origin) == 404);
  CHECK(served.post("/state", token, origin) == 404);
  CHECK(served.cancelled == 0);
  CHECK(served.state()["cancelled"] == false);
  CHECK(served.post("/cancel", token, origin) == 200);
  CHECK(served.post("/cancel", token, origin) == 200);
  CHECK(served.cancelled == 1);
  CHECK(served.state()["cancelled"] == true);
}

TEST_CASE("live page: at the end it waits for those who look, and for nobody else") {
  Served served;
  served.page.show({small_image(1)});
  served.page.end("complete");  // nobody: at once
  CHECK(served.state()["stage"] == "ended");
  CHECK(served.state()["outcome"] == "complete");

  Served watched;
  watched.page.show({small_image(1)});
  watched.get("/state/viewer/1");
  std::atomic<bool> ended{false};
  std::thread ending([&] {
    watched.page.end("stopped");
    ended = true;
  });
  nlohmann::json state;
  do state = watched.state("/state/viewer/1");  // it has not got there yet
  while (state["stage"] != "ended");
  const bool waited = !ended;
  CHECK(status_of(watched.get("/picture/" + std::to_string(state["version"].get<int>()) + "/0")) == 200);
  watched.get("/state/viewer/" + std::to_string(state["version"].get<int>()));
  ending.join();
  CHECK(waited);
}

}  // namespace
}  // namespace tyndall
