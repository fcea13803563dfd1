#include "cli/print.h"

#include <cstdio>

#include "tyndall/error.h"

namespace tyndall::cli {
namespace {

[[noreturn]] void refuse() {
  throw Error(Failure::output, "stdout could not be written; see that what it goes to is open and has room");
}

}  // namespace

void print_text(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) refuse();
}

void print_now(const std::string& text) {
  print_text(text);
  finish_printing();
}

void finish_printing() {
  // A flush that failed leaves an empty buffer, and the mark of it.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) refuse();
}

}  // namespace tyndall::cli
