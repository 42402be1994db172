// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "rave/base/ids.hpp"

namespace rave::sim {

/// Which of the two sets of drivers of a robot (RobotSpec::twin).
enum class DriverSet : std::uint8_t {
  kFirst,  ///< RobotSpec::type: serves the robot when the run begins.
  kTwin,   ///< RobotSpec::twin.
};

/// A hand-over that belongs to the run: begins before the step `step` senses.
struct ScheduledHandOver {
  std::uint64_t step = 0;
  RobotId robot;
  DriverSet to = DriverSet::kTwin;
};

/// How it stands with the hand-overs of a robot that has two sets of drivers.
struct HandOverState {
  DriverSet active = DriverSet::kFirst;
  bool under_way = false;
  bool by_hand = false;              ///< While it is under way: somebody asked for it.
  DriverSet to = DriverSet::kFirst;  ///< While it is under way: where it leads.
  std::uint32_t made = 0;
  std::uint32_t refused = 0;
  std::string last;  ///< What the last one said, made or refused; empty before the first.
};

}  // namespace rave::sim
