// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/engine.hpp"

#include <algorithm>

#include "engine_impl.hpp"
#include "radio.hpp"
#include "rave/base/check.hpp"
#include "rave/math/transform.hpp"
#include "spec_checks.hpp"

namespace rave::sim {
namespace {

/// How old a real sample may be when it is fused.
constexpr Duration kHybridHistory{1'000'000'000};

Status check_pose_source(const RobotType& type, const std::string& robot) {
  if (!type.pose_from) return {};
  RAVE_CHECK(*type.pose_from < type.sensors.size());
  const SensorSpec& sensor = type.sensors[*type.pose_from];
  if (sensor.kind != ReadingKind::kPose && sensor.kind != ReadingKind::kOdometry) {
    return fail(ErrorCode::kInvalidArgument,
                "robot `{}`: `pose_from` needs a pose or odometry, but `{}` gives {}", robot,
                sensor.name, to_string(sensor.kind));
  }
  // A virtual sensor would have to know the pose that it is asked for.
  if (!type.simulated && (sensor.virtual_ops != nullptr || sensor.hybrid)) {
    return fail(ErrorCode::kInvalidArgument,
                "robot `{}` is real, so `pose_from` needs a real sensor, but `{}` is {}", robot,
                sensor.name, sensor.hybrid ? "half virtual" : "virtual");
  }
  return {};
}

/// Whether a robot that runs here has a hybrid sensor.
bool has_hybrid(const EngineSpec& spec, const std::vector<std::uint8_t>& local) {
  const auto is_hybrid = [](const SensorSpec& sensor) { return sensor.hybrid.has_value(); };
  std::vector<std::uint8_t> runs(spec.types.size());
  for (std::size_t r = 0; r < local.size(); ++r) {
    if (local[r] == 0) continue;
    runs[spec.robots[r].type] = 1;
    if (spec.robots[r].twin) runs[*spec.robots[r].twin] = 1;
  }
  for (std::size_t t = 0; t < runs.size(); ++t) {
    const auto& sensors = spec.types[t].sensors;
    if (runs[t] != 0 && std::any_of(sensors.begin(), sensors.end(), is_hybrid)) return true;
  }
  return false;
}

/// What must hold of a robot that runs here.
void check_drivers(const RobotType& type) {
  for (const SensorSpec& sensor : type.sensors) {
    RAVE_CHECK((sensor.virtual_ops == nullptr) != (sensor.hardware_ops == nullptr));
    RAVE_CHECK(!sensor.hybrid || sensor.hardware_ops != nullptr);
    RAVE_CHECK(sensor.period_steps > 0);
  }
  RAVE_CHECK(!type.program || type.program->period_steps > 0);
  if (type.guard) RAVE_CHECK(type.guard->deceleration_mps2 > 0);
}

Status check(const EngineSpec& spec) {
  RAVE_TRY(check_world(spec));
  RAVE_TRY(check_local(spec));
  const std::vector<std::uint8_t> local = local_robots(spec);
  for (std::size_t r = 0; r < spec.robots.size(); ++r) {
    if (local[r] == 0) continue;
    const RobotType& type = spec.types[spec.robots[r].type];
    RAVE_TRY(check_pose_source(type, spec.robots[r].name));
    check_drivers(type);
    if (!spec.robots[r].twin) continue;
    const RobotType& twin = spec.types[*spec.robots[r].twin];
    RAVE_TRY(check_pose_source(twin, spec.robots[r].name));
    check_drivers(twin);
  }
  return check_twins(spec);
}

}  // namespace

std::string_view to_string(EventKind kind) noexcept {
  switch (kind) {
    case EventKind::kContact:
      return "contact";
    case EventKind::kPinned:
      return "pinned";
    case EventKind::kPoseStale:
      return "pose stale";
    case EventKind::kPoseBack:
      return "pose back";
    case EventKind::kProgramFailed:
      return "program failed";
    case EventKind::kDriverFailed:
      return "driver failed";
    case EventKind::kDriverBack:
      return "driver back";
    case EventKind::kGuardSlowed:
      return "guard slowed";
    case EventKind::kGuardStopped:
      return "guard stopped";
    case EventKind::kStopped:
      return "stopped";
    case EventKind::kReleased:
      return "released";
    case EventKind::kArmed:
      return "armed";
    case EventKind::kChanged:
      return "changed";
    case EventKind::kChangeRefused:
      return "change refused";
    case EventKind::kObstacleAdded:
      return "obstacle added";
    case EventKind::kObstacleMoved:
      return "obstacle moved";
    case EventKind::kObstacleRemoved:
      return "obstacle removed";
    case EventKind::kCaptured:
      return "captured";
    case EventKind::kHandedOver:
      return "handed over";
    case EventKind::kHandOverRefused:
      return "hand over refused";
    case EventKind::kShadowReset:
      return "shadow reset";
    case EventKind::kOrdered:
      return "ordered";
    case EventKind::kSaid:
      return "said";
    case EventKind::kPlaced:
      return "placed";
    case EventKind::kLease:
      return "lease";
  }
  return "unknown";
}

Engine::Impl::Impl(EngineSpec s)
    : spec(std::move(s)),
      log_outlet(spec.log),
      local(local_robots(spec)),
      host(spec.local ? std::make_unique<HostPart>(spec, local) : nullptr),
      pool(spec.threads, spec.share_always),
      workers(pool.threads()),
      truth(spec, pool) {
  if (spec.live_clock != nullptr) spec.live_clock = &clock_outlet.emplace(*spec.live_clock);
  if (!has_hybrid(spec, local)) return;
  spec.history = std::max(spec.history, kHybridHistory);
  fusion_world = std::make_unique<FusionWorld>(spec.world);
}

void Engine::Impl::tell_complaints() const {
  for (const RobotGroup& group : groups) tell_complaints(group);
}

void Engine::Impl::tell_complaints(const RobotGroup& group) const {
  if (spec.log == nullptr) return;
  for (const SensorSlots& slots : group.sensors) {
    for (std::size_t m = 0; m < slots.queues.size(); ++m) {
      const std::string complaint = slots.queues[m]->complaint();
      if (complaint.empty()) continue;
      spec.log->warn(logs[group.members[m].value()].source,
                     "sensor `{}` (driver `{}`) broke its contract; samples dropped: {}; first: {}",
                     slots.spec->name, slots.spec->hardware_driver(), slots.queues[m]->dropped(),
                     complaint);
    }
    tell_withheld(group, slots);
  }
}

void Engine::Impl::tell_withheld(const RobotGroup& group, const SensorSlots& slots) const {
  if (!slots.fusion) return;
  for (std::size_t m = 0; m < group.members.size(); ++m) {
    const std::uint64_t count = slots.fusion->too_late[m];
    if (count == 0) continue;
    spec.log->warn(logs[group.members[m].value()].source,
                   "sensor `{}`: {} readings were withheld, because the pose of the robot or the "
                   "world at their stamps was no longer known (history {} s)",
                   slots.spec->name, count, spec.history.seconds());
  }
}

Status Engine::Impl::make() {
  const std::size_t count = spec.robots.size();
  logs.resize(count);
  group_index.resize(count);
  member_index.resize(count);
  std::vector<std::uint32_t> group_of_type(spec.types.size(), RobotId::kNone);
  for (std::uint32_t r = 0; r < count; ++r) {
    group_index[r] = RobotId::kNone;
    if (!is_local(r)) continue;
    logs[r] = {spec.log != nullptr ? &log_outlet : nullptr,
               fmt::format("robot {}", spec.robots[r].name)};
    std::uint32_t& index = group_of_type[spec.robots[r].type];
    if (index == RobotId::kNone) {
      index = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back().type = &spec.types[spec.robots[r].type];
    }
    group_index[r] = index;
    member_index[r] = static_cast<std::uint32_t>(groups[index].members.size());
    groups[index].members.emplace_back(r);
  }
  make_twins();
  radio = std::make_unique<Radio>(spec, local, logs, pool);
  RAVE_TRY(radio->make());
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    RAVE_TRY(make_group({spec, logs, radio.get(), nullptr, answers.service()}, groups[g]));
    const auto size = static_cast<std::uint32_t>(groups[g].members.size());
    for (std::uint32_t begin = 0; begin < size; begin += kMemberBlock) {
      blocks.push_back({g, begin, std::min(begin + kMemberBlock, size)});
    }
  }
  return begin();
}

Status Engine::Impl::reset() {
  tell_complaints();
  halt();
  RAVE_TRY(restore_twins());
  // All are closed first: what two robots share must be free before one of them opens it again.
  if (!close_all(take_open()) || !close_all(radio->take_open())) {
    return fail(ErrorCode::kState,
                "the run cannot restart while drivers of the last run are closing");
  }
  restore_obstacles();
  restore_bodies();
  radio->clear();
  for (RobotGroup& group : groups)
    RAVE_TRY(reset_group({spec, logs, radio.get(), nullptr, answers.service()}, group));
  return begin();
}

Status Engine::Impl::begin() {
  set_initial_state();
  if (spec.on_ready) spec.on_ready();
  for (RobotGroup& group : groups)
    RAVE_TRY(open_sensors({spec, logs, radio.get(), nullptr, answers.service()}, group));
  RAVE_TRY(radio->open());
  return start_guards();
}

void Engine::Impl::set_initial_state() {
  const std::size_t count = spec.robots.size();
  step = 0;
  now = {};
  hash = RunHash();
  phase_times = {};
  events.clear();
  pending.clear();
  by_hand = 0;
  next_change = 0;
  next_hand_over = 0;
  next_obstacle = 0;
  world_age = {};
  orders.reset();
  answers.clear();
  set_up_guards();
  history.clear();
  past_valid = false;
  if (fusion_world) fusion_world->valid = false;
  truth.begin();
  if (host) host->begin();
  reported.assign(count, ReportedPose{});
  const Duration keep = std::max(spec.history, from_seconds(1.0));
  tracks.assign(count, PoseTrack(keep));
  for (std::uint32_t r = 0; r < count; ++r) {
    const RobotType& type = spec.types[spec.robots[r].type];
    if (!type.simulated || !type.pose_from) continue;
    // Until its pose source speaks, a simulated robot is told where it was put.
    const Pose2& X_WR = truth.movers[r].X_WR;
    reported[r] = {{X_WR.x, X_WR.y, X_WR.yaw, 0, 0}, {}, {}, true, false};
  }
}

Result<std::unique_ptr<Engine>> Engine::create(EngineSpec spec) {
  RAVE_TRY(check(spec));
  // Its end knows what to do with drivers that never close; that of its inside alone does not.
  std::unique_ptr<Engine> engine(new Engine(std::make_unique<Impl>(std::move(spec))));
  RAVE_TRY(check_threads(engine->impl_->spec, engine->impl_->pool.threads()));
  RAVE_TRY(engine->impl_->make());
  return engine;
}

void Engine::Impl::begin_step() {
  now = step_time(step);
  make_changes();
  if (!twins.empty()) {
    begin_hand_overs();
    advance_hand_overs();
  }
  events.swap(pending);  // both keep their room
  pending.clear();
  past_valid = false;  // samples of this step may change what the past looked like
  if (fusion_world) fusion_world->valid = false;
}

void Engine::Impl::work(PhaseTimer& phase) {
  if (spec.live_clock != nullptr) work_began = spec.live_clock->now();
  sense();
  phase.ends(Phase::kSense);
  deliver_messages();
  phase.ends(Phase::kRadio);
  decide();
  phase.ends(Phase::kDecide);
  carry_messages();
  phase.ends(Phase::kRadio);
  act();
  phase.ends(Phase::kAct);
}

Status Engine::Impl::step_alone() {
  PhaseTimer phase(spec.phase_clock, phase_times);
  begin_step();
  RAVE_TRY(ingest());
  phase.ends(Phase::kIngest);
  work(phase);
  truth.resolve(step, events);
  phase.ends(Phase::kResolve);
  hash.merge(truth.hash_poses(step));
  publish();
  phase.ends(Phase::kPublish);
  ++step;
  return {};
}

Status Engine::step() {
  if (impl_->host) {
    return fail(ErrorCode::kState,
                "runs some of the robots: expected propose() and apply() instead of step()");
  }
  return impl_->step_alone();
}

Status Engine::reset() { return impl_->reset(); }

const EngineSpec& Engine::spec() const noexcept { return impl_->spec; }
std::uint64_t Engine::steps_done() const noexcept { return impl_->step; }
SimTime Engine::time() const noexcept { return impl_->truth.snapshot.time(); }
const world::Snapshot& Engine::snapshot() const noexcept { return impl_->truth.snapshot; }
const ReportedPose& Engine::reported(RobotId robot) const noexcept {
  return impl_->reported[robot.value()];
}
Pose2 Engine::true_pose(RobotId robot) const noexcept {
  return impl_->truth.movers[robot.value()].X_WR;
}
bool Engine::is_local(RobotId robot) const noexcept { return impl_->is_local(robot.value()); }
std::span<const Event> Engine::events() const noexcept {
  return impl_->host ? impl_->host->events : impl_->events;
}
RunHash Engine::hash() const noexcept { return impl_->host ? impl_->host->hash : impl_->hash; }
const PhaseTimes& Engine::phase_times() const noexcept { return impl_->phase_times; }

SensorSample Engine::sensor(RobotId robot, std::uint32_t index) const noexcept {
  const RobotGroup& group = impl_->group_of(robot);
  const SensorSlots& slots = group.sensors[index];
  const std::size_t m = impl_->member_index[robot.value()];
  SensorSample sample{
      &slots.info, &slots.headers[m], slots.records.data() + std::size_t{slots.stride} * m, {}};
  if (slots.uses_fan) {
    sample.bodies =
        std::span(slots.bodies).subspan(std::size_t{slots.capacity} * m, slots.capacity);
  }
  return sample;
}

SensorParts Engine::sensor_parts(RobotId robot, std::uint32_t index) const noexcept {
  const SensorSlots& slots = impl_->group_of(robot).sensors[index];
  if (!slots.fusion) return {};
  return slots.fusion->parts_of(impl_->member_index[robot.value()]);
}

Command Engine::command(RobotId robot, std::uint32_t controller) const noexcept {
  return impl_->group_of(robot).controllers[controller].last[impl_->member_index[robot.value()]];
}

std::int64_t Engine::command_step(RobotId robot, std::uint32_t controller) const noexcept {
  const ControllerSlots& slots = impl_->group_of(robot).controllers[controller];
  return slots.last_step[impl_->member_index[robot.value()]];
}

const Command& Engine::actuator_command(RobotId robot, std::uint32_t actuator) const noexcept {
  return impl_->group_of(robot).actuators[actuator].commands[impl_->member_index[robot.value()]];
}

std::uint32_t Engine::group_count() const noexcept {
  return static_cast<std::uint32_t>(impl_->groups.size());
}

std::span<const RobotId> Engine::members(std::uint32_t group) const noexcept {
  return impl_->groups[group].members;
}

const RobotType& Engine::type_of(std::uint32_t group) const noexcept {
  return *impl_->groups[group].type;
}

SampleColumns Engine::samples(std::uint32_t group, std::uint32_t sensor) const noexcept {
  const SensorSlots& slots = impl_->groups[group].sensors[sensor];
  return {slots.headers, slots.records.data(), slots.stride};
}

CommandColumns Engine::commands(std::uint32_t group, std::uint32_t controller) const noexcept {
  const ControllerSlots& slots = impl_->groups[group].controllers[controller];
  return {slots.last, slots.last_step};
}

std::span<const Command> Engine::actuator_commands(std::uint32_t group,
                                                   std::uint32_t actuator) const noexcept {
  return impl_->groups[group].actuators[actuator].commands;
}

std::uint64_t Engine::commands_given(RobotId robot) const noexcept {
  return impl_->group_of(robot).program.given[impl_->member_index[robot.value()]];
}

bool Engine::obeys(RobotId robot) const noexcept {
  const std::size_t m = impl_->member_index[robot.value()];
  const auto& actuators = impl_->group_of(robot).actuators;
  return !actuators.empty() && std::all_of(actuators.begin(), actuators.end(),
                                           [&](const auto& slots) { return slots.obeys[m] != 0; });
}

bool Engine::program_alive(RobotId robot) const noexcept {
  const RobotGroup& group = impl_->group_of(robot);
  return group.program.spec != nullptr &&
         group.program.failed[impl_->member_index[robot.value()]] == 0;
}

std::string Engine::sensor_report(RobotId robot, std::uint32_t index) const {
  const SensorSlots& slots = impl_->group_of(robot).sensors[index];
  if (slots.is_virtual()) return "{}";
  std::string text;
  slots.spec->hardware_ops->report(slots.instances.at(impl_->member_index[robot.value()]), &text,
                                   [](void* context, const char* part, std::uint64_t size) {
                                     static_cast<std::string*>(context)->append(part, size);
                                   });
  return text;
}

std::string Engine::device_report(RobotId robot, std::uint32_t index) const {
  const DeviceSlots& slots = impl_->group_of(robot).devices[index];
  std::string text;
  slots.spec->ops->report(slots.instances.at(impl_->member_index[robot.value()]), &text,
                          [](void* context, const char* part, std::uint64_t size) {
                            static_cast<std::string*>(context)->append(part, size);
                          });
  return text;
}

void Engine::flip_percept_bit(RobotId robot, std::uint32_t sensor) noexcept {
  RAVE_CHECK(is_local(robot));
  RobotGroup& group = impl_->groups[impl_->group_index[robot.value()]];
  group.sensors[sensor].flip[impl_->member_index[robot.value()]] = 1;
}

}  // namespace rave::sim
