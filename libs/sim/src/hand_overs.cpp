// SPDX-License-Identifier: Apache-2.0
// How a robot changes between its two sets of drivers. It is a chain of stages that advances with
// the steps; until the exchange the robot keeps the drivers that it has, and each failure is a
// refusal.
#include "hand_overs.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "pose_reading.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::sim {
namespace {

/// How long drivers may take to be opened: hardware that is there answers within seconds.
constexpr Duration kOpen{30'000'000'000};
/// How long the pose source of a set that was opened may be silent.
constexpr Duration kListen{5'000'000'000};
/// How long a robot may take to come to stand.
constexpr Duration kComeToStand{10'000'000'000};
/// A real robot has to be seen to stand for so long.
constexpr Duration kSeenToStand{300'000'000};
/// A reading that is older says nothing about the present.
constexpr Duration kFresh{500'000'000};
/// The reported velocity of a real robot that stands is that of the noise of its pose source.
constexpr double kReportedStill_mps = 0.03;
constexpr double kReportedStill_radps = 0.15;
constexpr double kWheelsStill_mps = 0.005;
constexpr double kWheelsStill_radps = 0.02;
constexpr double kTrueStill_mps = 0.001;
constexpr double kTrueStill_radps = 0.01;

bool is_below(const Twist2& twist, double mps, double radps) noexcept {
  return std::sqrt(squared_norm(Vec2{twist.vx, twist.vy})) <= mps && std::abs(twist.wz) <= radps;
}

/// Whether a type has what may take seconds to be found.
bool has_hardware(const RobotType& type) {
  const auto is_real = [](const auto& device) { return device.hardware_ops != nullptr; };
  return std::any_of(type.sensors.begin(), type.sensors.end(), is_real) ||
         std::any_of(type.actuators.begin(), type.actuators.end(), is_real) ||
         !type.devices.empty();
}

}  // namespace

void HandOvers::set_step(std::uint64_t step) noexcept {
  step_ = step;
  now_ = {static_cast<std::int64_t>(step) * spec_.step.ns};
}

Status HandOvers::check(const Twin& twin, DriverSet to) const {
  const std::string& name = spec_.robots[twin.robot.value()].name;
  const RobotType& target = spec_.types[twin.type_of(to)];
  if (twin.stage != Twin::Stage::kIdle) {
    return fail(ErrorCode::kState, "robot `{}` is already being handed over", name);
  }
  if (twin.given_up) {
    return fail(ErrorCode::kState,
                "the {} drivers of robot `{}` are still opening for an abandoned hand-over",
                reality_of(target), name);
  }
  if (twin.state.active == to) {
    return fail(ErrorCode::kState, "robot `{}` already has its {} drivers", name,
                reality_of(target));
  }
  // The body of a real robot is what it is; it cannot take over one of another size.
  const double scale = truth_.scale_of(twin.robot);
  if (!target.simulated && scale != 1) {
    return fail(ErrorCode::kState, "the body of robot `{}` has `scale` {}; a real one has 1", name,
                scale);
  }
  return {};
}

Status HandOvers::ask(std::uint64_t step, RobotId robot, DriverSet to, const Author& author) {
  Twin* const twin = find(robot);
  if (twin == nullptr) {
    return fail(ErrorCode::kInvalidArgument,
                "robot `{}` has one set of drivers; `twin:` in the scenario names another",
                spec_.robots[robot.value()].name);
  }
  RAVE_TRY(check(*twin, to));
  set_step(step);
  log_.count(author);
  twin->author = author;
  twin->state.under_way = true;
  twin->state.by_hand = author.by_hand;
  twin->state.to = to;
  twin->heard.reset();
  begin_stage(*twin, Twin::Stage::kOpening);
  // In a live run no other robot waits for this hardware. A stepped run waits.
  const bool beside = spec_.live_clock != nullptr && has_hardware(spec_.types[twin->type_of(to)]);
  // The set may still be closing after an earlier hand-over; it must be closed before it is opened.
  auto open = [this, twin, before = std::move(twin->work)] {
    before.wait();
    return open_other(*twin);
  };
  twin->work = beside ? SideTask::in_thread(std::move(open)) : SideTask::later(std::move(open));
  return {};
}

void HandOvers::begin_stage(Twin& twin, Twin::Stage stage) {
  twin.stage = stage;
  twin.since = now_;
  twin.moved_at = twin.since;
  // Only from here on does the robot stand. While devices are being opened it continues with its
  // task.
  guards_[twin.robot.value()].hold(stage == Twin::Stage::kStanding);
}

void HandOvers::advance(std::uint64_t step) {
  set_step(step);
  begin_scheduled();
  for (Twin& twin : twins_) {
    if (twin.given_up) close_late(twin);
    if (twin.stage != Twin::Stage::kIdle) advance(twin);
  }
}

/// Drivers that were open too late for the hand-over that waited for them.
void HandOvers::close_late(Twin& twin) {
  if (!twin.work.ready()) return;
  twin.given_up = false;
  // A driver that could not be opened was closed by the task that tried.
  if (twin.work.get()) close_other(twin);
}

void HandOvers::skip_to(std::uint64_t step) {
  set_step(step);
  for (Twin& twin : twins_) {
    if (twin.stage != Twin::Stage::kIdle) twin.since = twin.moved_at = now_;
  }
}

// One stage after the other, and several in one step if nothing has to be waited for: open, listen,
// stand, exchange. Once it is open, the other set is listened to in every step, so that a failure
// ends the hand-over before anything has changed.
void HandOvers::advance(Twin& twin) {
  if (twin.stage == Twin::Stage::kOpening) {
    if (!twin.work.ready()) {
      if (now_ - twin.since <= kOpen) return;
      twin.given_up = true;
      return refuse(twin, fmt::format("its drivers did not open within {:.0f} s", kOpen.seconds()));
    }
    const Status opened = twin.work.get();
    if (!opened) return refuse(twin, opened.error().text());
    begin_stage(twin, Twin::Stage::kListening);
  }
  const Status healthy = listen(twin);
  if (!healthy) return refuse(twin, healthy.error().text());
  if (twin.stage == Twin::Stage::kListening) {
    if (!is_heard(twin)) return;
    begin_stage(twin, Twin::Stage::kStanding);
  }
  if (!stands(twin)) {
    if (now_ - twin.since <= kComeToStand) return;
    return refuse(twin, fmt::format("it did not come to rest within {} s", kComeToStand.seconds()));
  }
  // Where it was long ago is not where it is; silence is listen()'s to judge.
  if (twin.heard && now_ - twin.heard_at > twin.other.type->staleness) return;
  const Status near = check_near(twin);
  if (!near) return refuse(twin, near.error().text());
  change_drivers(twin);
}

/// Whether the other set says where the robot is, if it has to.
bool HandOvers::is_heard(const Twin& twin) const noexcept {
  const RobotType& type = *twin.other.type;
  const bool asks = type.pose_from && type.sensors[*type.pose_from].hardware_ops != nullptr;
  return !asks || twin.heard.has_value();
}

/// Takes in what the other set has said, so that nothing old is left when it begins to serve.
Status HandOvers::listen(Twin& twin) {
  for (std::size_t s = 0; s < twin.other.sensors.size(); ++s) {
    SensorSlots& slots = twin.other.sensors[s];
    if (slots.is_virtual()) continue;
    SampleHeader sample;
    while (slots.queues[0]->next(now_, &sample, slots.scratch.data())) {
      if (twin.other.type->pose_from != s || sample.count == 0) continue;
      const PoseReading said = pose_reading(slots.spec->kind, slots.scratch.data());
      if (!std::isfinite(said.x_m) || !std::isfinite(said.y_m) || !std::isfinite(said.yaw_rad))
        continue;
      twin.heard = said;
      twin.heard_at = {sample.stamp_ns};
    }
    const std::string failure = slots.queues[0]->failure();
    if (!failure.empty()) {
      return fail(ErrorCode::kState, "sensor `{}`: {}", slots.spec->name, failure);
    }
  }
  const bool lost = twin.heard && now_ - twin.heard_at > kListen;
  if (!lost && (is_heard(twin) || now_ - twin.since <= kListen)) return {};
  return fail(ErrorCode::kTimeout, "sensor `{}` has not reported the pose of the robot for {} s",
              twin.other.sensors[*twin.other.type->pose_from].spec->name, kListen.seconds());
}

bool HandOvers::stands(Twin& twin) {
  const std::uint32_t r = twin.robot.value();
  const RobotGroup& group = group_of(twin);
  // The command that makes it stand has to reach it first.
  if (now_ <= twin.since) return false;
  // Of a simulated robot the truth is known; it needs no time of observation.
  if (group.type->simulated) {
    return is_below(truth_.velocity[r], kTrueStill_mps, kTrueStill_radps);
  }
  // A recording moves as it did, whatever is commanded.
  const bool obeys = std::any_of(group.actuators.begin(), group.actuators.end(),
                                 [](const ActuatorSlots& slots) { return slots.obeys[0] != 0; });
  if (!obeys) return true;
  // Reported poses come late and are noisy: one still reading is not standing.
  if (!moves_seen(group, r)) return now_ - twin.moved_at >= kSeenToStand;
  twin.moved_at = now_;
  return false;
}

/// Whether a real robot is seen to move, or cannot be seen.
bool HandOvers::moves_seen(const RobotGroup& group, std::uint32_t robot) const {
  const ReportedPose& pose = reported_[robot];
  if (!pose.known || pose.stale) return true;
  if (!is_below(pose.velocity, kReportedStill_mps, kReportedStill_radps)) return true;
  // An actuator that failed may not have received the command to stand.
  for (const ActuatorSlots& slots : group.actuators) {
    if (slots.failed[0] != 0) return true;
  }
  for (const SensorSlots& slots : group.sensors) {
    if (slots.spec->kind != ReadingKind::kOdometry) continue;
    if (slots.headers[0].count == 0) return true;
    if (now_.ns - slots.headers[0].stamp_ns > kFresh.ns) return true;
    OdometryReading wheels;
    std::memcpy(&wheels, slots.records.data(), sizeof wheels);
    if (!is_below({wheels.v_mps, 0, wheels.w_radps}, kWheelsStill_mps, kWheelsStill_radps)) {
      return true;
    }
  }
  return false;
}

void HandOvers::refuse(Twin& twin, const std::string& why) {
  // What is still being opened belongs to who opens it.
  if (!twin.given_up && twin.made) close_other(twin);
  ++twin.state.refused;
  const std::string from(reality_of(*group_of(twin).type));
  end(twin, EventKind::kHandOverRefused,
      fmt::format("{} -> {}: {}", from, reality_of(*twin.other.type), why));
}

void HandOvers::end(Twin& twin, EventKind kind, std::string text) {
  begin_stage(twin, Twin::Stage::kIdle);
  twin.state.under_way = false;
  twin.state.last = text;
  log_.note_outcome(step_, twin.robot, kind, std::move(text), twin.author);
}

void HandOvers::begin_scheduled() {
  for (; next_ < spec_.hand_overs.size() && spec_.hand_overs[next_].step <= step_; ++next_) {
    const ScheduledHandOver& asked = spec_.hand_overs[next_];
    if (!roster_.is_local(asked.robot)) continue;
    const Status begun = ask(step_, asked.robot, asked.to, Author::kRun);
    if (begun) continue;
    if (Twin* const twin = find(asked.robot)) ++twin->state.refused;
    log_.note(step_, asked.robot, EventKind::kHandOverRefused, begun.error().text(), Author::kRun);
  }
}

const HandOverState* HandOvers::state(RobotId robot) const noexcept {
  const Twin* const twin = find(robot);
  return twin == nullptr ? nullptr : &twin->state;
}

}  // namespace rave::sim
