/// The socket on which a page is served.
#pragma once

#include <string>

namespace tyndall {

struct ServeAddress {
  std::string host = "127.0.0.1";
  int port = 0;  ///< 0: any that is free
};

/// "", "PORT" or "HOST:PORT", an IPv6 host in brackets. Throws Error (usage).
ServeAddress serve_address(const std::string& text);

/// Listens from when it is made.
class Listener {
 public:
  /// Throws Error: usage for a host that is not known, run_time for a place that is taken or not allowed.
  explicit Listener(const ServeAddress& address);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int socket() const { return socket_; }
  int port() const { return port_; }
  bool is_loopback() const { return loopback_; }  ///< nobody on another machine can reach it
  void wake() const;                              ///< whoever waits for a connection

 private:
  int socket_ = -1, port_ = 0;
  bool loopback_ = false;
};

}  // namespace tyndall
