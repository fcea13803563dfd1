#include "serve/http_server.h"

#include <microhttpd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <map>

#include "tyndall/error.h"
#include "tyndall/timer.h"

namespace tyndall {
namespace {

constexpr int kLook = 1000;  ///< milliseconds between looks at who has taken too long

struct DestroyResponse {
  void operator()(MHD_Response* response) const { MHD_destroy_response(response); }
};

/// No other page may read, show or guess what is served, and nothing of it is kept.
constexpr std::pair<const char*, const char*> kHeaders[] = {{"Cache-Control", "no-store"},
                                                            {"X-Content-Type-Options", "nosniff"},
                                                            {"X-Frame-Options", "DENY"},
                                                            {"Cross-Origin-Resource-Policy", "same-origin"},
                                                            {"Referrer-Policy", "no-referrer"}};

std::string header_of(MHD_Connection* connection, const char* name) {
  const char* value = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
  return value ? value : "";
}

bool announces_body(MHD_Connection* connection) {
  const std::string length = header_of(connection, "Content-Length");
  return (!length.empty() && length != "0") || !header_of(connection, "Transfer-Encoding").empty();
}

HttpRequest request_of(MHD_Connection* connection, const char* path, const char* method) {
  return {.method = method,
          .path = path,
          .host = header_of(connection, "Host"),
          .origin = header_of(connection, "Origin"),
          .token = header_of(connection, "X-Tyndall-Token")};
}

void release_body(void* body) { delete static_cast<std::shared_ptr<const std::string>*>(body); }

/// MHD takes a pointer that is not const, and reads only.
std::unique_ptr<MHD_Response, DestroyResponse> message_of(const HttpResponse& answer) {
  auto body = std::make_unique<std::shared_ptr<const std::string>>(answer.body);
  std::unique_ptr<MHD_Response, DestroyResponse> message(MHD_create_response_from_buffer_with_free_callback_cls(
      answer.body->size(), const_cast<char*>(answer.body->data()), release_body, body.get()));
  if (!message) throw std::bad_alloc();
  body.release();
  MHD_add_response_header(message.get(), "Content-Type", answer.type.c_str());
  for (const auto& [name, value] : kHeaders) MHD_add_response_header(message.get(), name, value);
  for (const auto& [name, value] : answer.headers) MHD_add_response_header(message.get(), name.c_str(), value.c_str());
  return message;
}

}  // namespace

/// Who is there, and what MHD calls. All of it by the server's thread.
class HttpServer::Connections {
 public:
  Connections(Handler handler, const HttpLimits& limits) : handler_(std::move(handler)), limits_(limits) {}

  /// Hangs up on those that have not got to a request's end for too long.
  void tidy() const {
    for (const auto& [connection, state] : open_) {
      if (state.since.seconds() > limits_.request_seconds) shutdown(state.socket, SHUT_RDWR);
    }
  }

  static void notify(void* self, MHD_Connection* connection, void**, MHD_ConnectionNotificationCode what) {
    auto& open = static_cast<Connections*>(self)->open_;
    if (what == MHD_CONNECTION_NOTIFY_CLOSED) {
      open.erase(connection);
    } else {
      open[connection].socket = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
    }
  }

  static void completed(void* self, MHD_Connection* connection, void**, MHD_RequestTerminationCode) {
    const auto found = static_cast<Connections*>(self)->open_.find(connection);
    if (found != static_cast<Connections*>(self)->open_.end()) found->second = {.socket = found->second.socket};
  }

  /// Called when the head is there, and again when the request is. Who is answered the first time is hung up on.
  static MHD_Result answer(void* self, MHD_Connection* connection, const char* path, const char* method, const char*,
                           const char*, std::size_t*, void** seen) {
    const bool first = *seen == nullptr, has_body = announces_body(connection);
    *seen = self;
    if (first && !has_body) return MHD_YES;
    try {
      const HttpResponse response =
          has_body ? text_response(413, "a body is not read")
                   : static_cast<Connections*>(self)->respond(connection, request_of(connection, path, method));
      const auto message = message_of(response);
      return MHD_queue_response(connection, static_cast<unsigned>(response.status), message.get());
    } catch (const std::exception&) {
      return MHD_NO;  // out of memory, as a rule: hangs up
    }
  }

 private:
  HttpResponse respond(MHD_Connection* connection, const HttpRequest& request) {
    HttpResponse response = handler_(request);
    if (response.body->size() <= kLargeAnswer) return response;
    int large = 0;
    for (const auto& [other, state] : open_) large += state.large ? 1 : 0;
    if (large >= limits_.large_answers) return text_response(503, "too much is on its way already; ask again");
    open_[connection].large = true;
    return response;
  }

  struct State {
    int socket = -1;
    Timer since{};  ///< the connection, or the end of its last request
    bool large = false;
  };

  Handler handler_;
  HttpLimits limits_;
  std::map<MHD_Connection*, State> open_;
};

void HttpServer::StopDaemon::operator()(MHD_Daemon* daemon) const { MHD_stop_daemon(daemon); }

HttpServer::HttpServer(const ServeAddress& address, Handler handler, const HttpLimits& limits)
    : listener_(address), connections_(std::make_unique<Connections>(std::move(handler), limits)) {
  const int socket = dup(listener_.socket());  // MHD closes its own
  daemon_.reset(MHD_start_daemon(MHD_USE_EPOLL, 0, nullptr, nullptr, Connections::answer, connections_.get(),  //
                                 MHD_OPTION_LISTEN_SOCKET, socket,                                             //
                                 MHD_OPTION_CONNECTION_LIMIT, limits.connections,                              //
                                 MHD_OPTION_CONNECTION_MEMORY_LIMIT, limits.head,                              //
                                 MHD_OPTION_CONNECTION_TIMEOUT, limits.idle_seconds,                           //
                                 MHD_OPTION_NOTIFY_CONNECTION, Connections::notify, connections_.get(),        //
                                 MHD_OPTION_NOTIFY_COMPLETED, Connections::completed, connections_.get(),      //
                                 MHD_OPTION_END));
  if (!daemon_) {
    close(socket);
    throw Error(Failure::run_time, "--serve: the server cannot be started; leave it out");
  }
  thread_ = std::thread([this] { run(); });
}

HttpServer::~HttpServer() {
  ended_ = true;
  listener_.wake();
  thread_.join();
}

void HttpServer::run() {
  while (!ended_) {
    if (MHD_run_wait(daemon_.get(), kLook) != MHD_YES) return;
    connections_->tidy();
  }
}

}  // namespace tyndall
