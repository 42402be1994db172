// SPDX-License-Identifier: Apache-2.0
// What must hold of a specification before an engine or an authority is made of it.
#include "spec_checks.hpp"

#include <algorithm>

#include "rave/base/check.hpp"

namespace rave::sim {
namespace {

/// A body is changed by the authority and all else by the host of the robot, so neither can wait
/// for what the other says of its half.
Status check_not_mixed(const EngineSpec& spec, const ScheduledChange& a, const ScheduledChange& b) {
  const bool body = std::any_of(a.changes.begin(), a.changes.end(), is_of_body) ||
                    std::any_of(b.changes.begin(), b.changes.end(), is_of_body);
  const bool all = std::all_of(a.changes.begin(), a.changes.end(), is_of_body) &&
                   std::all_of(b.changes.begin(), b.changes.end(), is_of_body);
  if (!body || all) return {};
  return fail(ErrorCode::kInvalidArgument,
              "robot `{}`, step {}: its body and other parts change in one step, which runs of "
              "several hosts do not support; change the body a step earlier",
              spec.robots[a.robot.value()].name, a.step);
}

}  // namespace

Status check_world(const EngineSpec& spec) {
  RAVE_CHECK(spec.robots.size() == spec.world.robots.size());
  if (spec.step.ns <= 0) return fail(ErrorCode::kInvalidArgument, "the step must be above 0 s");
  for (const RobotSpec& robot : spec.robots) {
    RAVE_CHECK(robot.type < spec.types.size());
    const RobotType& type = spec.types[robot.type];
    // Without a pose source the place of a real robot is unknown.
    if (!type.simulated && !type.pose_from) {
      return fail(ErrorCode::kInvalidArgument,
                  "robot `{}` is real, so it needs a source of its pose: `pose_from`", robot.name);
    }
  }
  if (!spec.world.added.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "the world of a run must begin without obstacles that were added later");
  }
  for (const ScheduledObstacle& scheduled : spec.obstacle_changes) {
    RAVE_TRY(check_obstacle_change(scheduled.change));
  }
  return {};
}

Status check_shared(const EngineSpec& spec) {
  if (spec.live_clock != nullptr && !spec.own_authority) {
    return fail(ErrorCode::kInvalidArgument,
                "hosts in lock-step cannot share a live run: its drivers do not wait");
  }
  // They are made in the order of the list, so one that stands behind a later one waits for it.
  std::uint64_t step = 0;
  for (std::size_t i = 0; i < spec.changes.size(); ++i) {
    const ScheduledChange& a = spec.changes[i];
    step = std::max(step, a.step);
    for (std::size_t k = i; k < spec.changes.size() && spec.changes[k].step <= step; ++k) {
      if (spec.changes[k].robot == a.robot) RAVE_TRY(check_not_mixed(spec, a, spec.changes[k]));
    }
  }
  return {};
}

Status check_twins(const EngineSpec& spec) {
  for (std::size_t r = 0; r < spec.robots.size(); ++r) {
    if (!spec.robots[r].twin) continue;
    RAVE_CHECK(*spec.robots[r].twin < spec.types.size());
    const RobotType& first = spec.types[spec.robots[r].type];
    const RobotType& twin = spec.types[*spec.robots[r].twin];
    RAVE_CHECK(first.sensors.size() == twin.sensors.size());
    RAVE_CHECK(first.actuators.size() == twin.actuators.size());
    RAVE_CHECK(first.controllers.size() == twin.controllers.size());
    for (std::size_t s = 0; s < first.sensors.size(); ++s) {
      RAVE_CHECK(first.sensors[s].kind == twin.sensors[s].kind);
    }
    // The two sets change places group by group, so the robot must be alone in its group.
    for (std::size_t other = 0; other < spec.robots.size(); ++other) {
      RAVE_CHECK(other == r || (spec.robots[other].type != spec.robots[r].type &&
                                spec.robots[other].type != *spec.robots[r].twin));
    }
    if (!spec.local || spec.own_authority) continue;
    return fail(ErrorCode::kInvalidArgument,
                "robot `{}` has two sets of drivers, which hosts in lock-step cannot change; "
                "expected one process, or a run in real time",
                spec.robots[r].name);
  }
  return {};
}

Status check_local(const EngineSpec& spec) {
  if (!spec.local) return {};
  RAVE_TRY(check_shared(spec));
  // A host without robots would have nothing to report, and the authority waits for reports.
  if (spec.local->empty())
    return fail(ErrorCode::kInvalidArgument, "expected at least one robot for the host");
  std::vector<std::uint8_t> seen(spec.robots.size());
  for (const RobotId robot : *spec.local) {
    if (robot.value() >= seen.size()) {
      return fail(ErrorCode::kInvalidArgument, "robot {} is local, but there are {} robots",
                  robot.value(), seen.size());
    }
    if (seen[robot.value()] != 0) {
      return fail(ErrorCode::kInvalidArgument, "robot `{}` is local twice",
                  spec.robots[robot.value()].name);
    }
    seen[robot.value()] = 1;
  }
  return {};
}

Status check_threads(const EngineSpec& spec, unsigned given) {
  if (given >= spec.threads) return {};
  return fail(ErrorCode::kIo,
              "the system grants only {} of {} threads (`threads`); use fewer, or raise the limits "
              "of processes or memory",
              given, spec.threads);
}

std::vector<std::uint8_t> local_robots(const EngineSpec& spec) {
  std::vector<std::uint8_t> local(spec.robots.size(), spec.local ? 0 : 1);
  if (!spec.local) return local;
  for (const RobotId robot : *spec.local) local[robot.value()] = 1;
  return local;
}

}  // namespace rave::sim
