#include <csignal>
#include <exception>
#include <new>

#include "cli/command.h"
#include "cli/log.h"
#include "cli/print.h"
#include "report/shell_quote.h"
#include "tyndall/error.h"
#include "tyndall/render.h"

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 run-time failure, 2 usage, 3 scene or asset, 4 output, 5 differs, 7 incomplete,\n"
    "130/143 interrupted (render, compare and regress keep what is complete).";

/// To be pasted into a shell.
std::string command_line(int argc, char** argv) {
  std::string line = "tyndall";
  for (int i = 1; i < argc; ++i) line += " " + tyndall::shell_quoted(argv[i]);
  return line;
}

int run(int argc, char** argv) {
  CLI::App app("Tyndall renders smoke, cloud and fire lit by many lights.", "tyndall");
  app.set_version_flag("--version", "tyndall " + std::string(tyndall::version()));
  app.require_subcommand(0, 1);
  app.footer(kExitCodes);
  int exit_code = 0;
  tyndall::cli::add_render(app, exit_code, command_line(argc, argv));
  tyndall::cli::add_info(app, exit_code);
  tyndall::cli::add_check(app, exit_code);
  tyndall::cli::add_merge(app, exit_code);
  tyndall::cli::add_denoise(app, exit_code);
  tyndall::cli::add_relight(app, exit_code);
  tyndall::cli::add_matte(app, exit_code);
  tyndall::cli::add_flatten(app, exit_code);
  tyndall::cli::add_status(app, exit_code);
  tyndall::cli::add_farm(app, exit_code);
  tyndall::cli::add_compare(app, exit_code, command_line(argc, argv));
  tyndall::cli::add_example(app, exit_code);
  tyndall::cli::add_diff(app, exit_code);
  tyndall::cli::add_regress(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    tyndall::cli::log("tyndall: {}; see tyndall --help\n", e.what());
    return static_cast<int>(tyndall::Failure::usage);
  }
  if (app.get_subcommands().empty()) tyndall::cli::print_text(app.help());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a write that cannot be done returns an error and gets a message
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);
#endif
  try {
    const int exit_code = run(argc, argv);
    tyndall::cli::finish_printing();
    return exit_code;
  } catch (const tyndall::Error& e) {
    tyndall::cli::log("tyndall: {}\n", e.what());
    return static_cast<int>(e.failure());
  } catch (const std::bad_alloc&) {
    tyndall::cli::log("tyndall: out of memory; give the scene a smaller resolution, fewer lights or smaller volumes\n");
  } catch (const std::exception& e) {
    tyndall::cli::log("tyndall: {}\n", e.what());
  }
  return static_cast<int>(tyndall::Failure::run_time);
}
