// SPDX-License-Identifier: Apache-2.0
#include "create_oi/wheel_speeds.hpp"

#include <algorithm>
#include <cmath>

namespace rave::oi {

WheelSpeeds wheel_speeds(double v_mps, double w_radps, double wheel_base_m,
                         double max_mmps) noexcept {
  const double left = 1e3 * (v_mps - w_radps * wheel_base_m / 2);
  const double right = 1e3 * (v_mps + w_radps * wheel_base_m / 2);
  const double most = std::max(std::abs(left), std::abs(right));
  if (!std::isfinite(most)) return {};
  const double scale = most > max_mmps ? max_mmps / most : 1.0;
  return {static_cast<std::int32_t>(std::lround(left * scale)),
          static_cast<std::int32_t>(std::lround(right * scale))};
}

}  // namespace rave::oi
