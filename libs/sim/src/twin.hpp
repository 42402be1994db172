// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "opening_note.hpp"
#include "rave/sim/hand_over.hpp"
#include "rave/sim/world_input.hpp"
#include "robot_group.hpp"
#include "side_task.hpp"

namespace rave::sim {

[[nodiscard]] inline std::string_view reality_of(const RobotType& type) noexcept {
  return type.simulated ? "simulated" : "real";
}

/// A robot with two sets of drivers. Its group has it alone; controllers and program stay there,
/// whichever set serves.
struct Twin {
  enum class Stage : std::uint8_t {
    kIdle,
    kOpening,    ///< The other set is being opened.
    kListening,  ///< It is open; its pose source has not spoken yet.
    kStanding,   ///< The robot is brought to stand.
  };

  RobotId robot;
  std::array<std::uint32_t, 2> types{};  ///< By DriverSet.
  RobotGroup other;                      ///< The set that does not serve: type, devices, sensors
                                         ///< and actuators. While `work` runs it belongs to that.
  bool made = false;                     ///< `other` has instances.
  Stage stage = Stage::kIdle;
  SimTime since;  ///< When the stage began.
  SideTask work;
  OpeningNote opening;             ///< What `work` opens now.
  std::atomic<bool> left = false;  ///< The run is over, and `work` is not.
  bool given_up = false;           ///< `work` still opens the set for a hand-over that was refused.
  Author author = Author::kRun;    ///< Of the hand-over in progress.
  std::optional<PoseReading> heard;  ///< By the pose source of the other set, in its frame.
  SimTime heard_at;
  SimTime moved_at;  ///< When the robot was seen to move last, or could not be seen.
  HandOverState state;

  [[nodiscard]] std::uint32_t type_of(DriverSet set) const noexcept {
    return types[static_cast<std::size_t>(set)];
  }
};

}  // namespace rave::sim
