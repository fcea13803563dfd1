/// The picture of a running render in a viewer that speaks tev's protocol.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tyndall/image.h"

struct addrinfo;

namespace tyndall::cli {

/// Sends pictures from a thread of its own. A viewer that is slow gets those tiles that it takes, of the last picture; one that
/// is not there, or goes, costs a warning and no render.
class ViewerLink {
 public:
  /// `address`: HOST:PORT, looked up now. `name`: of the picture in the viewer. Throws Error (usage).
  ViewerLink(const std::string& address, std::string name);
  /// Waits for the last picture to be sent, a second at most.
  ~ViewerLink();
  ViewerLink(const ViewerLink&) = delete;
  ViewerLink& operator=(const ViewerLink&) = delete;

  void show(Image image);  ///< takes the place of one that is not sent yet

 private:
  void run();
  void send_picture(const Image& image);
  bool connect();
  std::string trouble_with(const addrinfo& address);
  bool send(const std::string& message);
  void lose(const std::string& why);
  bool given_up() const;     ///< the end has come, and its second is over
  bool is_outdated() const;  ///< a newer picture waits

  std::string address_, name_;
  std::shared_ptr<addrinfo> addresses_;  ///< of the host: any will do
  int socket_ = -1;
  bool warned_ = false;
  std::vector<std::string> created_;  ///< channels of the picture that the viewer has

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Image> next_;
  std::optional<double> end_;  ///< on the clock below: no longer than this
  std::thread thread_;
};

}  // namespace tyndall::cli
