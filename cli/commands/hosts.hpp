// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "commands/run.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave robot`: the robots of one host of a scenario, in this process.
struct RobotCommand {
  RunCommand run;
  std::string host;
  double manager_patience_s =
      0;  ///< Time to wait without an environment manager; 0: without limit.
};

/// `rave env`: the environment manager of a scenario that hosts share.
struct EnvCommand {
  RunCommand run;
  bool resume = false;  ///< Continue a run that has lost its manager.
};

/// Return 0 if the run completed for them, 1 if not, 2 on bad input.
[[nodiscard]] Result<int> robot(const RobotCommand& options);
[[nodiscard]] Result<int> env(const EnvCommand& options);

}  // namespace rave::cli
