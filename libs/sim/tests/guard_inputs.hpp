// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/sim/guard.hpp"

/// For tests of the guard as a function.
namespace rave::sim {

/// The body of a robot with a radius of 0.2 m.
inline const world::Body& disc() {
  static const world::Body kBody = [] {
    world::Body made;
    made.shapes.push_back(world::make_disc({}, 0.2, 0, 0.3).value());
    return made;
  }();
  return kBody;
}

inline GuardInput input(double v_mps, double w_radps, const Pose2& X_WR = {}) {
  GuardInput in;
  in.command = velocity_command(v_mps, w_radps);
  in.X_WR = X_WR;
  in.radius_m = 0.2;
  in.body = &disc();
  return in;
}

inline std::vector<Vec2> square(double half_m) {
  return {{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}};
}

}  // namespace rave::sim
