// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace rave {

/// A 2x2 matrix by rows: the exact transition of (speed error, acceleration) over one step.
struct Transition {
  double a = 1;
  double b = 0;
  double c = 0;
  double d = 1;
};

[[nodiscard]] constexpr Transition operator*(const Transition& p, const Transition& q) noexcept {
  return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c,
          p.c * q.b + p.d * q.d};
}

/// exp(A dt) of A = [0 1; -omega^2 -2 zeta omega], for any damping: Taylor series of a step that is
/// halved until it is small, then squared back ("scaling and squaring"; C. Moler, C. Van Loan,
/// "Nineteen dubious ways to compute the exponential of a matrix", SIAM Review 20(4), 1978).
[[nodiscard]] inline Transition second_order_transition(double omega_radps, double zeta,
                                                        double dt_s) noexcept {
  // Time in units of 1/omega, so that the matrix is of order one.
  double tau = omega_radps * dt_s;
  int halvings = 0;
  while (tau * (1.0 + 2.0 * zeta) > 0.25) {
    tau *= 0.5;
    ++halvings;
  }
  const Transition step{0, tau, -tau, -2.0 * zeta * tau};
  Transition sum;
  Transition term;
  for (int k = 1; k <= 12; ++k) {
    term = term * step;
    term = {term.a / k, term.b / k, term.c / k, term.d / k};
    sum = {sum.a + term.a, sum.b + term.b, sum.c + term.c, sum.d + term.d};
  }
  for (; halvings > 0; --halvings) sum = sum * sum;
  return {sum.a, sum.b / omega_radps, sum.c * omega_radps, sum.d};
}

struct SpeedState {
  double speed_mps = 0;
  double acceleration_mps2 = 0;
};

/// One step of speed'' = omega^2 (wanted - speed) - 2 zeta omega speed', exact for constant
/// `wanted`, with a limit on the acceleration.
[[nodiscard]] inline SpeedState advanced(const SpeedState& now, double wanted_mps,
                                         const Transition& step, double max_acceleration_mps2,
                                         double dt_s) noexcept {
  const double error_mps = now.speed_mps - wanted_mps;
  const double free_mps = wanted_mps + step.a * error_mps + step.b * now.acceleration_mps2;
  const double acceleration_mps2 = step.c * error_mps + step.d * now.acceleration_mps2;
  const double most_mps = max_acceleration_mps2 * dt_s;
  return {now.speed_mps + std::clamp(free_mps - now.speed_mps, -most_mps, most_mps),
          std::clamp(acceleration_mps2, -max_acceleration_mps2, max_acceleration_mps2)};
}

}  // namespace rave
