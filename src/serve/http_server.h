/// Answers browsers from a thread of its own.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

#include "serve/http_message.h"
#include "serve/listener.h"

struct MHD_Daemon;

namespace tyndall {

/// What a client may take. Whoever asks for more is refused or hung up on.
struct HttpLimits {
  unsigned connections = 16;    ///< at once; more wait
  std::size_t head = 16384;     ///< bytes of a connection's memory, for the heads of request and answer
  unsigned idle_seconds = 10;   ///< without a byte
  double request_seconds = 60;  ///< from one request's end to the next one's, however slowly it trickles
  int large_answers = 4;        ///< on their way at once, of those above kLargeAnswer
};
inline constexpr std::size_t kLargeAnswer = 65536;  ///< bytes

/// HTTP/1.1, one thread for all connections: a client that is slow makes no other one wait, nor whoever made the server.
class HttpServer {
 public:
  /// Called by the server's thread.
  using Handler = std::function<HttpResponse(const HttpRequest&)>;

  /// Throws Error as Listener does.
  HttpServer(const ServeAddress& address, Handler handler, const HttpLimits& limits = {});
  ~HttpServer();  ///< hangs up on everyone
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  const Listener& listener() const { return listener_; }

 private:
  class Connections;
  struct StopDaemon {
    void operator()(MHD_Daemon* daemon) const;
  };
  void run();

  Listener listener_;
  std::unique_ptr<Connections> connections_;
  std::unique_ptr<MHD_Daemon, StopDaemon> daemon_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace tyndall
