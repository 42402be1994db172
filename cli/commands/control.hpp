// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus_options.hpp"
#include "rave/base/result.hpp"
#include "rave/control/protocol.hpp"

// Requests from one terminal to a run in another.
namespace rave::cli {

/// `rave ps`.
struct PsCommand {
  bool robots = false;   ///< Each robot in a line of its own.
  bool network = false;  ///< Also the runs on the bus; implied if `bus` selects one.
  BusOptions bus;
};

/// `rave stop`.
struct StopCommand {
  std::string run;  ///< Empty: the only one.
  std::string robot;
  bool all = false;  ///< All robots of all runs on this machine.
  BusOptions bus;
};

/// `rave arm`.
struct ArmCommand {
  std::string run;
  std::string robot;
  bool release = false;  ///< Ends a stop first.
  BusOptions bus;
};

/// `rave set`.
struct SetCommand {
  std::string run;
  std::string robot;
  std::string key;
  std::string value;
  BusOptions bus;
};

/// `rave pause`, `rave resume` and `rave step`.
struct HoldCommand {
  control::ProcessAction what = control::Pause();  ///< Or resume, step.
  std::string run;
  std::uint64_t count = 1;
  BusOptions bus;
};

// `bus` selects where to search for a run that is not on this machine. Each prints what was done.
// Returns 0; 1 if the run refuses; 2 if there is no such run, or it does not answer.
[[nodiscard]] Result<int> list_runs(const PsCommand& options);
[[nodiscard]] Result<int> stop_robots(const StopCommand& options);
[[nodiscard]] Result<int> arm_robots(const ArmCommand& options);
[[nodiscard]] Result<int> set_parameter(const SetCommand& options);
[[nodiscard]] Result<int> hold_run(const HoldCommand& options);

}  // namespace rave::cli
