// SPDX-License-Identifier: Apache-2.0
// The guard of stepped runs and of simulated robots, asked within the act phase. Its time is that
// of the run. Real robots of live runs have threads: engine_live.cpp.
#include <algorithm>
#include <limits>

#include "engine_impl.hpp"
#include "sensor_age.hpp"
#include "spec_checks.hpp"

namespace rave::sim {

void Engine::Impl::set_up_guards() {
  guards.assign(spec.types.size(), std::nullopt);
  for (std::size_t t = 0; t < spec.types.size(); ++t) {
    const RobotType& type = spec.types[t];
    guards[t] = type.guard;
    // A real robot has at least the default limits, whatever its file says.
    if (!type.simulated && !type.guard) guards[t] = GuardSpec{};
  }
  robot_guards.clear();
  for (const RobotSpec& robot : spec.robots) {
    robot_guards.emplace_back(GuardHolds{.armed = is_armed_at_first(spec.types[robot.type])});
  }
}

void Engine::Impl::find_neighbours(RobotId robot, double reach_m, Worker& worker) const {
  // Others drive too while this one brakes.
  constexpr double kOthersWay_m = 2;
  worker.neighbours.clear();
  const std::uint32_t r = robot.value();
  const ReportedPose& own = reported[r];
  // The snapshot searches by origins, the limits are about outlines: both radii come on top.
  const double largest_m = *std::max_element(truth.radius_m.begin(), truth.radius_m.end());
  const double within_m = reach_m + truth.radius_m[r] + largest_m + kOthersWay_m;
  const Vec2 p_W{own.pose.x_m, own.pose.y_m};
  std::uint32_t count = truth.snapshot.robots_within(p_W, within_m, worker.near);
  // robots_within() says how many there are even if they do not fit, so a second call always
  // suffices.
  if (count > worker.near.size()) {
    worker.near.resize(count);
    count = truth.snapshot.robots_within(p_W, within_m, worker.near);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const RobotId other = worker.near[i];
    if (other == robot) continue;
    worker.neighbours.push_back({&spec.world.robots[other.value()], truth.snapshot.pose(other),
                                 truth.snapshot.velocity_W(other)});
  }
}

Command Engine::Impl::guarded(const RobotGroup& group, const ActuatorSlots& slots,
                              std::uint32_t member, const ControllerSlots* controller,
                              const Command& command, Worker& worker) {
  const RobotId robot = group.members[member];
  const std::uint32_t r = robot.value();
  RobotGuard& robot_guard = robot_guards[r];
  const auto& limits = guards[spec.robots[r].type];
  const CommandKind expected =
      controller != nullptr ? controller->spec->ops->gives : CommandKind::kVelocity;
  // What does not obey cannot be guarded, and a simulated robot is only if its file says so.
  if (!limits || slots.obeys[member] == 0) {
    return robot_guard.limit(command, expected, slots.drive(member));
  }

  const ReportedPose& pose = reported[r];
  GuardInput input;
  input.command = command;
  input.expected = expected;
  input.drive = slots.drive(member);
  // A program that never spoke is as silent as one that stopped speaking.
  if (controller != nullptr && group.program.spec != nullptr) {
    const std::int64_t given = controller->last_step[member];
    input.command_age_s =
        given < 0 ? std::numeric_limits<double>::infinity()
                  : Duration{spec.step.ns * (static_cast<std::int64_t>(step) - given)}.seconds();
  }
  input.pose_known = pose.known && !pose.stale;
  input.X_WR = {pose.pose.x_m, pose.pose.y_m, pose.pose.yaw_rad};
  input.pose_age_s = std::max(0.0, (now - pose.stamp).seconds());
  input.pose_stamp = pose.stamp;
  input.velocity = pose.velocity;
  find_watched_sensors(group, member, now, worker.sensors);
  input.sensors = worker.sensors;
  input.world_age_s = world_age.seconds();
  input.dt_s = spec.step.seconds();
  input.touching = truth.limited[r] != 0;
  input.radius_m = truth.radius_m[r];
  input.body = &spec.world.robots[r];
  if (limits->separation_m >= 0 && input.pose_known) {
    find_neighbours(robot, guard_reach_m(*limits, input), worker);
    input.neighbours = worker.neighbours;
  }
  const GuardOutput output = robot_guard.limit(*limits, input);
  if (output.acted != 0) {
    const auto quiet_steps = static_cast<std::int64_t>(kGuardQuiet_s / spec.step.seconds());
    const auto present = static_cast<std::int64_t>(step);
    tell_guard(robot, *limits, robot_guard.begin(output.acted, present, quiet_steps),
               output.lost_sensor, 0, worker.events);
  }
  return output.command;
}

void Engine::Impl::tell_guard(RobotId robot, const GuardSpec& limits, std::uint32_t begun,
                              std::uint32_t lost_sensor, std::uint32_t frozen_sensor,
                              std::vector<Event>& to) const {
  for (std::uint32_t i = 0; i < kGuardLimits; ++i) {
    if ((begun >> i & 1U) == 0) continue;
    const auto limit = static_cast<GuardLimit>(i);
    std::string text(text_of(limit));
    if (limit == GuardLimit::kSensorLost) {
      text = sensor_lost_text(roster.group_of(robot).sensors[lost_sensor], roster.member_of(robot));
    }
    if (limit == GuardLimit::kFrozen) {
      text = sensor_frozen_text(roster.group_of(robot), frozen_sensor);
    }
    to.push_back({step, robot, event_of(limit, limits), BodyId(), std::move(text), i});
  }
}

void Engine::Impl::halt() noexcept {
  for (RobotGroup& group : roster.groups) halt(group);
}

void Engine::Impl::halt(RobotGroup& group) noexcept {
  // Their threads write the stop; no other thread may write to these actuators.
  for (const GuardedMember& member : group.guards) {
    if (member.thread) member.thread->stand();
  }
  for (ActuatorSlots& slots : group.actuators) {
    if (slots.spec == nullptr || slots.spec->hardware_ops == nullptr) continue;
    for (std::size_t m = 0; m < slots.open.size(); ++m) {
      if (group.has_guard(m) || slots.open[m] == 0) continue;
      // Only an actuator that moves the robot can be commanded to stand; the rest is left to its
      // close().
      const Command stand = slots.commands[m].kind == CommandKind::kNone
                                ? Command{}
                                : slots.drive(m).standing(slots.commands[m].kind);
      if (stand.kind == CommandKind::kNone) continue;
      ErrorText ignored;
      slots.spec->hardware_ops->write(slots.instances.at(m), &stand, now.ns, &ignored);
    }
  }
}

}  // namespace rave::sim
