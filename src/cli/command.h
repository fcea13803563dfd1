/// The subcommands: each adds itself to the parser and leaves its exit code in `exit_code` when it has run.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tyndall::cli {

void add_info(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
/// `command_line`: what was typed, for slices and reports to say.
void add_render(CLI::App& app, int& exit_code, const std::string& command_line);
void add_compare(CLI::App& app, int& exit_code, const std::string& command_line);
void add_denoise(CLI::App& app, int& exit_code);
void add_relight(CLI::App& app, int& exit_code);
void add_matte(CLI::App& app, int& exit_code);
void add_flatten(CLI::App& app, int& exit_code);
void add_status(CLI::App& app, int& exit_code);
void add_farm(CLI::App& app, int& exit_code);
void add_example(CLI::App& app, int& exit_code);
void add_diff(CLI::App& app, int& exit_code);
void add_regress(CLI::App& app, int& exit_code);

}  // namespace tyndall::cli
