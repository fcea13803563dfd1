/// The one exception Tyndall throws, and the place in a file it can point at.
#pragma once

#include <stdexcept>
#include <string>

namespace tyndall {

/// A place in a scene file. `line` and `column` count from 1; 0 means "the file as a whole".
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  std::string str() const;  ///< "file:line:column", or "file"
};

/// What kind of failure it was; the values are the command line's exit codes.
enum class Failure {
  run_time = 1,    ///< rendering could not go on
  usage = 2,       ///< wrong options
  scene = 3,       ///< a scene or an asset of it is missing, broken or contradictory
  output = 4,      ///< a result could not be written
  differs = 5,     ///< a comparison found a difference
  incomplete = 7,  ///< some of the work was left undone
};

/// Thrown for everything that can fail. The message says where, what, and what to do:
/// `hall.pbrt:41:7: medium "smoke" is not defined; define it with MakeNamedMedium before line 41`.
class Error : public std::runtime_error {
 public:
  Error(Failure failure, const std::string& message);
  Error(const Location& where, const std::string& message);  ///< Failure::scene, "where: message"

  Failure failure() const { return failure_; }
  const Location& where() const { return where_; }  ///< that the message begins with; no file: it begins with none

 private:
  Failure failure_;
  Location where_;
};

}  // namespace tyndall
