// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "arguments.hpp"
#include "room.hpp"

namespace peer {

/// A round body on two driven wheels in a room, as physics has it. Metres, seconds, radians.
///
/// A wheel follows its set speed with a first-order lag, and friction brakes it on top, so that it
/// comes to a true standstill. A wheel turns more than the body moves by its slip; now and then one
/// of them loses its grip for a while. The body cannot enter a wall: it stops there, and its wheels
/// go on turning.
class Plant {
 public:
  static constexpr double kWheelBase_m = 0.235;
  static constexpr double kRadius_m = 0.174;

  /// Options: room, pose (x,y,yaw), lag-s, friction, slip (left,right), slips
  /// (rate,share,duration).
  explicit Plant(const Arguments& given);

  /// Moves on by `dt_s`, at most a few milliseconds. Wheel speeds in metres per second.
  void advance(double dt_s, double left_mps, double right_mps, std::mt19937_64& random);

  /// Somebody carries it there; its wheels turn as they did.
  void place(double x, double y, double yaw) {
    x_ = x;
    y_ = y;
    yaw_ = yaw;
  }

  struct Wheel {
    double speed_mps = 0;   ///< Of its rim.
    double travel_m = 0;    ///< Of its rim since the beginning.
    double slip = 0;        ///< Share of its travel that does not move the body.
    double slipping_s = 0;  ///< For how long it still has no proper grip.
  };

  [[nodiscard]] const Wheel& left() const { return wheels_[0]; }
  [[nodiscard]] const Wheel& right() const { return wheels_[1]; }
  [[nodiscard]] bool still() const {
    return wheels_[0].speed_mps == 0 && wheels_[1].speed_mps == 0;
  }
  [[nodiscard]] double x() const { return x_; }
  [[nodiscard]] double y() const { return y_; }
  [[nodiscard]] double yaw() const { return yaw_; }
  [[nodiscard]] const Room& room() const { return room_; }

  /// Directions of the walls that the body touches, relative to its heading, -pi to pi.
  [[nodiscard]] const std::vector<double>& touching() const { return touching_; }
  /// How often it began to touch.
  [[nodiscard]] std::int64_t touches() const { return touches_; }
  [[nodiscard]] std::int64_t slips() const { return slips_; }
  /// Way of the body's centre.
  [[nodiscard]] double path_m() const { return path_m_; }
  /// Least distance between the body and a wall so far; 0 if it touched one.
  [[nodiscard]] double closest_m() const { return closest_m_; }

 private:
  void turn_wheel(Wheel& wheel, double wanted_mps, double dt_s) const;
  void move(double forward_m, double turn_rad);
  void feel();

  Room room_;
  double x_ = 0;
  double y_ = 0;
  double yaw_ = 0;
  double lag_s_;
  double friction_mps2_;
  double slip_rate_hz_ = 0;
  double slip_share_ = 0;
  double slip_duration_s_ = 0;
  std::array<Wheel, 2> wheels_;
  std::vector<double> touching_;
  bool was_touching_ = false;
  std::int64_t touches_ = 0;
  std::int64_t slips_ = 0;
  double path_m_ = 0;
  double closest_m_ = 1e9;
};

}  // namespace peer
