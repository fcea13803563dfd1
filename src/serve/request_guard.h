/// Which requests are those of the page that is served, and not those that another page makes a browser send.
#pragma once

#include <optional>
#include <string>

#include "serve/http_message.h"

namespace tyndall {

/// A page on the web can have its name resolve to this machine (DNS rebinding); its requests then name its own host. It can
/// also send requests here without reading the answers; a browser tells for those to a POST where they come from.
class RequestGuard {
 public:
  /// `host`: the name under which the page is served, beside addresses and "localhost". `token`: what the page's own requests
  /// to change something carry.
  RequestGuard(const std::string& host, std::string token);

  /// The answer to a request that is not to be served; nothing where it is.
  std::optional<HttpResponse> refusal(const HttpRequest& request) const;
  const std::string& token() const { return token_; }

 private:
  bool is_host_of_page(const std::string& host) const;

  std::string host_;  ///< in small letters
  std::string token_;
};

/// 128 bits that nobody guesses, as hexadecimal digits.
std::string random_token();

}  // namespace tyndall
