// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "hand_overs.hpp"
#include "input_log.hpp"
#include "order_book.hpp"
#include "robot_guard.hpp"
#include "roster.hpp"
#include "world_truth.hpp"

namespace rave::sim {

/// Inputs of a run but orders and hand-overs: stops, parameters, bodies and obstacles, as asked by
/// hand or by the scenario. Carries them out between two steps and writes them down; `step` is the
/// one that comes next. Belongs to the thread of the engine.
class RunInputs {
 public:
  /// All must outlive it.
  struct Parts {
    EngineSpec& spec;
    Roster& roster;
    WorldTruth& truth;
    std::vector<RobotGuard>& guards;  ///< By robot.
    OrderBook& orders;
    const HandOvers& hand_overs;
    InputLog& log;
    /// Told of a body that has another size now, and of a change of an obstacle that was made:
    /// caches of the world must be rebuilt.
    std::function<void(RobotId)> body_changed;
    std::function<void(const ObstacleChange&)> obstacle_changed;
  };
  explicit RunInputs(Parts parts) : parts_(std::move(parts)) {}

  /// A run begins.
  void begin();
  /// What the scenario has for this step.
  void make_scheduled(std::uint64_t step);
  /// The same of one of several hosts: parameters of its own robots. The rest is the authority's.
  void make_scheduled_here(std::uint64_t step);

  /// Of one robot, or of all that run here if there is none.
  void stop(std::uint64_t step, RobotId robot, const Author& author);
  void release(std::uint64_t step, RobotId robot, const Author& author);
  void arm(std::uint64_t step, RobotId robot, const Author& author);

  /// Changes parameters and the body of a robot that runs here, all or none. Errors: as
  /// Engine::set_parameters().
  Status change(std::uint64_t step, RobotId robot, std::span<const ParameterChange> changes,
                const Author& author);
  /// Errors: as Engine::change_obstacle().
  Result<ChangedObstacle> change_obstacle(std::uint64_t step, const ObstacleChange& change,
                                          const Author& author);
  /// A body gets another size, which another process has checked.
  Status resize(const ResizedRobot& resized);

 private:
  void make(std::uint64_t step, const ScheduledChange& scheduled);
  [[nodiscard]] Status check_body(RobotId robot, const ParameterChange& change) const;
  void tell_program_of_body(RobotId robot);
  /// Calls `act` for each robot that runs here and is meant.
  template <class Act>
  void for_each(RobotId robot, Act&& act);

  Parts parts_;
  std::size_t next_change_ = 0;    ///< Of spec.changes.
  std::size_t next_obstacle_ = 0;  ///< Of spec.obstacle_changes.
};

}  // namespace rave::sim
