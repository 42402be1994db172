// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include "rave/math/pose.hpp"
#include "rave/math/two_sum.hpp"

namespace rave::detail {

/// The exact sign of a sum of up to 12 doubles, represented as non-overlapping components. Source:
/// Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
/// 1997.
class ExactSum {
 public:
  void add(double value) noexcept {
    for (int i = 0; i < count_; ++i) {
      const TwoSum both = two_sum(value, parts_[static_cast<std::size_t>(i)]);
      value = both.sum;
      parts_[static_cast<std::size_t>(i)] = both.error;
    }
    parts_[static_cast<std::size_t>(count_++)] = value;
  }
  void add_product(double a, double b) noexcept {
    const TwoSum both = two_product(a, b);
    add(both.error);
    add(both.sum);
  }
  /// The largest nonzero component determines the sign.
  [[nodiscard]] int sign() const noexcept {
    for (int i = count_ - 1; i >= 0; --i) {
      const double part = parts_[static_cast<std::size_t>(i)];
      if (part != 0) return part > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  std::array<double, 12> parts_{};
  int count_ = 0;
};

/// 1 if a, b, c turn left, -1 right, 0 if they are collinear: exactly.
[[nodiscard]] inline int orientation(Vec2 a, Vec2 b, Vec2 c) noexcept {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double estimate = left - right;
  // Shewchuk's bound of the rounding error of the three lines above, rounded up.
  const double bound = 4.0e-16 * (std::abs(left) + std::abs(right));
  if (estimate > bound) return 1;
  if (estimate < -bound) return -1;
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.x, c.y);
  sum.add_product(-c.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(a.y, c.x);
  sum.add_product(c.y, b.x);
  return sum.sign();
}

}  // namespace rave::detail
