// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"

namespace rave {

/// A sample of the standard normal distribution (mean 0, variance 1), at most 8.6 in magnitude. It
/// always takes two uniform numbers from `stream`. Bit-identical on all processors. Source: Box and
/// Muller, "A note on the generation of random normal deviates", 1958.
[[nodiscard]] inline double gaussian(RandomStream& stream) noexcept {
  const double u = 1.0 - stream.uniform();  // in (0, 1], so that the logarithm is finite
  const double turn_rad = 2.0 * kPi * stream.uniform();
  return std::sqrt(-2.0 * log(u)) * cos(turn_rad);
}

}  // namespace rave
