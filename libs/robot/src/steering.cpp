// SPDX-License-Identifier: Apache-2.0
// Directions in which a robot of a given width can drive, from points around it.
#include "rave/robot/steering.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave {
namespace {

constexpr int kDirections = 72;
constexpr double kSector_rad = 2.0 * kPi / kDirections;
constexpr double kInertia = 0.3;

}  // namespace

double Steering::free_m(std::span<const Vec2> points_R, double heading_rad,
                        double look_m) const noexcept {
  const SinCos angle = sincos(heading_rad);
  const Vec2 ahead{angle.cos, angle.sin};
  double free_m = std::min(look_m, look_m_);
  for (const Vec2 p_R : points_R) {
    const double along_m = dot(ahead, p_R);
    const double across_m = std::abs(cross(ahead, p_R));
    // Behind the robot, or beside its lane.
    if (along_m <= 0 || across_m >= half_width_m_) continue;
    // A disc of half the width moves ahead: it touches a point at distance `across` from its line
    // so much before the centre is abreast of it.
    const double touch_m = along_m - std::sqrt(half_width_m_ * half_width_m_ - across_m * across_m);
    free_m = std::min(free_m, std::max(touch_m, 0.0));
  }
  return free_m;
}

FreeHeading Steering::best(std::span<const Vec2> points_R, double wanted_rad,
                           double look_m) const noexcept {
  const double enough_m = std::min(look_m, look_m_);
  FreeHeading best;
  double best_cost = 1e9;
  FreeHeading farthest{wrap_angle(wanted_rad), -1};
  for (int k = 0; k < kDirections; ++k) {
    // Sectors 0, 1, -1, 2, -2, ... from the wanted direction.
    const int sectors = k % 2 == 1 ? (k + 1) / 2 : -(k / 2);
    const double heading_rad = wrap_angle(wanted_rad + sectors * kSector_rad);
    // Away from the wanted direction costs, and turning costs too, so that two equal ways are not
    // taken in turn.
    const double cost = std::abs(sectors) * kSector_rad + kInertia * std::abs(heading_rad);
    if (cost >= best_cost) continue;
    const double free = free_m(points_R, heading_rad, look_m);
    if (free > farthest.free_m) farthest = {heading_rad, free};
    if (free < enough_m) continue;
    best = {heading_rad, free};
    best_cost = cost;
  }
  // No direction is free far enough: the one with the most room.
  return best_cost < 1e9 ? best : farthest;
}

FreeHeading Steering::first(std::span<const Vec2> points_R, double from_rad, int side,
                            double look_m) const noexcept {
  const double enough_m = std::min(look_m, look_m_);
  FreeHeading farthest{wrap_angle(from_rad), -1};
  for (int k = 0; k < kDirections; ++k) {
    const double heading_rad = wrap_angle(from_rad + side * k * kSector_rad);
    const double free = free_m(points_R, heading_rad, look_m);
    if (free >= enough_m) return {heading_rad, free};
    if (free > farthest.free_m) farthest = {heading_rad, free};
  }
  return farthest;
}

}  // namespace rave
