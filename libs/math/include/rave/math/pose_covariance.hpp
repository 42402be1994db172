// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/pose.hpp"
#include "rave/math/scalar.hpp"

namespace rave {

/// Variance of one movement along an arc: of its length and of its turn.
struct ArcVariance {
  double length_m2 = 0;
  double turn_rad2 = 0;
  double length_turn_m_rad = 0;  ///< Covariance of length and turn.
};

/// Covariance of a pose that is integrated from arcs: a symmetric 3 x 3 matrix as six numbers.
/// Initially zero.
struct PoseCovariance {
  double xx = 0;
  double yy = 0;
  double tt = 0;  ///< Variance of the yaw.
  double xy = 0;
  double xt = 0;
  double yt = 0;

  /// Propagates the covariance along an arc of `length_m` whose chord points along `chord`: P' = F
  /// P F^T + G Q G^T with F = d pose'/d pose and G = d pose'/d (length, turn). The chord is taken
  /// to be as long as the arc, because turns between samples are small. Source: Siegwart and
  /// Nourbakhsh, "Introduction to Autonomous Mobile Robots", 2004, 5.2.4.
  void grow(double length_m, SinCos chord, const ArcVariance& arc) noexcept {
    // Shift of the end of the arc per radian of heading error at its start.
    const double fx = -length_m * chord.sin;
    const double fy = length_m * chord.cos;
    xx += 2 * fx * xt + fx * fx * tt;
    yy += 2 * fy * yt + fy * fy * tt;
    xy += fx * yt + fy * xt + fx * fy * tt;
    xt += fx * tt;
    yt += fy * tt;
    // An error of the turn changes the heading of the chord by half of it.
    const double gx = 0.5 * fx;
    const double gy = 0.5 * fy;
    const double shared = arc.length_turn_m_rad;
    xx += chord.cos * chord.cos * arc.length_m2 + gx * gx * arc.turn_rad2 +
          2 * chord.cos * gx * shared;
    yy += chord.sin * chord.sin * arc.length_m2 + gy * gy * arc.turn_rad2 +
          2 * chord.sin * gy * shared;
    xy += chord.cos * chord.sin * arc.length_m2 + gx * gy * arc.turn_rad2 +
          (chord.cos * gy + chord.sin * gx) * shared;
    xt += gx * arc.turn_rad2 + chord.cos * shared;
    yt += gy * arc.turn_rad2 + chord.sin * shared;
    tt += arc.turn_rad2;
  }
};

}  // namespace rave
