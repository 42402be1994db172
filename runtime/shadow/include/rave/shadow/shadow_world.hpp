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

/// A world like that of a run, in which the simulated twin of one robot is in the place of the
/// robot: it meets obstacles and all others where the run has them, and nobody in the run notices.
/// It is moved by what the run tells the robot's actuators. Belongs to one thread.
class ShadowWorld {
 public:
  /// `engine`: of the run, before its first step; nothing of it is kept. `simulated`: the type of
  /// the twin. Errors: kInvalidArgument (the twin has hardware of its own), whatever its drivers
  /// say.
  [[nodiscard]] static Result<std::unique_ptr<ShadowWorld>> create(const sim::Engine& engine,
                                                                   RobotId robot,
                                                                   sim::RobotType simulated,
                                                                   LogSink* log);

  /// Does the step that `engine` has just done; the first one may be a later one than 0. `beside`:
  /// events of obstacles that the engine of one of several hosts has not itself. `start`: the twin
  /// is put there. `driven`: it is told what the robot is told from this step on; else it is told
  /// to stand. Errors: those of sim::Engine; then no step can follow.
  Status step(const sim::Engine& engine, std::span<const sim::Event> beside,
              std::optional<Pose2> start, bool driven);

  /// Of the twin; nothing if that is longer ago than a second or has not come.
  [[nodiscard]] std::optional<Pose2> pose_at(SimTime stamp) const;
  /// Where the twin is in the step that was done.
  [[nodiscard]] Pose2 pose() const noexcept { return engine_->snapshot().pose(robot_); }
  /// In which the twin has the number of the robot.
  [[nodiscard]] sim::Engine& engine() noexcept { return *engine_; }

 private:
  struct Orders;

  ShadowWorld(RobotId robot, LogSink* log) : robot_(robot), log_(log) {}
  Status begin_at(std::uint64_t step);
  void mirror_obstacles(const sim::Engine& engine, std::span<const sim::Event> events);
  void report_others(const sim::Engine& engine);
  void put(const Pose2& X_WR);
  void listen(const sim::Engine& engine, bool driven);

  RobotId robot_;
  LogSink* log_;
  std::shared_ptr<Orders> orders_;  ///< The program of the twin reads them.
  std::unique_ptr<sim::Engine> engine_;
  std::unique_ptr<sim::WorldAuthority> authority_;
  sim::HostReport own_;
  sim::HostReport others_;
  sim::WorldStep world_;
};

}  // namespace rave::runtime
