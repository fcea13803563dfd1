#include <cerrno>
#include <cstring>

#include "io/atomic_file.h"
#include "tyndall/io.h"

namespace tyndall {

void write_file(std::string_view bytes, const std::string& path) {
  AtomicFile file(path);
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.stream()) != bytes.size()) file.fail(std::strerror(errno));
  file.close();
  file.require_holds(bytes);
  file.commit();
}

}  // namespace tyndall
