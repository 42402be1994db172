// SPDX-License-Identifier: Apache-2.0
#include "capture_watch.hpp"

#include <algorithm>
#include <limits>

#include "rave/world/touching.hpp"

namespace rave::robot_host {
namespace {

std::vector<RobotId> ids_of(const config::ExpandedScenario& scenario, const std::string& name) {
  std::vector<RobotId> ids;
  for (const std::size_t r : config::robots_named(scenario, name)) {
    ids.emplace_back(static_cast<std::uint32_t>(r));
  }
  return ids;
}

}  // namespace

CaptureWatch::CaptureWatch(const config::CaptureCheckFile& check,
                           const config::ExpandedScenario& scenario)
    : check_(check),
      predators_(ids_of(scenario, check.predator.value)),
      prey_(ids_of(scenario, check.prey.value)),
      closest_m_(std::numeric_limits<double>::infinity()) {}

void CaptureWatch::after_step(sim::Engine& engine) {
  events_.clear();
  const world::Snapshot& world = engine.snapshot();
  const auto caught = [&](RobotId prey) {
    for (const RobotId predator : predators_) {
      if (predator == prey || !world.robot(predator).present || !world.robot(prey).present) {
        continue;
      }
      const double gap_m =
          world::separation(world.model().robots[predator.value()], world.pose(predator),
                            world.model().robots[prey.value()], world.pose(prey))
              .distance_m;
      closest_m_ = std::min(closest_m_, gap_m);
      if (!(gap_m <= check_.within_m)) continue;
      captures_.push_back({predator, prey, world.time().seconds(), gap_m});
      events_.push_back({engine.steps_done() - 1, predator, sim::EventKind::kCaptured,
                         world.body_of(prey), fmt::format("{:.3f} m apart", gap_m)});
      return true;
    }
    return false;
  };
  prey_.erase(std::remove_if(prey_.begin(), prey_.end(), caught), prey_.end());
}

bool CaptureWatch::holds() const noexcept {
  if (!check_.before_s) return true;
  return !captures_.empty() && captures_.front().time_s <= *check_.before_s;
}

}  // namespace rave::robot_host
