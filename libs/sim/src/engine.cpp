// SPDX-License-Identifier: Apache-2.0
// The life of an engine: checked, made, begun, stepped, reset. The phases of a step are in files of
// their own, in the order of work().
#include "rave/sim/engine.hpp"

#include <algorithm>

#include "engine_impl.hpp"
#include "radio.hpp"
#include "rave/base/check.hpp"
#include "rave/base/word_table.hpp"
#include "rave/math/transform.hpp"
#include "spec_checks.hpp"

namespace rave::sim {
namespace {

/// How old a real sample may be when it is fused.
constexpr Duration kHybridHistory{1'000'000'000};

constexpr WordTable<EventKind, 30> kEventWords = {{
    {"contact", EventKind::kContact},
    {"pinned", EventKind::kPinned},
    {"pose stale", EventKind::kPoseStale},
    {"pose back", EventKind::kPoseBack},
    {"program failed", EventKind::kProgramFailed},
    {"driver failed", EventKind::kDriverFailed},
    {"driver back", EventKind::kDriverBack},
    {"guard slowed", EventKind::kGuardSlowed},
    {"guard stopped", EventKind::kGuardStopped},
    {"stopped", EventKind::kStopped},
    {"released", EventKind::kReleased},
    {"armed", EventKind::kArmed},
    {"changed", EventKind::kChanged},
    {"change refused", EventKind::kChangeRefused},
    {"obstacle added", EventKind::kObstacleAdded},
    {"obstacle moved", EventKind::kObstacleMoved},
    {"obstacle removed", EventKind::kObstacleRemoved},
    {"captured", EventKind::kCaptured},
    {"handed over", EventKind::kHandedOver},
    {"hand over refused", EventKind::kHandOverRefused},
    {"shadow reset", EventKind::kShadowReset},
    {"ordered", EventKind::kOrdered},
    {"said", EventKind::kSaid},
    {"placed", EventKind::kPlaced},
    {"lease", EventKind::kLease},
    {"pose refused", EventKind::kPoseRefused},
    {"sensor restarted", EventKind::kSensorRestarted},
    {"disarmed", EventKind::kDisarmed},
    {"scenario", EventKind::kScenario},
    {"team given", EventKind::kTeamGiven},
}};

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
    // A hand-over can put the twin in charge in any step. History cannot be made up later, so it is
    // kept from the start.
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
    // Robots of other hosts have no drivers here; their own host checks them.
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

std::string_view to_string(EventKind kind) noexcept { return kEventWords.of(kind, "unknown"); }

Engine::Impl::Impl(EngineSpec s)
    : spec(std::move(s)),
      log_outlet(spec.log),
      roster(local_robots(spec)),
      host(spec.local ? std::make_unique<HostPart>(spec, roster.local) : nullptr),
      pool(spec.threads, spec.share_always),
      workers(pool.threads()),
      truth(spec, pool),
      hand_overs({spec, roster, truth, robot_guards, reported, input_log, *this}),
      inputs({spec, roster, truth, robot_guards, orders, hand_overs, input_log,
              [this](RobotId robot) { body_changed(robot); },
              [this](const ObstacleChange& change) { obstacle_changed(change); }}) {
  if (spec.live_clock != nullptr) spec.live_clock = &clock_outlet.emplace(*spec.live_clock);
  if (!has_hybrid(spec, roster.local)) return;
  // The virtual half of a hybrid needs the world at the stamp of the real sample, so the past is
  // kept for as long as a sample may be late.
  spec.history = std::max(spec.history, kHybridHistory);
  fusion_world = std::make_unique<FusionWorld>(spec.world);
}

void Engine::Impl::tell_complaints() const {
  for (const RobotGroup& group : roster.groups) before_closing(group);
}

void Engine::Impl::before_closing(const RobotGroup& group) const {
  if (spec.log == nullptr) return;
  for (const SensorSlots& slots : group.sensors) {
    for (std::size_t m = 0; m < slots.queues.size(); ++m) {
      const std::string complaint = slots.queues[m]->complaint();
      if (complaint.empty()) continue;
      // Once, when the driver is closed: one that breaks its contract mostly does so with every
      // sample.
      spec.log->warn(roster.logs[group.members[m].value()].source,
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
    spec.log->warn(roster.logs[group.members[m].value()].source,
                   "sensor `{}`: {} readings were withheld, because the pose of the robot or the "
                   "world at their stamps was no longer known (history {} s)",
                   slots.spec->name, count, spec.history.seconds());
  }
}

Status Engine::Impl::make() {
  roster.lay_out(spec, spec.log != nullptr ? &log_outlet : nullptr);
  // Before the groups, because the setup of a program lists its communicators.
  radio = std::make_unique<Radio>(spec, roster.local, roster.logs, pool);
  hand_overs.make(radio.get());
  RAVE_TRY(radio->make());
  for (RobotGroup& group : roster.groups) RAVE_TRY(make_group(group_context(), group));
  return begin();
}

Status Engine::Impl::reset() {
  tell_complaints();
  // Robots stand before anything is closed: a driver may take long to close, and what it was told
  // last would count until then.
  halt();
  RAVE_TRY(hand_overs.restore());
  // All are closed first: what two robots share must be free before one of them opens it again.
  if (!close_all(take_open()) || !close_all(radio->take_open())) {
    return fail(ErrorCode::kState,
                "the run cannot restart while drivers of the last run are closing");
  }
  restore_world();
  radio->clear();
  for (RobotGroup& group : roster.groups) RAVE_TRY(reset_group(group_context(), group));
  return begin();
}

Status Engine::Impl::begin() {
  set_initial_state();
  // The clock of a live run starts now. Sensors are opened after it, since their stamps are on it.
  if (spec.on_ready) spec.on_ready();
  for (RobotGroup& group : roster.groups) RAVE_TRY(open_sensors(group_context(), group));
  RAVE_TRY(radio->open());
  // Last, because the guards read the queues of sensors and write to actuators: both must be open.
  return start_guards();
}

void Engine::Impl::set_initial_state() {
  const std::size_t count = spec.robots.size();
  step = 0;
  now = {};
  hash = RunHash();
  phase_times = {};
  events.clear();
  input_log.clear();
  inputs.begin();
  if (spec.conductor && !host) spec.conductor->begin();
  hand_overs.begin();
  world_age = {};
  orders.clear();
  answers.clear();
  set_up_guards();
  history.clear();
  forget_past();
  truth.begin();
  if (host) host->begin();
  reported.assign(count, ReportedPose{});
  // The velocity of a robot is estimated from its track, so a track is kept even without a history.
  const Duration keep = std::max(spec.history, from_seconds(1.0));
  tracks.assign(count, PoseTrack(keep));
  for (std::uint32_t r = 0; r < count; ++r) {
    const RobotType& type = spec.types[spec.robots[r].type];
    if (!type.simulated || !type.pose_from) continue;
    // Until its pose source reports, the reported pose of a simulated robot is its start pose.
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
  inputs.make_scheduled(step);
  conduct();
  if (!hand_overs.empty()) hand_overs.advance(step);
  input_log.begin_step(events);
  forget_past();
}

void Engine::Impl::forget_past() {
  past.valid = false;
  if (fusion_world) fusion_world->valid = false;
}

// The stages of a step, as in the table of docs/explanation/engine.md. One of several hosts calls
// work() between two worlds of the authority, which resolves the motion of all.
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
  // All proposals are there. No phase before this one has moved a simulated robot, except out of
  // the way of a real one.
  truth.resolve(step, events);
  phase.ends(Phase::kResolve);
  hash.merge(truth.hash_poses(step));
  // Last, because the events of resolve() belong to this step, too, and events are hashed in order.
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

}  // namespace rave::sim
