// SPDX-License-Identifier: Apache-2.0
// The guard in wall time: it takes the newest sample of the pose sensor itself and does not rely on
// the step.
#include "live_guard.hpp"

#include <algorithm>
#include <utility>

#include "pose_reading.hpp"
#include "rave/math/finite.hpp"
#include "rave/math/transform.hpp"
#include "sensor_age.hpp"

namespace rave::sim {
namespace {

/// A long gap between two calls counts less and less: half of it after about 70 calls.
constexpr double kForgetGap = 0.99;
constexpr std::int64_t kQuiet_ns = from_seconds(kGuardQuiet_s).ns;

double frozen_after_s(const GuardSpec& limits) noexcept {
  return limits.frozen_s > 0 ? limits.reaction_s + limits.frozen_s : 0;
}

// A stamp ahead of now has age 0; one that is far ahead is judged where it is read.
double age_s(SimTime now, SimTime then) noexcept { return std::max(0.0, (now - then).seconds()); }

}  // namespace

LiveGuard::LiveGuard(GuardSpec limits, LivePose pose, std::vector<LiveSensor> sensors,
                     Duration period, std::vector<LiveRanges> ranges)
    : limits_(std::move(limits)),
      pose_(pose),
      sensors_(std::move(sensors)),
      period_s_(period.seconds()),
      frozen_pose_(frozen_after_s(limits_)),
      ages_(sensors_.size()) {
  for (LiveRanges& sensor : ranges)
    ranges_.emplace_back(std::move(sensor), frozen_after_s(limits_));
}

std::uint32_t LiveGuard::take_begun() noexcept { return std::exchange(begun_, 0); }

/// A command stands until the next one. That comes as late as the last ones did.
void LiveGuard::note_gap(SimTime now) {
  const double gap_s = last_call_ ? age_s(now, *last_call_) : 0;
  note_told(std::min(gap_s, kLongestGap_s));
  gap_s_ = std::min(std::max(gap_s, kForgetGap * gap_s_), kLongestGap_s);
  last_call_ = now;
}

void LiveGuard::look_for_breaks() {
  breaks_ = pose_.queue != nullptr ? pose_.queue->latest().breaks : 0;
  for (const LiveSensor& sensor : sensors_) breaks_ += sensor.queue->latest().breaks;
}

/// What the robot did since the last call.
void LiveGuard::note_told(double gap_s) {
  frozen_pose_.note_told(told_, gap_s);
  for (RangeWatch& sensor : ranges_) sensor.frozen().note_told(told_, gap_s);
}

/// Who stops, releases or arms the robot has looked at it.
void LiveGuard::forget_frozen() noexcept {
  frozen_pose_.reset();
  for (RangeWatch& sensor : ranges_) sensor.frozen().reset();
}

/// The newest sample of the pose sensor.
void LiveGuard::take_pose() {
  SampleHeader header;
  alignas(8) std::byte record[std::max(sizeof(PoseReading), sizeof(OdometryReading))];
  SampleQueue::Before before;
  if (!pose_.queue->newest(&header, record, &before) || header.count == 0) return;
  // The velocity would otherwise be estimated across the break.
  if (before.breaks != pose_breaks_) track_.clear();
  pose_breaks_ = before.breaks;
  const PoseReading read = pose_reading(pose_.kind, record);
  const Pose2 X_WR = compose(pose_.X_WM, {read.x_m, read.y_m, read.yaw_rad});
  // The same sample is read many times; add() leaves out what is not newer.
  if (!is_finite(X_WR) || !track_.add({header.stamp_ns}, X_WR)) return;
  const bool same = last_pose_ && read.x_m == last_pose_->x_m && read.y_m == last_pose_->y_m &&
                    read.yaw_rad == last_pose_->yaw_rad;
  frozen_pose_.note_sample(same);
  // A pose that stays while the robot is commanded to move may be an old one that is sent again.
  if (frozen_pose_.told_s() == 0) changed_ = {header.stamp_ns};
  last_pose_ = read;
}

void LiveGuard::look_where(const GuardOrder& order, SimTime now) {
  if (pose_.queue == nullptr) {
    const ReportedPose& told = order.reported;
    input_.X_WR = {told.pose.x_m, told.pose.y_m, told.pose.yaw_rad};
    input_.velocity = told.velocity;
    input_.pose_age_s = age_s(now, told.stamp);
    input_.pose_stamp = told.stamp;
    input_.pose_known = told.known && !told.stale && now - told.stamp <= pose_.staleness;
    return;
  }
  take_pose();
  const auto stamp = track_.newest();
  // A stamp from far ahead would count as fresh for as long as it lies ahead.
  input_.pose_known = stamp && now - *stamp <= pose_.staleness && *stamp - now <= pose_.staleness;
  if (!input_.pose_known) return;
  input_.X_WR = *track_.at(*stamp);
  input_.velocity = track_.velocity();
  input_.pose_age_s = std::max(age_s(now, *stamp), frozen_pose_.told_s());
  input_.pose_stamp = changed_;
  if (frozen_pose_.is_frozen()) input_.frozen_sensor = pose_.index;
}

void LiveGuard::look_at_sensors() {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const LiveSensor& sensor = sensors_[i];
    ages_[i] = {sensor.index, live_age_s(*sensor.queue, sensor.is_judged_by_link),
                sensor.max_age_s};
  }
}

void LiveGuard::look_at_ranges() {
  Sight sight;
  for (RangeWatch& sensor : ranges_) {
    sensor.update();
    sensor.add_to(sight);
    if (sensor.frozen().is_frozen()) input_.frozen_sensor = sensor.index();
  }
  if (limits_.must_see_rad <= 0) return;
  input_.is_blind_ahead = (sight.blind() & Sectors::ahead(limits_.must_see_rad)).any();
  input_.is_blind_behind = (sight.blind() & Sectors::behind(limits_.must_see_rad)).any();
}

/// Others have moved on since that world, or have stopped where it has them.
void LiveGuard::look_around(const GuardOrder& order, double world_age_s) {
  neighbours_ = order.neighbours;
  // Beyond the timeout `world_lost` decides what the robot does.
  const double since_s = std::min(world_age_s, limits_.world_timeout_s);
  for (const GuardNeighbour& other : order.neighbours) {
    if (other.velocity_W.vx == 0 && other.velocity_W.vy == 0) continue;
    GuardNeighbour& later = neighbours_.emplace_back(other);
    later.X_WB.x += since_s * other.velocity_W.vx;
    later.X_WB.y += since_s * other.velocity_W.vy;
  }
}

void LiveGuard::limit(const GuardOrder& order, SimTime now, std::span<Command> allowed) {
  note_gap(now);
  look_for_breaks();
  if (order.holds != std::exchange(holds_, order.holds)) forget_frozen();
  input_.frozen_sensor.reset();
  look_where(order, now);
  look_at_sensors();
  look_at_ranges();
  // Without a pose in the step, the engine could not say who is near: as good as no pose here.
  if (limits_.separation_m >= 0 && !order.sees_others) input_.pose_known = false;
  input_.world_age_s = age_s(now, order.world_time);
  look_around(order, input_.world_age_s);
  input_.dt_s = std::max(period_s_, gap_s_);
  input_.radius_m = order.radius_m;
  input_.body = order.body.get();
  GuardHolds holds = order.holds;
  // The engine disarms it as soon as it comes to these samples.
  holds.armed = holds.armed && breaks_ == order.breaks;
  guard_.set_holds(holds);
  told_ = {};
  for (std::size_t a = 0; a < order.demands.size(); ++a) {
    const ActuatorDemand& demand = order.demands[a];
    // A copy for each actuator; the spans point to what all share.
    GuardInput input = input_;
    input.neighbours = neighbours_;
    input.sensors = ages_;
    input.command = demand.command;
    input.expected = demand.expected;
    input.drive = demand.drive;
    if (demand.watched) {
      input.command_age_s =
          demand.given ? age_s(now, *demand.given) : std::numeric_limits<double>::infinity();
    }
    const GuardOutput output = guard_.limit(limits_, input);
    allowed[a] = output.command;
    if (demand.drive.moves(demand.expected)) told_ = demand.drive.motion(output.command);
    if (output.by(GuardLimit::kSensorLost)) lost_sensor_ = output.lost_sensor;
    if (output.by(GuardLimit::kFrozen)) frozen_sensor_ = *input.frozen_sensor;
    begun_ |= guard_.begin(output.acted, now.ns, kQuiet_ns);
  }
}

}  // namespace rave::sim
