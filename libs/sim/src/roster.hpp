// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "rave/base/check.hpp"
#include "robot_group.hpp"

namespace rave::sim {

/// Members [begin, end) of a group: what one thread does at a time. Fixed once, so that results do
/// not depend on how many threads there are.
struct Block {
  std::uint32_t group = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Whether something that comes each `period` steps, for the first time in step `first`, comes now.
[[nodiscard]] constexpr bool is_due(std::uint64_t step, std::uint32_t period,
                                    std::uint32_t first) noexcept {
  return step >= first && (step - first) % period == 0;
}

/// The robots that run here, in groups of one type each, and where the data of each are. Laid out
/// once. Belongs to one thread; threads of a phase read it.
struct Roster {
  /// `running`: by robot of a spec, 1 if it runs here.
  explicit Roster(std::vector<std::uint8_t> running) : local(std::move(running)) {}

  /// Sorts the robots into groups, which have no data yet, and these into blocks.
  void lay_out(const EngineSpec& spec, LogSink* log);

  [[nodiscard]] bool is_local(RobotId robot) const noexcept { return local[robot.value()] != 0; }
  /// Of a robot that runs here.
  [[nodiscard]] RobotGroup& group_of(RobotId robot) noexcept {
    RAVE_CHECK(is_local(robot));
    return groups[group_index[robot.value()]];
  }
  [[nodiscard]] const RobotGroup& group_of(RobotId robot) const noexcept {
    RAVE_CHECK(is_local(robot));
    return groups[group_index[robot.value()]];
  }
  [[nodiscard]] std::size_t member_of(RobotId robot) const noexcept {
    return member_index[robot.value()];
  }

  std::vector<std::uint8_t> local;  ///< By robot: runs here.
  std::vector<RobotLog> logs;       ///< By robot.
  std::deque<RobotGroup> groups;    ///< Deque: groups never move, views into them stay valid.
  std::vector<std::uint32_t> group_index;   ///< By robot; those that run elsewhere have none.
  std::vector<std::uint32_t> member_index;  ///< By robot.
  std::vector<Block> blocks;
};

}  // namespace rave::sim
