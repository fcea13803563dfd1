#include "serve/listener.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr int kBacklog = 16;  ///< connections that wait to be accepted

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

std::string text_of(const ServeAddress& a) {
  return "--serve " + (a.host.find(':') == std::string::npos ? a.host : "[" + a.host + "]") + ":" + std::to_string(a.port);
}

Addresses look_up(const ServeAddress& address) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  const int problem = getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
  if (problem != 0)
    throw Error(Failure::usage, text_of(address) + " is not known (" + gai_strerror(problem) + "); check the host");
  return Addresses(found);
}

/// Host or port of a socket's own address, in digits.
struct NumericAddress {
  std::string host, port;
};
NumericAddress own_address(int socket) {
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  char host[NI_MAXHOST] = "", port[NI_MAXSERV] = "";
  getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size);
  getnameinfo(reinterpret_cast<sockaddr*>(&own), size, host, sizeof host, port, sizeof port, NI_NUMERICHOST | NI_NUMERICSERV);
  return {host, port};
}

[[noreturn]] void fail(const ServeAddress& address, int problem) {
  const std::string advice = problem == EADDRINUSE ? "give another port, or none for one that is free"
                             : problem == EACCES   ? "give a port above 1023"
                                                   : "give a host of this machine";
  throw Error(Failure::run_time, text_of(address) + " cannot be listened on (" + std::strerror(problem) + "); " + advice);
}

}  // namespace

ServeAddress serve_address(const std::string& text) {
  ServeAddress address;
  if (text.empty()) return address;
  const std::size_t colon = text.rfind(':');
  std::string port = text;
  if (colon != std::string::npos) {
    address.host = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']')
    address.host = address.host.substr(1, address.host.size() - 2);
  const auto [end, problem] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (problem != std::errc() || end != port.data() + port.size() || address.port < 0 || address.port > 65535 ||
      address.host.empty())
    throw Error(Failure::usage, "--serve " + text + " is not understood; give a port, such as 8080, HOST:PORT, or nothing" +
                                    " (the scene then before it)");
  return address;
}

Listener::Listener(const ServeAddress& address) {
  const Addresses found = look_up(address);
  socket_ = ::socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) fail(address, errno);
  const int yes = 1;
  setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);  // what an earlier render's page left behind is over
  if (bind(socket_, found->ai_addr, found->ai_addrlen) != 0 || listen(socket_, kBacklog) != 0) {
    const int problem = errno;
    close(socket_);
    fail(address, problem);
  }
  const NumericAddress own = own_address(socket_);
  port_ = std::stoi(own.port);
  loopback_ = own.host.starts_with("127.") || own.host == "::1";
}

Listener::~Listener() { close(socket_); }

void Listener::wake() const { shutdown(socket_, SHUT_RD); }

}  // namespace tyndall
