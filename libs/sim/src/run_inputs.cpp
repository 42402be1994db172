// SPDX-License-Identifier: Apache-2.0
// What people and the scenario change between two steps. A change of several parts is made
// completely or not at all.
#include "run_inputs.hpp"

#include <algorithm>
#include <utility>

#include "parameter_edit.hpp"
#include "spec_checks.hpp"

namespace rave::sim {

using Part = ParameterChange::Part;

void RunInputs::begin() {
  next_change_ = 0;
  next_obstacle_ = 0;
}

void RunInputs::make_scheduled(std::uint64_t step) {
  // Obstacles before bodies, as the authority of several hosts does it: both give the same hash.
  const auto& obstacles = parts_.spec.obstacle_changes;
  for (; next_obstacle_ < obstacles.size() && obstacles[next_obstacle_].step <= step;
       ++next_obstacle_) {
    const auto made = change_obstacle(step, obstacles[next_obstacle_].change, Author::kRun);
    if (made) continue;
    parts_.log.note(step, RobotId(), EventKind::kChangeRefused, made.error().text(), Author::kRun);
  }
  const auto& changes = parts_.spec.changes;
  while (next_change_ < changes.size() && changes[next_change_].step <= step) {
    make(step, changes[next_change_++]);
  }
}

// One of several hosts: bodies and obstacles are changed by the authority and come with its world.
void RunInputs::make_scheduled_here(std::uint64_t step) {
  const auto& changes = parts_.spec.changes;
  for (; next_change_ < changes.size() && changes[next_change_].step <= step; ++next_change_) {
    const ScheduledChange& scheduled = changes[next_change_];
    const bool of_body =
        std::any_of(scheduled.changes.begin(), scheduled.changes.end(), is_of_body);
    if (parts_.roster.is_local(scheduled.robot) && !of_body) make(step, scheduled);
  }
}

void RunInputs::make(std::uint64_t step, const ScheduledChange& scheduled) {
  const Status status = change(step, scheduled.robot, scheduled.changes, Author::kRun);
  if (status) return;
  parts_.log.note(step, scheduled.robot, EventKind::kChangeRefused, status.error().text(),
                  Author::kRun);
}

Status RunInputs::check_body(RobotId robot, const ParameterChange& change) const {
  RAVE_TRY(check_body_change(change));
  if (!parts_.hand_overs.is_under_way(robot)) return {};
  return fail(ErrorCode::kState, "it is being handed over");
}

Status RunInputs::change(std::uint64_t step, RobotId robot,
                         std::span<const ParameterChange> changes, const Author& author) {
  ParameterEdit edit(parts_.roster.group_of(robot), parts_.roster.member_of(robot));
  const auto refused = [&](const Error& error, std::string_view where) {
    return refused_change(parts_.spec, robot, where, error);
  };
  const ParameterChange* scale = nullptr;
  for (const ParameterChange& change : changes) {
    if (change.part == Part::kBody) {
      const Status checked = check_body(robot, change);
      if (!checked) return refused(checked.error(), "body");
      scale = &change;
      continue;
    }
    const Status made = edit.make(change, changes);
    if (!made) return refused(made.error(), edit.where());
  }
  // The body last: it is the only change that cannot be taken back by `edit`, which undoes the
  // others if it is refused.
  std::string text;
  if (scale != nullptr) {
    const double before = parts_.truth.scale_of(robot);
    const double after = std::get<double>(scale->value);
    const Status resized = parts_.truth.resize(robot, after);
    if (!resized) return refused(resized.error(), "body");
    parts_.body_changed(robot);
    text = body_change_text(before, after);
  }
  const std::string of_parts = edit.keep();
  if (!text.empty() && !of_parts.empty()) text += ", ";
  text += of_parts;
  if (scale != nullptr) tell_program_of_body(robot);
  parts_.log.note(step, robot, EventKind::kChanged, std::move(text), author);
  return {};
}

Result<ChangedObstacle> RunInputs::change_obstacle(std::uint64_t step, const ObstacleChange& change,
                                                   const Author& author) {
  std::string also;
  const SimTime from{static_cast<std::int64_t>(step) * parts_.spec.step.ns};
  RAVE_TRY_ASSIGN(const ObstacleChange made, parts_.truth.change_obstacle(change, from, also));
  parts_.obstacle_changed(made);
  return ChangedObstacle{made.id, step, parts_.log.note_obstacle(step, made, also, author)};
}

Status RunInputs::resize(const ResizedRobot& resized) {
  RAVE_TRY(parts_.truth.put_scale(resized.robot, resized.scale));
  parts_.body_changed(resized.robot);
  tell_program_of_body(resized.robot);
  return {};
}

/// A program that keeps the radius of its robot learns the new one; one that takes no changes
/// continues with the old one.
void RunInputs::tell_program_of_body(RobotId robot) {
  if (!parts_.roster.is_local(robot)) return;
  // There is no receiver without a program, or if it has failed.
  const auto target = parameter_target(parts_.roster.group_of(robot),
                                       parts_.roster.member_of(robot), Part::kProgram, 0);
  if (target) static_cast<void>(target->update(target->present));
}

template <class Act>
void RunInputs::for_each(RobotId robot, Act&& act) {
  for (std::uint32_t r = 0; r < parts_.guards.size(); ++r) {
    const bool meant = !robot.valid() || robot.value() == r;
    if (meant && parts_.roster.is_local(RobotId(r))) act(RobotId(r), parts_.guards[r]);
  }
}

void RunInputs::stop(std::uint64_t step, RobotId robot, const Author& author) {
  for_each(robot, [&](RobotId one, RobotGuard& guard) {
    if (!guard.stop()) return;
    // Not first in the next step, which may be long in coming.
    const RobotGroup& group = parts_.roster.group_of(one);
    const std::size_t m = parts_.roster.member_of(one);
    if (group.has_guard(m)) group.guards[m].thread->stand();
    parts_.log.note(step, one, EventKind::kStopped, "", author);
    // An order does not resume by itself when the robot is released.
    parts_.orders.end(one, author);
  });
}

void RunInputs::release(std::uint64_t step, RobotId robot, const Author& author) {
  for_each(robot, [&](RobotId one, RobotGuard& guard) {
    const EngineSpec& spec = parts_.spec;
    if (!guard.release(is_armed_at_first(spec.types[spec.robots[one.value()].type]))) return;
    parts_.log.note(step, one, EventKind::kReleased, "", author);
  });
}

void RunInputs::arm(std::uint64_t step, RobotId robot, const Author& author) {
  for_each(robot, [&](RobotId one, RobotGuard& guard) {
    if (guard.arm()) parts_.log.note(step, one, EventKind::kArmed, "", author);
  });
}

}  // namespace rave::sim
