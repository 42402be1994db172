// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/replay/gap.hpp"
#include "rave/robot/command.hpp"

namespace rave::runtime {

/// Where a robot was, from samples with stamps of their own.
class GapTrack {
 public:
  /// Samples further apart than this say nothing of the time between them.
  static constexpr Duration kLongestGap = from_seconds(0.5);

  void add(SimTime time, const Pose2& X_WR);
  /// Between samples in a straight line; none before the first, behind the last, and in a gap.
  [[nodiscard]] std::optional<Pose2> at(SimTime time) const;
  [[nodiscard]] bool empty() const noexcept { return points_.empty(); }
  [[nodiscard]] SimTime first() const noexcept { return points_.front().time; }
  [[nodiscard]] SimTime last() const noexcept { return points_.back().time; }

 private:
  struct Point {
    SimTime time;
    Pose2 X_WR;
  };
  std::vector<Point> points_;
};

/// Commands that hold from their time on.
struct GapCommands {
  struct At {
    SimTime time;
    Command command;
  };
  std::vector<At> commands;
  std::string source;

  /// The command in force at `time`; kNone before the first.
  [[nodiscard]] Command at(SimTime time) const;
};

/// What a record holds of one robot, for the comparison with its twin.
struct GapSource {
  const record::McapReader& reader;
  const record::RunInfo& run;
  const record::RecordedRobot& robot;
  const config::ExpandedScenario& scenario;

  [[nodiscard]] const config::ExpandedRobot& expanded() const {
    return scenario.robots[robot.id.value()];
  }
  [[nodiscard]] const config::RobotFile& file() const {
    return scenario.group_of(expanded()).robot;
  }
};

/// The track of the robot and, in `from`, what it is. Errors: kInvalidArgument without a pose.
[[nodiscard]] Result<GapTrack> read_track(const GapSource& source, bool truth, std::string& from);

/// The commands of a kind. `sensor`: see GapOptions::commands. Errors: kInvalidArgument (there are
/// none, or nobody obeyed them), kNotFound.
[[nodiscard]] Result<GapCommands> read_commands(const GapSource& source, const std::string& sensor,
                                                CommandKind kind);

}  // namespace rave::runtime
