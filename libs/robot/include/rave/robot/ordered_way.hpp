// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rave/math/scalar.hpp"
#include "rave/robot/percepts.hpp"

namespace rave {

/// The path that users ordered a robot to follow, for programs that take goals or paths. The last
/// order counts until it is cancelled. A value; call update() once in each decision.
class OrderedWay {
 public:
  enum class State : std::uint8_t {
    kNone,     ///< No order: the program follows its own task.
    kGoing,    ///< On the way to next().
    kTurning,  ///< At the end, turning with turn_radps() to the ordered heading.
    kThere,    ///< At the end; standing until the next order.
  };

  OrderedWay() = default;
  /// `turns`: the robot turns on the spot; otherwise an ordered heading does not count.
  explicit OrderedWay(bool turns) noexcept : turns_(turns) {}

  /// Takes the orders of this decision and advances past points that are nearer than `tolerance_m`,
  /// or before the last one than `pass_m` if that is more. Sends an answer on arrival. Returns true
  /// if the path, its state or the next point has changed.
  bool update(const Percepts& percepts, Commands& commands, double tolerance_m, double pass_m = 0) {
    const State before = state_;
    const std::size_t point = next_;
    bool changed = false;
    for (const Order order : percepts.orders()) changed |= take(order);
    if (state_ == State::kGoing) go(percepts.pose(), tolerance_m, pass_m);
    if (state_ == State::kTurning && std::abs(turn_left_rad(percepts.pose())) < kNear_rad) {
      state_ = State::kThere;
    }
    if (state_ == State::kThere && before != State::kThere) {
      commands.done(points_W_.size() == 1 ? "I am at the goal." : "I am at the end of the path.");
    }
    return changed || state_ != before || next_ != point;
  }

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] bool asked() const noexcept { return state_ != State::kNone; }
  /// The next point, world frame; valid while kGoing.
  [[nodiscard]] Vec2 next() const noexcept { return points_W_[next_]; }
  /// The lower of `own_mps` and the ordered speed limit.
  [[nodiscard]] double speed_mps(double own_mps) const noexcept {
    return speed_mps_ > 0 ? std::min(speed_mps_, own_mps) : own_mps;
  }
  /// The ordered speed limit; 0: none.
  [[nodiscard]] double asked_speed_mps() const noexcept { return speed_mps_; }
  /// Turning rate for kTurning, at most `most_radps`.
  [[nodiscard]] double turn_radps(const PoseReading& pose, double most_radps) const noexcept {
    return std::clamp(2 * turn_left_rad(pose), -most_radps, most_radps);
  }

 private:
  static constexpr double kNear_rad = 0.05;

  bool take(const Order& order) {
    if (order.kind == OrderKind::kCancel) {
      state_ = State::kNone;
      return true;
    }
    if (order.kind != OrderKind::kGoal && order.kind != OrderKind::kPath) return false;
    points_W_.assign(order.points_W.begin(), order.points_W.end());
    yaw_rad_ = order.yaw_rad;
    speed_mps_ = order.speed_mps;
    next_ = 0;
    state_ = State::kGoing;
    return true;
  }
  void go(const PoseReading& pose, double tolerance_m, double pass_m) {
    while (state_ == State::kGoing) {
      const bool last = next_ + 1 == points_W_.size();
      const double near_m = last ? tolerance_m : std::max(tolerance_m, pass_m);
      if (squared_norm(next() - Vec2{pose.x_m, pose.y_m}) > near_m * near_m) return;
      if (++next_ < points_W_.size()) continue;
      state_ = yaw_rad_ && turns_ ? State::kTurning : State::kThere;
    }
  }
  [[nodiscard]] double turn_left_rad(const PoseReading& pose) const noexcept {
    return wrap_angle(yaw_rad_.value_or(pose.yaw_rad) - pose.yaw_rad);
  }

  bool turns_ = true;
  State state_ = State::kNone;
  std::vector<Vec2> points_W_;
  std::size_t next_ = 0;
  std::optional<double> yaw_rad_;
  double speed_mps_ = 0;
};

}  // namespace rave
