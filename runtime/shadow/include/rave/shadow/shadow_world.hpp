// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::runtime {

/// A copy of a run's world in which the simulated twin of one robot replaces the robot. It meets
/// obstacles and other robots at their poses in the run, but the run does not notice it. It
/// receives the commands to the robot's actuators. Belongs to one thread.
class ShadowWorld {
 public:
  /// `engine`: of the run, before its first step; not referred to later. `simulated`: the type of
  /// the twin. Errors: kInvalidArgument (the twin has hardware of its own), those of its drivers.
  [[nodiscard]] static Result<std::unique_ptr<ShadowWorld>> create(const sim::Engine& engine,
                                                                   RobotId robot,
                                                                   sim::RobotType simulated,
                                                                   LogSink* log);

  /// Computes the step that `engine` has just completed; the first one may be later than 0.
  /// `beside`: obstacle events that the engine of one of several hosts does not have. `start`:
  /// places the twin there. `driven`: whether the twin receives the robot's commands from this step
  /// on; otherwise it stands. Errors: those of sim::Engine; no step may follow then.
  Status step(const sim::Engine& engine, std::span<const sim::Event> beside,
              std::optional<Pose2> start, bool driven);

  /// Pose of the twin at `stamp`; empty if that is more than a second ago or in the future.
  [[nodiscard]] std::optional<Pose2> pose_at(SimTime stamp) const;
  /// Pose of the twin in the last step.
  [[nodiscard]] Pose2 pose() const noexcept { return engine_->snapshot().pose(robot_); }
  /// The engine in which the twin has the id of the robot.
  [[nodiscard]] sim::Engine& engine() noexcept { return *engine_; }

 private:
  ShadowWorld(RobotId robot, LogSink* log) : robot_(robot), log_(log) {}
  Status begin_at(std::uint64_t step);
  void mirror_obstacles(const sim::Engine& engine, std::span<const sim::Event> events);
  void report_others(const sim::Engine& engine);
  void put(const Pose2& X_WR);
  void listen(const sim::Engine& engine, bool driven);

  RobotId robot_;
  LogSink* log_;
  /// The last commands to the robot's actuators; shared with the program of the twin, which reads
  /// them.
  std::shared_ptr<std::vector<Command>> orders_;
  std::unique_ptr<sim::Engine> engine_;
  std::unique_ptr<sim::WorldAuthority> authority_;
  sim::HostReport own_;
  sim::HostReport others_;
  sim::WorldStep world_;
};

}  // namespace rave::runtime
