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

/// The path of a robot, from samples with their own stamps.
class GapTrack {
 public:
  /// Between samples further apart than this the pose is unknown.
  static constexpr Duration kLongestGap = from_seconds(0.5);

  void add(SimTime time, const Pose2& X_WR);
  /// Interpolated linearly between samples; empty before the first sample, after the last and
  /// within a gap.
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

/// Commands, each valid from its time until the next.
struct GapCommands {
  struct At {
    SimTime time;
    Command command;
  };
  std::vector<At> commands;
  std::string source;

  /// The command valid at `time`; kNone before the first.
  [[nodiscard]] Command at(SimTime time) const;
};

/// The recorded data of one robot, for the comparison with its twin.
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

/// The track of the robot; `from` receives the name of its source. Errors: kInvalidArgument without
/// a pose.
[[nodiscard]] Result<GapTrack> read_track(const GapSource& source, bool truth, std::string& from);

/// The commands of a kind; for `sensor` see GapOptions::commands. Errors: kInvalidArgument if there
/// are none or no actuator executed them, kNotFound.
[[nodiscard]] Result<GapCommands> read_commands(const GapSource& source, const std::string& sensor,
                                                CommandKind kind);

}  // namespace rave::runtime
