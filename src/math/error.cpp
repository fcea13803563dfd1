#include "tyndall/error.h"

namespace tyndall {

std::string Location::str() const {
  if (line <= 0) return file;
  return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

Error::Error(Failure failure, const std::string& message) : std::runtime_error(message), failure_(failure) {}

Error::Error(const Location& where, const std::string& message)
    : std::runtime_error(where.file.empty() ? message : where.str() + ": " + message),
      failure_(Failure::scene),
      where_(where) {}

}  // namespace tyndall
