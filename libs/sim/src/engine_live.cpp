// SPDX-License-Identifier: Apache-2.0
// Real robots of a live run: their guards have threads of their own, and receive the wanted
// commands.
#include <algorithm>
#include <string>

#include "engine_impl.hpp"
#include "sensor_age.hpp"

namespace rave::sim {
namespace {

/// A driver that has not returned from a command for so long has failed.
constexpr Duration kStuck{500'000'000};
/// How many robots a message names.
constexpr std::size_t kNamed = 8;
/// What an actuator's driver calls it, if its device has one.
constexpr std::string_view kDeviceWatchdog = "device_watchdog_s";

/// As far as the engine has come to them, of the sensors that the guard of a robot knows.
std::uint32_t breaks_of(const RobotGroup& group, std::size_t member) {
  std::uint32_t breaks = 0;
  for (const SensorSlots& slots : group.sensors) {
    if (!slots.live) continue;
    if (group.is_pose_source(slots)) breaks += slots.before[member].breaks;
    if (slots.max_age_s) breaks += slots.before[member].breaks;
  }
  return breaks;
}

bool is_obeyed(const RobotGroup& group, std::size_t member) {
  return std::any_of(group.actuators.begin(), group.actuators.end(), [&](const auto& slots) {
    return slots.spec->hardware_ops != nullptr && slots.obeys[member] != 0;
  });
}

/// Whether the device behind an actuator stops by itself when commands cease.
bool has_device_watchdog(const ActuatorSpec& spec) {
  return std::any_of(
      spec.params.values().begin(), spec.params.values().end(),
      [](const ParamValue& value) { return value.name == kDeviceWatchdog && value.number > 0; });
}

/// The parts of a list that a message has room for.
std::string list_of(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < std::min(parts.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + parts[i];
  }
  if (parts.size() > kNamed) text += fmt::format(" and {} more", parts.size() - kNamed);
  return text;
}

}  // namespace

Status Engine::Impl::start_guards() {
  guard_bodies.clear();
  for (RobotGroup& group : roster.groups) RAVE_TRY(start_guards(group));
  tell_of_guards();
  return {};
}

/// Of a stepped run there are none: what the guard does there belongs to the steps.
Status Engine::Impl::start_guards(RobotGroup& group) {
  group.guards.clear();
  if (spec.live_clock == nullptr || group.type->simulated) return {};
  // Filled apart and moved over at the end. If a thread cannot be started, the group has no guards,
  // and those that were started end with this list.
  std::vector<GuardedMember> started(group.members.size());
  bool any = false;
  for (std::size_t m = 0; m < group.members.size(); ++m) {
    if (!is_obeyed(group, m)) continue;
    RAVE_TRY_ASSIGN(started[m].thread, start_guard(group, m));
    for (const ControllerSlots& controller : group.controllers) {
      std::optional<SimTime>& given = started[m].given.emplace_back();
      // Controllers stay in a hand-over, so they may already have commands; the age of these counts
      // on.
      const std::int64_t last = controller.last_step[m];
      if (last >= 0) given = step_time(static_cast<std::uint64_t>(last));
    }
    any = true;
  }
  if (!any) return {};
  group.guards = std::move(started);
  guard_bodies.resize(spec.robots.size());
  return {};
}

Result<std::unique_ptr<GuardThread>> Engine::Impl::start_guard(RobotGroup& group,
                                                               std::size_t member) {
  const RobotId robot = group.members[member];
  GuardThread::Setup setup;
  setup.limits = *guards[spec.robots[robot.value()].type];
  setup.clock = spec.live_clock;
  setup.period = spec.guard_period;
  setup.pose.staleness = group.type->staleness;
  if (group.type->pose_from) {
    const SensorSlots& source = group.sensors[*group.type->pose_from];
    // What a stepped driver has published may lie in the future.
    if (source.live) setup.pose.queue = source.queues[member].get();
    setup.pose.index = *group.type->pose_from;
    setup.pose.kind = source.spec->kind;
    setup.pose.X_WM = pose_frame(group, robot);
  }
  // Only live sensors can fall silent by the wall clock; those of a recording follow the run.
  for (std::uint32_t s = 0; s < group.sensors.size(); ++s) {
    const SensorSlots& slots = group.sensors[s];
    if (!slots.max_age_s || !slots.live) continue;
    setup.sensors.push_back(
        {s, slots.queues[member].get(), *slots.max_age_s, is_judged_by_link(*slots.spec)});
  }
  for (std::uint32_t s = 0; s < group.sensors.size(); ++s) {
    const SensorSlots& slots = group.sensors[s];
    if (!slots.live || slots.spec->kind != ReadingKind::kRanges) continue;
    setup.ranges.push_back({s, slots.queues[member].get(), ray_sectors(slots.info)});
  }
  for (const ActuatorSlots& slots : group.actuators) {
    setup.actuators.push_back(
        {slots.spec->hardware_ops, slots.instances.at(member), slots.spec->driver});
  }
  return GuardThread::start(std::move(setup), spec.robots[robot.value()].name);
}

/// Warnings for a person who lets real robots drive: what the guards cannot do.
void Engine::Impl::tell_of_guards() const {
  if (spec.log == nullptr) return;
  std::vector<std::string> without_watchdog;
  bool without_priority = false;
  for (const RobotGroup& group : roster.groups) {
    for (std::size_t m = 0; m < group.guards.size(); ++m) {
      if (!group.has_guard(m)) continue;
      without_priority = without_priority || !group.guards[m].thread->has_priority();
      for (const ActuatorSlots& slots : group.actuators) {
        if (slots.obeys[m] == 0 || has_device_watchdog(*slots.spec)) continue;
        without_watchdog.push_back(fmt::format(
            "`{}` (driver `{}`)", spec.robots[group.members[m].value()].name, slots.spec->driver));
      }
    }
  }
  if (without_priority) {
    spec.log->info(
        "guard",
        "the system grants no real-time priority (SCHED_FIFO, `ulimit -r`); on a busy machine the "
        "guards of real robots may be late, and then slow them down near their limits");
  }
  if (without_watchdog.empty()) return;
  spec.log->warn("guard",
                 "if this process is killed or suspended, only a watchdog of the device stops a "
                 "robot; none is stated (`{}` of the actuator) for {}",
                 kDeviceWatchdog, list_of(without_watchdog));
}

void Engine::Impl::serve_guard(RobotGroup& group, std::uint32_t member) {
  give_order(group, member);
  hear_guard(group, member);
}

void Engine::Impl::give_order(RobotGroup& group, std::uint32_t member) {
  GuardedMember& guarded = group.guards[member];
  const RobotId robot = group.members[member];
  for (std::size_t c = 0; c < group.controllers.size(); ++c) {
    const bool now_given =
        group.controllers[c].last_step[member] == static_cast<std::int64_t>(step);
    // The program decided on what was known when the step began.
    if (now_given) guarded.given[c] = work_began;
  }
  GuardOrder& order = guarded.thread->next_order();
  order.demands.resize(group.actuators.size());
  for (std::uint32_t a = 0; a < order.demands.size(); ++a) {
    const ControllerSlots* const speaker = group.speaker(a, member);
    ActuatorDemand& demand = order.demands[a];
    demand.command = group.actuators[a].commands[member];
    demand.expected = speaker != nullptr ? speaker->spec->ops->gives : CommandKind::kVelocity;
    demand.drive = group.actuators[a].drive(member);
    // A robot without a program has no watchdog: no program has to command it.
    demand.watched = speaker != nullptr && group.program.spec != nullptr;
    demand.given = demand.watched ? guarded.given[group.index_of(*speaker)] : std::nullopt;
  }
  order.holds = robot_guards[robot.value()].holds();
  order.breaks = breaks_of(group, member);
  // The world of a late step is as old as its lateness, which set_world_age() has stated.
  order.world_time = work_began - world_age;
  order.reported = reported[robot.value()];
  order.radius_m = truth.radius_m[robot.value()];
  order.body = guard_body(robot);
  fill_neighbours(robot, group, order);
  guarded.thread->give_order();
}

void Engine::Impl::fill_neighbours(RobotId robot, const RobotGroup& group, GuardOrder& order) {
  order.neighbours.clear();
  order.bodies.clear();
  const GuardSpec& limits = *guards[spec.robots[robot.value()].type];
  order.sees_others = order.reported.known;
  if (limits.separation_m < 0 || !order.sees_others || order.demands.empty()) return;
  // Who may come into question until the next order, however late the guard and that may be.
  GuardInput input;
  input.command = order.demands.front().command;
  input.drive = order.demands.front().drive;
  input.velocity = order.reported.velocity;
  // The worst case of all that the thread may see before the next order, so the reach is an upper
  // bound: the oldest pose that still counts and the longest gap.
  input.pose_age_s = group.type->staleness.seconds();
  input.dt_s = LiveGuard::kLongestGap_s;
  Worker& worker = workers.front();
  find_neighbours(robot, guard_reach_m(limits, input), worker);
  for (GuardNeighbour neighbour : worker.neighbours) {
    const auto index = neighbour.body - spec.world.robots.data();
    const auto& body =
        order.bodies.emplace_back(guard_body(RobotId(static_cast<std::uint32_t>(index))));
    neighbour.body = body.get();
    order.neighbours.push_back(neighbour);
  }
}

// The thread may still read a body when a hand-over or a resize replaces it here. So each order
// shares the body that it was made with, and a new one is a new object.
std::shared_ptr<const world::Body> Engine::Impl::guard_body(RobotId robot) {
  std::shared_ptr<const world::Body>& body = guard_bodies[robot.value()];
  if (!body) body = std::make_shared<const world::Body>(spec.world.robots[robot.value()]);
  return body;
}

void Engine::Impl::hear_guard(RobotGroup& group, std::uint32_t member) {
  GuardedMember& guarded = group.guards[member];
  const RobotId robot = group.members[member];
  guarded.thread->look(guarded.news);
  tell_guard(robot, *guards[spec.robots[robot.value()].type], guarded.news.begun,
             guarded.news.lost_sensor, guarded.news.frozen_sensor, events);
  const bool stuck = guarded.news.stuck > kStuck;
  for (std::size_t a = 0; a < group.actuators.size(); ++a) {
    ActuatorSlots& slots = group.actuators[a];
    const WrittenCommand& written = guarded.news.written[a];
    // Recordings show what reached the actuator, not what the controller wanted.
    slots.commands[member] = written.command;
    if (slots.spec->hardware_ops == nullptr) continue;
    const std::string_view text =
        stuck ? std::string_view("has not returned from a command") : written.text;
    note_written(group, slots, member, stuck || written.failed, text);
  }
}

}  // namespace rave::sim
