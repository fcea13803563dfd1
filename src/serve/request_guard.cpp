#include "serve/request_guard.h"

#include <cstdint>
#include <random>
#include <string_view>
#include <utility>

namespace tyndall {
namespace {

/// Names of hosts are told without regard to case, and browsers write small letters.
std::string lowercase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// "localhost:8080" -> "localhost", "[::1]:8080" -> "[::1]". Any port: a tunnel has another one at its near end.
std::string_view name_of(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  if (colon == std::string_view::npos || host.find(']', colon) != std::string_view::npos) return host;
  return host.substr(0, colon);
}

/// Nobody can have an address resolve to another one.
bool is_address(std::string_view name) {
  if (name.size() > 2 && name.front() == '[' && name.back() == ']')
    return name.find_first_not_of("0123456789abcdefABCDEF:.", 1) == name.size() - 1;
  return !name.empty() && name.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace

RequestGuard::RequestGuard(const std::string& host, std::string token) : host_(lowercase(host)), token_(std::move(token)) {}

bool RequestGuard::is_host_of_page(const std::string& host) const {
  const std::string lower = lowercase(host);
  const std::string_view name = name_of(lower);
  return is_address(name) || name == "localhost" || (!host_.empty() && name == host_);
}

std::optional<HttpResponse> RequestGuard::refusal(const HttpRequest& request) const {
  if (!is_host_of_page(request.host)) return text_response(403, "this host is not served; ask for it by its address");
  if (request.method == "GET") return std::nullopt;
  if (request.method != "POST") return text_response(405, "only GET and POST are understood");
  if (lowercase(request.origin) != lowercase("http://" + request.host))
    return text_response(403, "this comes from another page");
  if (token_.empty() || request.token != token_) return text_response(403, "this comes from another page, or an older one");
  return std::nullopt;
}

std::string random_token() {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::random_device device;  // the system's, which can be used for keys
  std::string token;
  for (int word = 0; word < 4; ++word) {
    const std::uint32_t bits = device();
    for (int shift = 0; shift < 32; shift += 4) token += kDigits[bits >> shift & 15];
  }
  return token;
}

}  // namespace tyndall
