// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// Sees when a predator comes near enough to a prey. Each prey is caught once. Where robots are is
/// what others sense: the truth of simulated, the reported pose of real ones.
class CaptureWatch final : public RunObserver {
 public:
  CaptureWatch(const config::CaptureCheckFile& check, const config::ExpandedScenario& scenario);

  void after_step(const StepView& step) override;
  /// The same without an engine: the world as that step senses it.
  void look(const world::Snapshot& world, std::uint64_t step);
  /// As if the last look had not been: that step was never done.
  void forget_last_look();

  [[nodiscard]] CaptureFacts facts() const;
  /// Those of the last step, as events of it.
  [[nodiscard]] std::span<const sim::Event> events() const noexcept override { return events_; }
  /// Whether the run is to end now.
  [[nodiscard]] bool ends_run() const noexcept { return check_.end_run && !captures_.empty(); }

 private:
  config::CaptureCheckFile check_;
  std::vector<RobotId> predators_;
  std::vector<RobotId> prey_;  ///< Those that are still free.
  std::vector<Capture> captures_;
  std::vector<sim::Event> events_;
  double closest_m_;         ///< Between the outlines; infinite before the first step.
  double closest_before_m_;  ///< ... the last look.
};

/// No limit, or a capture in time.
[[nodiscard]] bool holds(const config::CaptureCheckFile& check, const CaptureFacts& facts);

}  // namespace rave::runtime
