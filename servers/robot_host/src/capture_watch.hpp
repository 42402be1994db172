// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "observer.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::robot_host {

/// One robot that caught another.
struct Capture {
  RobotId predator;
  RobotId prey;
  double time_s = 0;
  double gap_m = 0;  ///< Between the outlines, when it was noticed.
};

/// Sees when a predator comes near enough to a prey. Each prey is caught once. Where robots are is
/// what others sense: the truth of simulated, the reported pose of real ones.
class CaptureWatch final : public Observer {
 public:
  CaptureWatch(const config::CaptureCheckFile& check, const config::ExpandedScenario& scenario);

  void after_step(sim::Engine& engine) override;

  [[nodiscard]] const std::vector<Capture>& captures() const noexcept { return captures_; }
  /// Those of the last step, as events of it.
  [[nodiscard]] const std::vector<sim::Event>& events() const noexcept { return events_; }
  /// Whether the run is to end now.
  [[nodiscard]] bool ends_run() const noexcept { return check_.end_run && !captures_.empty(); }
  [[nodiscard]] const config::CaptureCheckFile& check() const noexcept { return check_; }
  /// No limit, or a capture in time.
  [[nodiscard]] bool holds() const noexcept;
  /// The least gap between a predator and a prey so far, metres; infinite before the first step.
  [[nodiscard]] double closest_m() const noexcept { return closest_m_; }

 private:
  config::CaptureCheckFile check_;
  std::vector<RobotId> predators_;
  std::vector<RobotId> prey_;  ///< Those that are still free.
  std::vector<Capture> captures_;
  std::vector<sim::Event> events_;
  double closest_m_;
};

}  // namespace rave::robot_host
