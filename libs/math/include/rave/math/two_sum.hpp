// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::detail {

/// The exact result of an operation: the rounded value and the rounding error.
struct TwoSum {
  double sum = 0;
  double error = 0;
};

/// a + b. Source: Knuth, "The Art of Computer Programming", volume 2, section 4.2.2.
[[nodiscard]] constexpr TwoSum two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// a * b, without fused operations; overflow and underflow must not occur. Source: Dekker, "A
/// floating-point technique for extending the available precision", 1971.
[[nodiscard]] constexpr TwoSum two_product(double a, double b) noexcept {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double a_scaled = kSplitter * a;
  const double a_high = a_scaled - (a_scaled - a);
  const double a_low = a - a_high;
  const double b_scaled = kSplitter * b;
  const double b_high = b_scaled - (b_scaled - b);
  const double b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

}  // namespace rave::detail
