// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "rave/sim/conductor.hpp"
#include "world_truth.hpp"

namespace rave::sim {

/// The truth of a world, as conditions see it between two steps.
class TruthLook final : public WorldLook {
 public:
  TruthLook(const WorldTruth& truth, std::uint64_t step) : truth_(truth), step_(step) {}

  [[nodiscard]] const EngineSpec& spec() const override { return truth_.spec; }
  [[nodiscard]] SimTime now() const override {
    return {static_cast<std::int64_t>(step_) * truth_.spec.step.ns};
  }
  [[nodiscard]] std::uint64_t step() const override { return step_; }
  [[nodiscard]] std::optional<Pose2> pose(RobotId robot) const override {
    const Mover& mover = truth_.movers[robot.value()];
    return mover.present ? std::optional(mover.X_WR) : std::nullopt;
  }
  [[nodiscard]] double speed_mps(RobotId robot) const override {
    const Twist2& velocity = truth_.velocity[robot.value()];
    return std::sqrt(velocity.vx * velocity.vx + velocity.vy * velocity.vy);
  }
  [[nodiscard]] bool touches(RobotId robot) const override {
    return truth_.touch[robot.value()].touching;
  }
  [[nodiscard]] std::optional<Pose2> obstacle(std::string_view name) const override {
    const world::WorldModel& world = truth_.spec.world;
    for (std::size_t i = 0; i < world.obstacle_count(); ++i) {
      const world::Obstacle& obstacle = *world.obstacle(world.obstacle_id(i));
      if (!obstacle.removed && obstacle.body.name == name) return obstacle.X_WB;
    }
    return std::nullopt;
  }

 private:
  const WorldTruth& truth_;
  std::uint64_t step_;
};

}  // namespace rave::sim
