// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/hosts.hpp"
#include "commands/run.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// What those that run or host something are given.
struct RunCommands {
  RunCommand run;
  RobotCommand robot;
  EnvCommand env;
};

/// Adds `run`, `robot` and `env`, which write what they are given to `commands`.
void add_run_commands(CLI::App& root, RunCommands& commands);

/// What all that run something have in common: output, seed, threads, time, pace and the like.
void add_run_options(CLI::App& app, RunCommand& c);

}  // namespace rave::cli
