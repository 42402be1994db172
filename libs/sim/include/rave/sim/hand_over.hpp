// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "rave/base/ids.hpp"

namespace rave::sim {

/// Selects one of the two sets of drivers of a robot (RobotSpec::twin).
enum class DriverSet : std::uint8_t {
  kFirst,  ///< RobotSpec::type, which is active at the start of the run.
  kTwin,   ///< RobotSpec::twin.
};

/// A hand-over that is part of the run. It begins before step `step` senses.
struct ScheduledHandOver {
  std::uint64_t step = 0;
  RobotId robot;
  DriverSet to = DriverSet::kTwin;
};

/// The hand-over state of a robot with two sets of drivers.
struct HandOverState {
  DriverSet active = DriverSet::kFirst;
  bool under_way = false;
  bool by_hand = false;              ///< If under_way: whether it was requested by hand.
  DriverSet to = DriverSet::kFirst;  ///< If under_way: the target.
  std::uint32_t made = 0;
  std::uint32_t refused = 0;
  std::string last;  ///< Message of the last hand-over, made or refused; empty before the first.
};

}  // namespace rave::sim
