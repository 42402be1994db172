// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bus_options.hpp"
#include "rave/base/result.hpp"

// Robots with two sets of drivers, and the shadows of real ones.
namespace rave::cli {

/// `rave hand-over`.
struct HandOverCommand {
  std::string robot;
  std::string to;   ///< `real`, `simulated`, `first` or `twin`.
  std::string run;  ///< Empty: the only one.
  BusOptions bus;   ///< Where to look for a run that is not on this machine.
};

/// `rave shadow`.
struct ShadowCommand {
  std::string run;
  std::string robot;   ///< Empty: all that have one.
  bool reset = false;  ///< Put the shadow where the robot is.
  bool json = false;
  BusOptions bus;  ///< As of HandOverCommand.
};

/// Waits until the robot has its other drivers and says so. Returns 0; 1 if that is refused, by the
/// run or after a while by the drivers; 2 if there is no such run.
[[nodiscard]] Result<int> hand_over(const HandOverCommand& options);
/// Prints how far shadows are from their robots. Returns 0; 1 if the run has none; 2 if there is no
/// such run.
[[nodiscard]] Result<int> show_shadows(const ShadowCommand& options);

}  // namespace rave::cli
