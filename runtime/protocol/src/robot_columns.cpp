// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/robot_columns.hpp"

#include "rave/bus/sequence.hpp"
#include "rave/math/transform.hpp"

namespace rave::lock_step {
namespace {

/// Bits of RobotReports::flags in world.idl.
enum ReportFlag : std::uint8_t {
  kIsKnown = 1,
  kIsStale = 2,
  kIsStopped = 4,
  kIsUnarmed = 8,
  kIsReal = 16,
  kTouches = 32,
};

}  // namespace

void RobotColumns::clear() noexcept {
  id_.clear();
  for (auto* const column : {&x_m_, &y_m_, &yaw_rad_, &vx_mps_, &vy_mps_, &wz_radps_}) {
    column->clear();
  }
  stamp_ns_.clear();
}

void RobotColumns::add(const RobotSight& sight) {
  // Messages have velocities in the world frame, sights in the body frame.
  const Vec2 v_W = rotate(sight.X_WR.yaw, {sight.velocity.vx, sight.velocity.vy});
  id_.push_back(sight.robot.value());
  x_m_.push_back(sight.X_WR.x);
  y_m_.push_back(sight.X_WR.y);
  yaw_rad_.push_back(sight.X_WR.yaw);
  vx_mps_.push_back(v_W.x);
  vy_mps_.push_back(v_W.y);
  wz_radps_.push_back(sight.velocity.wz);
  stamp_ns_.push_back(sight.stamp.ns);
}

void RobotColumns::lend(rave_wire_PlanarRobots& robots) noexcept {
  bus::borrow(robots.id, id_);
  bus::borrow(robots.x_m, x_m_);
  bus::borrow(robots.y_m, y_m_);
  bus::borrow(robots.yaw_rad, yaw_rad_);
  bus::borrow(robots.vx_mps, vx_mps_);
  bus::borrow(robots.vy_mps, vy_mps_);
  bus::borrow(robots.wz_radps, wz_radps_);
  bus::borrow(robots.stamp_ns, stamp_ns_);
}

void RobotColumns::add(const sim::Engine& engine, RobotId robot, Duration shift) {
  const world::RobotState state = engine.snapshot().robot(robot);
  if (!state.present) return;
  const bool simulated = engine.spec().types[engine.spec().robots[robot.value()].type].simulated;
  // A simulated robot is exactly where it is shown. A real one was there when its pose source
  // measured it.
  const SimTime stamp = simulated ? engine.time() : engine.reported(robot).stamp;
  const Vec2 v_B = rotate(-state.X_WR.yaw, {state.velocity_W.vx, state.velocity_W.vy});
  add({robot, stamp + shift, state.X_WR, {v_B.x, v_B.y, state.velocity_W.wz}});
}

void ReportColumns::note_contacts(const sim::Engine& engine) {
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kContact || !event.robot.valid()) continue;
    if (touching_until_s_.empty()) touching_until_s_.assign(engine.spec().robots.size(), -1);
    // A contact event marks the beginning of a touch only. A flag that held for one step would be
    // missed by monitors that receive ten states per second.
    touching_until_s_[event.robot.value()] = engine.time().seconds() + kTouch_s;
  }
}

void ReportColumns::clear() noexcept {
  id_.clear();
  for (auto* const column : {&x_m_, &y_m_, &yaw_rad_, &variance_xy_m2_, &variance_yaw_rad2_}) {
    column->clear();
  }
  flags_.clear();
}

void ReportColumns::add(const sim::Engine& engine, RobotId robot) {
  const sim::ReportedPose& reported = engine.reported(robot);
  const sim::EngineSpec& spec = engine.spec();
  const std::uint32_t r = robot.value();
  std::uint8_t flags = 0;
  const auto set = [&flags](bool on, ReportFlag flag) {
    if (on) flags = static_cast<std::uint8_t>(flags | flag);
  };
  set(reported.known, kIsKnown);
  set(reported.stale, kIsStale);
  set(engine.stopped(robot), kIsStopped);
  set(!engine.armed(robot), kIsUnarmed);
  set(!spec.types[spec.robots[r].type].simulated, kIsReal);
  set(!touching_until_s_.empty() && touching_until_s_[r] >= engine.time().seconds(), kTouches);
  id_.push_back(r);
  x_m_.push_back(reported.pose.x_m);
  y_m_.push_back(reported.pose.y_m);
  yaw_rad_.push_back(reported.pose.yaw_rad);
  variance_xy_m2_.push_back(reported.pose.variance_xy_m2);
  variance_yaw_rad2_.push_back(reported.pose.variance_yaw_rad2);
  flags_.push_back(flags);
}

void ReportColumns::lend(rave_wire_RobotReports& reports) noexcept {
  bus::borrow(reports.id, id_);
  bus::borrow(reports.x_m, x_m_);
  bus::borrow(reports.y_m, y_m_);
  bus::borrow(reports.yaw_rad, yaw_rad_);
  bus::borrow(reports.variance_xy_m2, variance_xy_m2_);
  bus::borrow(reports.variance_yaw_rad2, variance_yaw_rad2_);
  bus::borrow(reports.flags, flags_);
}

}  // namespace rave::lock_step
