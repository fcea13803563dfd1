#include "serve/http_server.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <string>
#include <thread>

#include "unit/serve/http_client.h"

namespace tyndall {
namespace {

using test::HttpClient;

/// Says back what it was asked; "/large" is large.
class Echo {
 public:
  explicit Echo(const HttpLimits& limits = {})
      : server_(
            {}, [this](const HttpRequest& r) { return answer(r); }, limits) {}
  int port() const { return server_.listener().port(); }
  int asked() const { return asked_; }

 private:
  HttpResponse answer(const HttpRequest& r) {
    ++asked_;
    if (r.path == "/large") return text_response(200, std::string(32 << 20, 'x'));
    if (r.path == "/throw") throw std::bad_alloc();
    return text_response(200, r.method + " " + r.path + " of " + r.host + " from " + r.origin + " with " + r.token);
  }

  std::atomic<int> asked_{0};
  HttpServer server_;
};

std::string request_for(const std::string& path) { return "GET " + path + " HTTP/1.1\r\nHost: a\r\n\r\n"; }

TEST_CASE("server: says what it is asked for, and lets no other page have it") {
  Echo echo;
  const std::string answer =
      test::ask(echo.port(), "POST", "/a/b?c", "Host: here\r\nOrigin: http://there\r\nX-Tyndall-Token: t\r\n");
  CHECK(test::status_of(answer) == 200);
  CHECK(test::body_of(answer) == "POST /a/b of here from http://there with t\n");
  for (const char* header : {"Cache-Control: no-store", "X-Content-Type-Options: nosniff", "X-Frame-Options: DENY",
                             "Cross-Origin-Resource-Policy: same-origin", "Referrer-Policy: no-referrer"}) {
    CAPTURE(header);
    CHECK(answer.find(header) != std::string::npos);
  }
  CHECK(answer.find("Access-Control-Allow") == std::string::npos);
}

TEST_CASE("server: several requests on one connection") {
  Echo echo;
  HttpClient client(echo.port());
  for (int i = 0; i < 3; ++i) {
    CHECK(client.send(request_for("/")));
    while (echo.asked() <= i) std::this_thread::yield();
  }
  CHECK(client.send("GET / HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n"));
  const std::string all = client.read_all();
  CHECK(echo.asked() == 4);
  CHECK(all.rfind("HTTP/1.1 200") > 300);
}

TEST_CASE("server: a head that is too large is not read to its end") {
  Echo echo;
  HttpClient client(echo.port());
  client.send("GET / HTTP/1.1\r\nHost: a\r\n");
  const std::string line = "X-Filler: " + std::string(1000, 'x') + "\r\n";
  bool sending = true;
  for (int i = 0; i < 20000 && sending; ++i) sending = client.send(line);
  CHECK_FALSE(sending);  // 20 MB
  CHECK(echo.asked() == 0);
  CHECK(test::status_of(test::ask(echo.port(), "GET", "/")) == 200);
}

TEST_CASE("server: one line that is too large neither, and what is no request is hung up on") {
  Echo echo;
  for (const std::string& nonsense :
       {"GET /" + std::string(100000, 'a') + " HTTP/1.1\r\nHost: a\r\n\r\n", std::string(100000, 'a'),
        std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", 15)}) {
    HttpClient client(echo.port());
    client.send(nonsense);
    const int status = test::status_of(client.read_all());
    CHECK((status == 0 || status >= 400));
  }
  CHECK(echo.asked() == 0);
}

TEST_CASE("server: a body is not read") {
  Echo echo;
  HttpClient client(echo.port());
  client.send("POST /x HTTP/1.1\r\nHost: a\r\nContent-Length: 1000000000000\r\n\r\n");
  CHECK(test::status_of(client.read_all()) == 413);  // and hung up
  HttpClient chunks(echo.port());
  chunks.send("POST /x HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\nffffffff\r\n");
  CHECK(test::status_of(chunks.read_all()) == 413);
  CHECK(echo.asked() == 0);
}

TEST_CASE("server: more connections than it has room for wait until one goes") {
  Echo echo({.connections = 2});
  std::deque<HttpClient> clients;
  for (int i = 0; i < 2; ++i) CHECK(clients.emplace_back(echo.port()).send("GET /"));
  HttpClient third(echo.port());
  CHECK(third.send("GET / HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n"));
  CHECK_FALSE(third.hears_within(400));
  clients.pop_front();
  CHECK(test::status_of(third.read_all()) == 200);
}

TEST_CASE("server: who says nothing is hung up on") {
  Echo echo({.idle_seconds = 1});
  HttpClient client(echo.port());
  client.send("GET / HTT");
  const int status = test::status_of(client.read_all());
  CHECK((status == 0 || status == 408));
}

TEST_CASE("server: who trickles is hung up on, however steadily") {
  Echo echo({.idle_seconds = 3600, .request_seconds = 0.5});
  HttpClient client(echo.port());
  client.send("GET / HTTP/1.1\r\nX: ");
  int sent = 0;
  while (sent < 10000 && client.send("x")) {
    ++sent;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  CHECK(sent < 10000);
}

TEST_CASE("server: what is large goes to a few at once") {
  Echo echo({.large_answers = 2});
  std::deque<HttpClient> asleep;
  for (int i = 0; i < 2; ++i) CHECK(asleep.emplace_back(echo.port()).send(request_for("/large")));
  while (echo.asked() < 2) std::this_thread::yield();
  CHECK(test::status_of(test::ask(echo.port(), "GET", "/large")) == 503);
  CHECK(test::status_of(test::ask(echo.port(), "GET", "/small")) == 200);
  asleep.pop_front();
  std::string answer;
  do answer = test::ask(echo.port(), "GET", "/large");
  while (test::status_of(answer) == 503);
  CHECK(test::body_of(answer).size() == (32 << 20) + 1);
}

TEST_CASE("server: who does not take an answer is hung up on") {
  Echo echo({.idle_seconds = 3600, .request_seconds = 0.5, .large_answers = 1});
  HttpClient asleep(echo.port());
  CHECK(asleep.send(request_for("/large")));
  while (echo.asked() < 1) std::this_thread::yield();
  std::string answer;
  do answer = test::ask(echo.port(), "GET", "/large");
  while (test::status_of(answer) != 200);
  CHECK(asleep.read_all().size() < 32 << 20);
}

TEST_CASE("server: an answer that cannot be made costs its connection, not the server") {
  Echo echo;
  CHECK(test::ask(echo.port(), "GET", "/throw") == "");
  CHECK(test::status_of(test::ask(echo.port(), "GET", "/")) == 200);
}

TEST_CASE("server: ends while clients hang on it") {
  std::deque<HttpClient> clients;
  {
    Echo echo;
    for (int i = 0; i < 20; ++i) clients.emplace_back(echo.port());
    clients[0].send("GET / HT");
    clients[1].send(request_for("/large"));
    while (echo.asked() < 1) std::this_thread::yield();
  }
  CHECK(clients[0].read_all() == "");
}

}  // namespace
}  // namespace tyndall
