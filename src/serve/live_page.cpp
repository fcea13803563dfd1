#include "serve/live_page.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page.h"

namespace tyndall {
namespace {

constexpr double kLeastSeconds = 2, kPictureShare = 0.01, kDenoisedShare = 0.05;

/// As a URL has it.
std::string in_brackets(const std::string& host) { return host.find(':') == std::string::npos ? host : "[" + host + "]"; }

/// "/picture/3/0" -> "picture", "3", "0".
std::vector<std::string> steps_of(const std::string& path) {
  std::vector<std::string> steps;
  for (std::size_t begin = 1; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    steps.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return steps;
}

std::optional<std::uint64_t> number_in(const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Nothing but the page's own script runs, and it talks to this server only.
std::string content_policy(const std::string& nonce) {
  return "default-src 'none'; script-src 'nonce-" + nonce +
         "'; style-src 'unsafe-inline'; img-src data:; connect-src 'self'; " +
         "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

HttpResponse page_response(const std::string& title, const std::string& token) {
  const std::string nonce = random_token();
  return {.type = "text/html; charset=utf-8",
          .body = std::make_shared<const std::string>(live_page({{"title", title}, {"token", token}}, nonce)),
          .headers = {{"Content-Security-Policy", content_policy(nonce)}}};
}

std::string_view name_of(ServedPicture::Kind kind) {
  switch (kind) {
    case ServedPicture::Kind::error:
      return "error";
    case ServedPicture::Kind::samples:
      return "samples";
    case ServedPicture::Kind::light:
      break;
  }
  return "light";
}

bool is_aov(const ServedPicture& p) { return p.name != "rendered" && p.name != "denoised"; }

std::vector<ServedPicture> with_errors(std::vector<ServedPicture> pictures, std::vector<float> errors) {
  if (errors.empty() || pictures.empty()) return pictures;
  auto image = std::make_shared<Image>();
  image->data = image->display = pictures.front().image->data;
  image->add_channel("Error").values = std::move(errors);
  const auto aovs = std::find_if(pictures.begin(), pictures.end(), is_aov);
  pictures.insert(aovs,
                  {.name = "error estimate", .kind = ServedPicture::Kind::error, .image = std::move(image), .channels = {0}});
  return pictures;
}

HttpResponse no_such_page() { return text_response(404, "there is no such page"); }

}  // namespace

LivePage::LivePage(Setup setup)
    : host_(in_brackets(setup.address.host)),
      cancel_(std::move(setup.cancel)),
      last_words_(setup.last_words),
      guard_(host_, random_token()),
      page_(page_response(setup.title, guard_.token())),
      picture_pace_(kLeastSeconds, kPictureShare),
      denoised_pace_(kLeastSeconds, kDenoisedShare),
      server_(std::make_unique<HttpServer>(setup.address, [this](const HttpRequest& request) { return answer(request); })) {}

std::string LivePage::url() const { return "http://" + host_ + ":" + std::to_string(server_->listener().port()) + "/"; }

void LivePage::begin(const std::string& stage, const std::string& output, const std::string& next) {
  const std::lock_guard lock(mutex_);
  if (output != output_) denoised_.clear();
  stage_ = stage;
  next_ = next;
  output_ = output;
}

void LivePage::show(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  progress_ = progress;
}

bool LivePage::is_watched() const {
  const std::lock_guard lock(mutex_);
  return viewers_.any();
}

bool LivePage::wants_picture() const {
  const std::lock_guard lock(mutex_);
  return viewers_.any() && picture_pace_.is_due();
}

bool LivePage::wants_denoised() const {
  const std::lock_guard lock(mutex_);
  return viewers_.any() && denoised_pace_.is_due();
}

void LivePage::show(Picture picture) {
  std::vector<ServedPicture> pictures =
      with_errors(pictures_of(std::make_shared<const Image>(std::move(picture.image))), std::move(picture.errors));
  const std::lock_guard lock(mutex_);
  picture_pace_.did(picture.seconds);
  rendered_ = std::move(pictures);
  relmse_ = picture.relmse;
  ++version_;
}

void LivePage::show_denoised(Image image, double seconds) {
  std::vector<ServedPicture> pictures = pictures_of(std::make_shared<const Image>(std::move(image)));
  std::erase_if(pictures, [](const ServedPicture& p) { return p.name != "denoised"; });
  const std::lock_guard lock(mutex_);
  denoised_pace_.did(seconds);
  denoised_ = std::move(pictures);
  ++version_;
}

void LivePage::end(const std::string& outcome) {
  std::unique_lock lock(mutex_);
  stage_ = "ended";
  outcome_ = outcome;
  ++version_;
  asked_.wait_for(lock, last_words_, [this] { return !viewers_.any_behind(version_); });
}

HttpResponse LivePage::answer(const HttpRequest& request) {
  if (auto refusal = guard_.refusal(request)) return *std::move(refusal);
  const std::vector<std::string> path = steps_of(request.path);
  if (request.method == "POST") return request.path == "/cancel" ? cancel() : no_such_page();
  if (request.path == "/") return page_;
  if (path[0] == "state" && (path.size() == 1 || path.size() == 3)) return state(path);
  if (path[0] == "picture" && path.size() == 3) return picture(path);
  return no_such_page();
}

HttpResponse LivePage::state(const std::vector<std::string>& path) {
  const std::lock_guard lock(mutex_);
  if (path.size() == 3) {
    const auto version = number_in(path[2]);
    if (!version || path[1].size() > 32) return no_such_page();
    viewers_.add(path[1], *version);
    asked_.notify_all();
  }
  return {.type = "application/json", .body = std::make_shared<const std::string>(state_text())};
}

HttpResponse LivePage::picture(const std::vector<std::string>& path) {
  const auto version = number_in(path[1]), number = number_in(path[2]);
  ServedPicture picture;
  {
    const std::lock_guard lock(mutex_);
    const std::vector<const ServedPicture*> all = pictures();
    if (version != version_ || !number || *number >= all.size()) return no_such_page();
    picture = *all[*number];
  }
  return {.type = "application/octet-stream", .body = std::make_shared<const std::string>(halves_of(picture))};
}

HttpResponse LivePage::cancel() {
  {
    const std::lock_guard lock(mutex_);
    if (cancelled_) return text_response(200, "it is stopping already");
    cancelled_ = true;
  }
  cancel_();
  return text_response(200, "it is stopping");
}

/// What was denoised last stands behind what was rendered.
std::vector<const ServedPicture*> LivePage::pictures() const {
  std::vector<const ServedPicture*> all;
  for (const ServedPicture& p : rendered_) all.push_back(&p);
  const bool has_denoised = std::any_of(all.begin(), all.end(), [](const auto* p) { return p->name == "denoised"; });
  if (!has_denoised && !all.empty()) {
    for (const ServedPicture& p : denoised_) all.insert(all.begin() + 1, &p);
  }
  return all;
}

std::string LivePage::state_text() const {
  nlohmann::ordered_json state{{"stage", stage_},
                               {"next", next_},
                               {"output", output_},
                               {"outcome", outcome_},
                               {"cancelled", cancelled_},
                               {"preparing", progress_.preparing},
                               {"samples", progress_.samples_done},
                               {"fraction", progress_.fraction},
                               {"seconds", progress_.seconds},
                               {"remaining", progress_.remaining},
                               {"relmse", nullptr},
                               {"version", version_},
                               {"pictures", nlohmann::ordered_json::array()}};
  if (relmse_ && std::isfinite(*relmse_)) state["relmse"] = *relmse_;
  for (const ServedPicture* p : pictures()) {
    state["pictures"].push_back({{"name", p->name},
                                 {"kind", name_of(p->kind)},
                                 {"planes", p->channels.size()},
                                 {"x", p->image->data.x0},
                                 {"y", p->image->data.y0},
                                 {"width", p->image->width()},
                                 {"height", p->image->height()}});
  }
  return state.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace tyndall
