// SPDX-License-Identifier: Apache-2.0
#include "rave/results/capture_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/results/goal_checks.hpp"
#include "rave/world/touching.hpp"

namespace rave::runtime {
namespace {

/// Larger than the rounding error of the distance of two poses.
constexpr double kRounding_m = 1e-6;

}  // namespace

CaptureWatch::CaptureWatch(const config::CaptureCheckFile& check,
                           const config::ExpandedScenario& scenario)
    : check_(check),
      predators_(named_robots(scenario, check.predator.value)),
      prey_(named_robots(scenario, check.prey.value)),
      closest_m_(std::numeric_limits<double>::infinity()),
      closest_before_m_(closest_m_) {}

void CaptureWatch::after_step(const StepView& step) {
  look(step.engine.snapshot(), step.engine.steps_done() - 1);
}

void CaptureWatch::look(const world::Snapshot& world, std::uint64_t step) {
  events_.clear();
  closest_before_m_ = closest_m_;
  const auto caught = [&](RobotId prey) {
    for (const RobotId predator : predators_) {
      if (predator == prey || !world.robot(predator).present || !world.robot(prey).present) {
        continue;
      }
      const world::Body& hunter = world.model().robots[predator.value()];
      const world::Body& hunted = world.model().robots[prey.value()];
      // Pairs certainly farther apart than any relevant distance need no exact computation.
      const Vec2 apart = world.pose(predator).position() - world.pose(prey).position();
      const double least_m =
          std::sqrt(squared_norm(apart)) - hunter.radius_m() - hunted.radius_m() - kRounding_m;
      // The bound is by the radii around both origins, so it never exceeds the true gap.
      if (least_m > check_.within_m && least_m > closest_m_) continue;
      const double gap_m =
          world::separation(hunter, world.pose(predator), hunted, world.pose(prey)).distance_m;
      closest_m_ = std::min(closest_m_, gap_m);
      if (!(gap_m <= check_.within_m)) continue;
      captures_.push_back({predator, prey, world.time().seconds(), gap_m});
      events_.push_back({step, predator, sim::EventKind::kCaptured, world.body_of(prey),
                         fmt::format("{:.3f} m apart", gap_m)});
      return true;
    }
    return false;
  };
  // A prey is caught once; afterwards it is no longer looked at.
  prey_.erase(std::remove_if(prey_.begin(), prey_.end(), caught), prey_.end());
}

void CaptureWatch::forget_last_look() {
  captures_.resize(captures_.size() - events_.size());
  events_.clear();
  closest_m_ = closest_before_m_;
}

CaptureFacts CaptureWatch::facts() const {
  CaptureFacts facts{captures_, std::nullopt};
  if (std::isfinite(closest_m_)) facts.closest_m = closest_m_;
  return facts;
}

std::vector<RobotId> lost_poses(const Capture& capture, std::span<const sim::Event> events,
                                Duration step) {
  std::vector<RobotId> lost;
  for (const RobotId robot : {capture.predator, capture.prey}) {
    bool is_lost = false;
    for (const sim::Event& event : events) {
      const bool of_pose =
          event.kind == sim::EventKind::kPoseStale || event.kind == sim::EventKind::kPoseBack;
      if (!of_pose || event.robot != robot) continue;
      // An event of the step that sensed the capture belongs to the same poses.
      if ((static_cast<double>(event.step) - 0.5) * step.seconds() > capture.time_s) break;
      is_lost = event.kind == sim::EventKind::kPoseStale;
    }
    if (is_lost) lost.push_back(robot);
  }
  return lost;
}

bool holds(const config::CaptureCheckFile& check, const CaptureFacts& facts,
           std::span<const sim::Event> events, Duration step) {
  if (!check.before_s) return true;
  return std::ranges::any_of(facts.captures, [&](const Capture& capture) {
    return capture.time_s <= *check.before_s && lost_poses(capture, events, step).empty();
  });
}

}  // namespace rave::runtime
