// A client of a server on this machine that does as it is told, well or badly.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace tyndall::test {

class HttpClient {
 public:
  explicit HttpClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
  }
  ~HttpClient() { close(socket_); }
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  bool connected() const { return connected_; }
  /// False: it was hung up on.
  bool send(const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return false;
      sent += static_cast<std::size_t>(count);
    }
    return true;
  }
  /// Something to be read, or the end.
  bool hears_within(int milliseconds) const {
    pollfd wait{socket_, POLLIN, 0};
    return poll(&wait, 1, milliseconds) > 0;
  }
  /// Until the server hangs up.
  std::string read_all() {
    std::string text;
    char part[4096];
    for (ssize_t count; (count = recv(socket_, part, sizeof part, 0)) > 0;) text.append(part, static_cast<std::size_t>(count));
    return text;
  }

 private:
  int socket_;
  bool connected_ = false;
};

/// The answer to one request, head and body. `head`: further lines, each with its end.
inline std::string ask(int port, const std::string& method, const std::string& path, const std::string& head = "") {
  HttpClient client(port);
  const bool has_host = head.starts_with("Host:");
  client.send(method + " " + path + " HTTP/1.1\r\n" + (has_host ? "" : "Host: 127.0.0.1:" + std::to_string(port) + "\r\n") +
              head + "Connection: close\r\n\r\n");
  return client.read_all();
}

inline int status_of(const std::string& answer) { return answer.size() < 12 ? 0 : std::atoi(answer.c_str() + 9); }
inline std::string body_of(const std::string& answer) {
  const std::size_t end = answer.find("\r\n\r\n");
  return end == std::string::npos ? "" : answer.substr(end + 4);
}

}  // namespace tyndall::test
