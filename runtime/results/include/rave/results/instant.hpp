// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "rave/observe/kinds.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/report/picture.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// Records one time of the run for the picture: robots, laser hits and real sightings of the robots
/// that run here.
class InstantKeeper final : public RunObserver {
 public:
  InstantKeeper(const BodyKinds& kinds, double instant_s) : kinds_(&kinds), instant_s_(instant_s) {}

  void after_step(const StepView& step) override;

  [[nodiscard]] const std::optional<InstantFacts>& facts() const noexcept { return instant_; }

 private:
  void remember_sightings(sim::Engine& engine);
  void freeze(const sim::Engine& engine);
  void add_bodies(const sim::Engine& engine, RobotId robot, InstantRobot& into) const;
  void add_hits(const sim::Engine& engine, RobotId robot, std::uint32_t sensor,
                InstantRobot& into) const;

  const BodyKinds* kinds_;
  double instant_s_;
  std::optional<InstantFacts> instant_;
  std::vector<InstantSighting> sightings_;  ///< Shortly before the time of the picture.
  std::vector<std::pair<std::uint32_t, std::int32_t>> seen_;  ///< Robot and code of each.
};

/// The outline of a shape as a polygon in W; a disc becomes one with 32 corners.
[[nodiscard]] std::vector<Vec2> outline_of(const world::Shape& shape, const Pose2& X_WB);

}  // namespace rave::runtime
