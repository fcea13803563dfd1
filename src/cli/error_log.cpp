#include "cli/error_log.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "report/diff_json.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {

void ErrorLog::add(double seconds, int samples, const Image& image) {
  nlohmann::ordered_json line{{"seconds", seconds}, {"samples", samples}};
  line.update(errors_json(reference_.error_of(image)));
  lines_ += line.dump() + "\n";
  last_samples_ = samples;
  failure_.clear();
  try {
    write_file(lines_, path_);
  } catch (const Error& error) {
    failure_ = error.what();
  }
}

void ErrorLog::resume(int samples) {
  std::ifstream file(path_);
  for (std::string text; std::getline(file, text);) {
    const auto line = nlohmann::json::parse(text, nullptr, false);
    if (!line.is_object() || !line.contains("samples") || !line["samples"].is_number_integer()) continue;
    const int at = line["samples"].get<int>();
    if (at > samples) continue;
    lines_ += text + "\n";
    last_samples_ = at;
  }
}

void ErrorLog::finish(const Rendering& rendering) {
  if (rendering.report.samples != last_samples_) add(rendering.report.seconds, rendering.report.samples, rendering.image);
}

void ErrorLog::require_written() const {
  if (!failure_.empty()) throw Error(Failure::output, failure_);
}

}  // namespace tyndall::cli
