// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "rave/math/scalar.hpp"
#include "rave/robot/actuator.hpp"

namespace rave {

/// Omnidirectional wheels, equally spaced on a circle about the origin and tangential to it.
/// Source: R. Siegwart, I. Nourbakhsh, D. Scaramuzza, "Introduction to Autonomous Mobile Robots",
/// 2nd ed., MIT Press 2011, section 3.2 (Swedish wheels at 90 degrees). A value.
class OmniWheels {
 public:
  static constexpr std::size_t kMost = 8;
  /// By wheel, m/s, positive where it turns the robot counter-clockwise.
  using Speeds = std::array<double, kMost>;

  void set(const Params& params) {
    count_ = static_cast<std::size_t>(params.integer("wheels"));
    radius_m_ = params.number("wheel_circle_m");
    max_mps_ = params.number("max_wheel_speed_mps");
    for (std::size_t i = 0; i < count_; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(count_);
      turns_[i] = sincos(deg_to_rad(params.number("first_wheel_deg")) + 2 * kPi * share);
    }
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  [[nodiscard]] Speeds speeds(const Twist2& body) const noexcept {
    Speeds speeds{};
    for (std::size_t i = 0; i < count_; ++i) {
      speeds[i] = turns_[i].cos * body.vy - turns_[i].sin * body.vx + radius_m_ * body.wz;
    }
    return speeds;
  }

  /// The body velocity that fits the speeds best (least squares; the wheels are equally spaced).
  [[nodiscard]] Twist2 body(const Speeds& speeds) const noexcept {
    Twist2 sum;
    for (std::size_t i = 0; i < count_; ++i) {
      sum.vx -= turns_[i].sin * speeds[i];
      sum.vy += turns_[i].cos * speeds[i];
      sum.wz += speeds[i];
    }
    const auto count = static_cast<double>(count_);
    return {2 / count * sum.vx, 2 / count * sum.vy, sum.wz / (count * radius_m_)};
  }

  /// The velocity that a command asks for, scaled so that no wheel is faster than it can be.
  [[nodiscard]] Twist2 limited(const Command& command) const noexcept {
    const Twist2 asked = asked_velocity(command);
    const Speeds wanted = speeds(asked);
    double fastest_mps = 0;
    for (const double speed_mps : wanted) fastest_mps = std::max(fastest_mps, std::abs(speed_mps));
    // An overflow is no velocity.
    if (!std::isfinite(fastest_mps)) return {};
    if (fastest_mps <= max_mps_) return asked;
    const double scale = max_mps_ / fastest_mps;
    return {scale * asked.vx, scale * asked.vy, scale * asked.wz};
  }

 private:
  std::size_t count_ = 3;
  double radius_m_ = 0.15;
  double max_mps_ = 1;
  std::array<SinCos, kMost> turns_{};
};

}  // namespace rave
