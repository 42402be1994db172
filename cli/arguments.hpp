// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "rave/base/result.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// What a command line asks for, with its options. Returns the exit code; an error is printed, and
/// its exit code is kBadInput.
using Command = std::function<Result<int>()>;

// Each adds the subcommands of a file to `root`. When the command line names one of them, it
// becomes `chosen`.
void add_run_commands(CLI::App& root, Command& chosen);         ///< `run`, `robot` and `env`.
void add_file_commands(CLI::App& root, Command& chosen);        ///< About files, drivers, projects.
void add_record_commands(CLI::App& root, Command& chosen);      ///< About recordings.
void add_control_commands(CLI::App& root, Command& chosen);     ///< For runs in progress.
void add_bench_commands(CLI::App& root, Command& chosen);       ///< Below `bench`.
void add_experiment_commands(CLI::App& root, Command& chosen);  ///< `sweep`, `branch`, `diff`.
void add_keys_commands(CLI::App& root, Command& chosen);        ///< Below `keys`.
void add_people_commands(CLI::App& root, Command& chosen);      ///< Below `people`.
void add_watch_commands(CLI::App& root, Command& chosen);       ///< `top` and `doctor`.

/// Does what a command line asks for, and prints help and complaints. Returns the exit code.
[[nodiscard]] int run_command_line(int argc, const char* const* argv);

}  // namespace rave::cli
