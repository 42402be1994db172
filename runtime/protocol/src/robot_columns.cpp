// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/robot_columns.hpp"

#include "rave/math/transform.hpp"

namespace rave::lock_step {

void RobotColumns::clear() noexcept {
  id_.clear();
  for (auto* const column : {&x_m_, &y_m_, &yaw_rad_, &vx_mps_, &vy_mps_, &wz_radps_}) {
    column->clear();
  }
  stamp_ns_.clear();
}

void RobotColumns::add(const RobotSight& sight) {
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
  const SimTime stamp = simulated ? engine.time() : engine.reported(robot).stamp;
  const Vec2 v_B = rotate(-state.X_WR.yaw, {state.velocity_W.vx, state.velocity_W.vy});
  add({robot, stamp + shift, state.X_WR, {v_B.x, v_B.y, state.velocity_W.wz}});
}

}  // namespace rave::lock_step
