#include "cli/viewer_link.h"

#include <fcntl.h>
#include <netdb.h>
#include <sys/poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "cli/log.h"
#include "io/tev_message.h"
#include "tyndall/error.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

constexpr int kTile = 128;        ///< pixels a side
constexpr int kLook = 50;         ///< milliseconds between looks whether to go on
constexpr double kPatience = 5;   ///< seconds without a byte taken, then the viewer is lost
constexpr double kLastWords = 1;  ///< seconds for the last picture

double now() {
  static const Timer kClock;
  return kClock.seconds();
}

bool is_number(const std::string& text) { return text.find_first_not_of("0123456789") == std::string::npos; }

/// "[::1]" is "::1" where a port follows.
std::string without_brackets(const std::string& host) {
  return host.size() > 2 && host.front() == '[' && host.back() == ']' ? host.substr(1, host.size() - 2) : host;
}

/// Ready for `what` (POLLIN ...) within the time of a look.
bool is_ready(int socket, short what) {
  pollfd wait{socket, what, 0};
  return poll(&wait, 1, kLook) > 0;
}

}  // namespace

ViewerLink::ViewerLink(const std::string& address, std::string name) : address_(address), name_(std::move(name)) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == address.size())
    throw Error(Failure::usage, "--display " + address + " is not understood; give HOST:PORT, such as 127.0.0.1:14158");
  const std::string host = without_brackets(address.substr(0, colon)), port = address.substr(colon + 1);
  if (is_number(port) && (port.size() > 5 || std::stoi(port) > 65535))  // else its lowest 16 bits would be taken
    throw Error(Failure::usage, "--display " + address + ": ports are at most 65535; give HOST:PORT");
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_socktype = SOCK_STREAM;
  const int problem = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found);
  if (problem != 0)
    throw Error(Failure::usage, "--display " + address + " is not known (" + gai_strerror(problem) + "); check host and port");
  addresses_ = {found, freeaddrinfo};
  thread_ = std::thread([this] { run(); });
}

ViewerLink::~ViewerLink() {
  {
    const std::lock_guard lock(mutex_);
    end_ = now() + kLastWords;
  }
  changed_.notify_one();
  thread_.join();
  if (socket_ >= 0) close(socket_);
}

void ViewerLink::show(Image image) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(image);
  }
  changed_.notify_one();
}

void ViewerLink::run() {
  for (;;) {
    Image image;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return next_ || end_; });
      if (!next_) return;
      image = std::move(*next_);
      next_.reset();
    }
    send_picture(image);
  }
}

void ViewerLink::send_picture(const Image& image) {
  if (socket_ < 0 && !connect()) return;
  std::vector<std::string> channels;
  for (const Channel& c : image.channels) channels.push_back(c.name);
  if (channels != created_) {
    if (!send(tev_create(name_, image))) return;
    created_ = channels;
  }
  for (int y = 0; y < image.height(); y += kTile) {
    for (int x = 0; x < image.width(); x += kTile) {
      if (is_outdated()) return;
      const PixelBounds tile{x, y, std::min(x + kTile, image.width()), std::min(y + kTile, image.height())};
      if (!send(tev_update(name_, image, tile))) return;
    }
  }
}

bool ViewerLink::connect() {
  created_.clear();
  std::string trouble;
  for (const addrinfo* address = addresses_.get(); address; address = address->ai_next) {
    trouble = trouble_with(*address);
    if (trouble.empty()) return true;
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
  }
  return lose(trouble), false;
}

/// Why it cannot be reached there; empty: it is.
std::string ViewerLink::trouble_with(const addrinfo& address) {
  socket_ = socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) return std::strerror(errno);
  if (::connect(socket_, address.ai_addr, address.ai_addrlen) != 0 && errno != EINPROGRESS) return std::strerror(errno);
  for (const double begin = now(); !is_ready(socket_, POLLOUT);)
    if (given_up() || now() - begin > kPatience) return "it does not answer";
  int problem = 0;
  socklen_t size = sizeof problem;
  getsockopt(socket_, SOL_SOCKET, SO_ERROR, &problem, &size);
  return problem != 0 ? std::strerror(problem) : "";
}

/// Whole, or the viewer is lost: half a message would garble all that follow.
bool ViewerLink::send(const std::string& message) {
  double last = now();
  for (std::size_t sent = 0; sent < message.size();) {
    const ssize_t count = ::send(socket_, message.data() + sent, message.size() - sent, MSG_NOSIGNAL);
    if (count > 0) {
      sent += static_cast<std::size_t>(count);
      last = now();
    } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
      return lose(std::strerror(errno)), false;
    } else if (given_up() || now() - last > kPatience) {
      return lose("it takes nothing any more"), false;
    } else {
      is_ready(socket_, POLLOUT);
    }
  }
  return true;
}

void ViewerLink::lose(const std::string& why) {
  if (!warned_) log("warning: --display {}: {}; the render goes on without\n", address_, why);
  warned_ = true;
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
}

bool ViewerLink::given_up() const {
  const std::lock_guard lock(mutex_);
  return end_ && now() > *end_;
}

bool ViewerLink::is_outdated() const {
  const std::lock_guard lock(mutex_);
  return next_.has_value() || (end_ && now() > *end_);
}

}  // namespace tyndall::cli
