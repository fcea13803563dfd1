/// What a browser asks, and what it is answered.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tyndall {

/// The head of a request; bodies are not read.
struct HttpRequest {
  std::string method{}, path{};
  std::string host{}, origin{};  ///< as the browser states them; empty: not stated
  std::string token{};           ///< of the header X-Tyndall-Token
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
  std::vector<std::pair<std::string, std::string>> headers{};  ///< more of them
};

/// A line of text, which need not be more than why there is no page.
inline HttpResponse text_response(int status, const std::string& text) {
  return {.status = status, .body = std::make_shared<const std::string>(text + "\n")};
}

}  // namespace tyndall
