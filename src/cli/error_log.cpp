#include "cli/error_log.h"

#include <nlohmann/json.hpp>

#include "tyndall/io.h"

namespace tyndall::cli {

ErrorLog::ErrorLog(const std::string& reference, const std::string& path, const PixelBounds& pixels)
    : reference_(read_reference(reference)), path_(path) {
  reference_.require_size(pixels);
}

void ErrorLog::add(double seconds, int samples, const Image& image) {
  const ErrorMetrics e = reference_.error_of(image);
  const nlohmann::ordered_json line{{"seconds", seconds}, {"samples", samples}, {"mse", e.mse}, {"relmse", e.relmse},
                                    {"relmse_trimmed", e.relmse_trimmed}, {"mape", e.mape}, {"smape", e.smape}};
  lines_ += line.dump() + "\n";
  last_samples_ = samples;
  write_file(lines_, path_);
}

void ErrorLog::finish(const Rendering& rendering) {
  if (rendering.report.samples != last_samples_) add(rendering.report.seconds, rendering.report.samples, rendering.image);
}

}  // namespace tyndall::cli
