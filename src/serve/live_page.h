/// The page that shows a render as it goes.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "serve/http_server.h"
#include "serve/pace.h"
#include "serve/picture_set.h"
#include "serve/request_guard.h"
#include "serve/viewers.h"
#include "tyndall/render.h"

namespace tyndall {

/// Served from a thread of its own, which reads what is shown here and nothing else: no file, no scene. While
/// somebody looks, pictures are wanted every other second.
///
///   GET /                        the page
///   GET /state[/VIEWER/VERSION]  where the render stands, as JSON; VERSION: of the state that the viewer shows
///   GET /picture/VERSION/NUMBER  half floats, as halves_of() has them; VERSION: of the pictures
///   POST /cancel                 ends the render as an interrupt does; with the page's origin and token
class LivePage {
 public:
  struct Setup {
    ServeAddress address{};
    std::string title;             ///< of the page
    std::function<void()> cancel;  ///< called once at most, by the server's thread
    int last_words = 2;            ///< seconds that end() waits at most
  };
  /// Throws Error as HttpServer does.
  explicit LivePage(Setup setup);

  std::string url() const;
  bool is_loopback() const { return server_->listener().is_loopback(); }

  /// What goes on: "building", "rendering", "denoising" or "writing", of the picture `output`. `next`: what takes time after
  /// it.
  void begin(const std::string& stage, const std::string& output, const std::string& next = {});
  void show(const Progress& progress);

  bool is_watched() const;
  /// Whether somebody looks, and the last picture is old enough for another one to cost little.
  bool wants_picture() const;
  bool wants_denoised() const;
  /// `errors`: of each pixel, for false colours; empty: not known. `seconds`: that it took to make.
  struct Picture {
    Image image;
    std::vector<float> errors{};
    double relmse = 0;
    double seconds = 0;
  };
  void show(Picture picture);
  /// Beside what is shown, until there is another one.
  void show_denoised(Image image, double seconds);

  /// The last word, when all is written. Waits until those who look have the last picture.
  void end(const std::string& outcome);

 private:
  HttpResponse answer(const HttpRequest& request);
  HttpResponse state(const std::vector<std::string>& path);
  HttpResponse picture(const std::vector<std::string>& path);
  HttpResponse cancel();
  std::string state_text() const;
  std::vector<const ServedPicture*> pictures() const;

  std::string host_;
  std::function<void()> cancel_;
  std::chrono::seconds last_words_;
  RequestGuard guard_;
  HttpResponse page_;

  mutable std::mutex mutex_;
  std::condition_variable asked_;
  Viewers viewers_;
  Pace picture_pace_, denoised_pace_;
  std::string stage_ = "building", next_, output_, outcome_;
  Progress progress_;
  std::optional<double> relmse_;
  std::vector<ServedPicture> rendered_, denoised_;
  std::uint64_t version_ = 0;  ///< of the pictures, or what is told at the end
  bool cancelled_ = false;

  std::unique_ptr<HttpServer> server_;  ///< last: its thread uses all of the above
};

}  // namespace tyndall
