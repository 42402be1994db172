// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave::testing {

/// Response of a second-order system with zeta < 1 to a step of 1 (Franklin, Powell, Emami-Naeini,
/// "Feedback Control of Dynamic Systems", section 3.4).
inline double underdamped(double omega_radps, double zeta, double t_s) {
  const double root = std::sqrt(1.0 - zeta * zeta);
  const double phase = omega_radps * root * t_s;
  return 1.0 - exp(-zeta * omega_radps * t_s) * (cos(phase) + zeta / root * sin(phase));
}

}  // namespace rave::testing
