// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// Detects when a predator comes near enough to a prey. Each prey is captured once. It uses the
/// poses that other robots sense: true poses of simulated robots, reported poses of real robots.
class CaptureWatch final : public RunObserver {
 public:
  CaptureWatch(const config::CaptureCheckFile& check, const config::ExpandedScenario& scenario);

  void after_step(const StepView& step) override;
  /// Like after_step(), without an engine: `world` as that step senses it.
  void look(const world::Snapshot& world, std::uint64_t step);
  /// Undoes the last look(), because its step was not completed.
  void forget_last_look();

  [[nodiscard]] CaptureFacts facts() const;
  /// The captures of the last step.
  [[nodiscard]] std::span<const sim::Event> events() const noexcept override { return events_; }
  /// Whether a capture ends the run now.
  [[nodiscard]] bool ends_run() const noexcept { return check_.end_run && !captures_.empty(); }

 private:
  config::CaptureCheckFile check_;
  std::vector<RobotId> predators_;
  std::vector<RobotId> prey_;  ///< Those not caught yet.
  std::vector<Capture> captures_;
  std::vector<sim::Event> events_;
  double closest_m_;         ///< Distance between the outlines; infinite before the first step.
  double closest_before_m_;  ///< closest_m_ before the last look.
};

/// The robots of a capture whose poses were lost: the capture counts their last known poses, and
/// they may have been elsewhere. `events`: of the run, those of each robot in order.
[[nodiscard]] std::vector<RobotId> lost_poses(const Capture& capture,
                                              std::span<const sim::Event> events, Duration step);

/// True if the check sets no limit, or if a capture without a lost pose was in time.
[[nodiscard]] bool holds(const config::CaptureCheckFile& check, const CaptureFacts& facts,
                         std::span<const sim::Event> events, Duration step);

}  // namespace rave::runtime
