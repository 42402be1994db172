// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "rave/math/pose.hpp"
#include "rave/math/scalar.hpp"

namespace rave {

/// Leads a car to a point: forward along the arc through the point (R. C. Coulter, "Implementation
/// of the Pure Pursuit Path Tracking Algorithm", CMU-RI-TR-92-01, 1992), and where no arc leads
/// there, backward first, until one does. A value; call toward() once in each decision.
class PursuitOfCar {
 public:
  PursuitOfCar() = default;
  /// `min_radius_m`: of the narrowest curve of the robot; above 0.
  explicit PursuitOfCar(double min_radius_m) noexcept : min_radius_m_(min_radius_m) {}

  /// A velocity forward, m/s, and counter-clockwise, rad/s.
  struct Velocity {
    double v_mps = 0;
    double w_radps = 0;
  };

  /// The velocity towards a point in the frame of the robot, at a speed in m/s. `may_back`: the way
  /// behind is free; otherwise it tries the narrowest curve forward.
  [[nodiscard]] Velocity toward(Vec2 goal_R, double speed_mps, bool may_back = true) noexcept {
    const double bearing_rad = atan2(goal_R.y, goal_R.x);
    const double side = goal_R.y < 0 ? -1 : 1;
    // The middle of the circle that it turns on at most; what lies inside no arc reaches.
    const Vec2 middle_R{0, side * min_radius_m_};
    const double clear_m = std::sqrt(squared_norm(goal_R - middle_R)) - min_radius_m_;
    // The bounds differ, so that it does not change its mind at each of them.
    const double inside_m = backs_ ? 0.2 * min_radius_m_ : -1e-3 * min_radius_m_;
    const double behind_rad = backs_ ? kAhead_rad : kBehind_rad;
    backs_ = may_back && (clear_m < inside_m || std::abs(bearing_rad) > behind_rad);
    if (backs_) return {-speed_mps, side * speed_mps / min_radius_m_};
    const double distance_m = std::sqrt(squared_norm(goal_R));
    if (distance_m == 0) return {};
    const double curvature = 2 * sin(bearing_rad) / distance_m;
    const double most = 1 / min_radius_m_;
    return {speed_mps, speed_mps * std::clamp(curvature, -most, most)};
  }

  /// Forgets that it was backing off.
  void begin() noexcept { backs_ = false; }

 private:
  static constexpr double kBehind_rad = 2.0;
  static constexpr double kAhead_rad = 1.0;

  double min_radius_m_ = 1;
  bool backs_ = false;
};

}  // namespace rave
