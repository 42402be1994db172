// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

/// Exponential, logarithm and hypotenuse, bit-identical on all processors like
/// rave/math/trigonometry.hpp. Pure; any thread. A NaN result is always the default quiet NaN.
namespace rave {

/// e to the power x, within 1 ulp; +inf above 709.78, gradual underflow to 0 below -708.4.
/// Reduction by ln 2 in two parts and the minimax coefficients of fdlibm (e_exp.c).
[[nodiscard]] inline double exp(double x) noexcept {
  constexpr double kRounder = 0x1.8p52;
  if (x != x) return std::numeric_limits<double>::quiet_NaN();
  // Beyond these bounds the scaling below overflows or underflows by itself.
  const double upper = x > 710.0 ? 710.0 : x;
  const double bounded = upper < -746.0 ? -746.0 : upper;
  const double shifted = bounded * 0x1.71547652b82fep+0 + kRounder;
  const double n = shifted - kRounder;
  const double high = bounded - n * 0x1.62e42feep-1;
  const double low = n * 0x1.a39ef35793c76p-33;
  const double r = high - low;
  const double z = r * r;
  const double c = r - z * (0x1.555555555553ep-3 +
                            z * (-0x1.6c16c16bebd93p-9 +
                                 z * (0x1.1566aaf25de2cp-14 +
                                      z * (-0x1.bbd41c5d26bf1p-20 + z * 0x1.6376972bea4dp-25))));
  const double value = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
  // Two factors, because 2^n itself may not be a normal number.
  const auto k = static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(shifted));
  const std::int32_t half = k / 2;
  const auto power = [](std::int32_t e) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52U);
  };
  return value * power(half) * power(k - half);
}

/// Natural logarithm, within 1 ulp; -inf at 0, NaN below. Coefficients of fdlibm (e_log.c).
[[nodiscard]] inline double log(double x) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (x == 0.0) return -kInfinity;
  if (!(x > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  if (x == kInfinity) return x;
  const bool subnormal = x < std::numeric_limits<double>::min();
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(subnormal ? x * 0x1p54 : x);
  // x = 2^k m with m in [sqrt(1/2), sqrt(2)). Subtracting the bits of sqrt(1/2) makes the exponent
  // field equal to k.
  constexpr std::uint64_t kRootHalf = 0x3FE6A09E667F3BCDULL;
  const std::uint64_t above = bits - kRootHalf;
  const auto exponent = static_cast<std::int64_t>(above) >> 52;
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(exponent) << 52U));
  const double k = static_cast<double>(exponent - (subnormal ? 54 : 0));
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double series =
      z * (6.666666666666735130e-01 +
           z * (3.999999999940941908e-01 +
                z * (2.857142874366239149e-01 +
                     z * (2.222219843214978396e-01 +
                          z * (1.818357216161805012e-01 +
                               z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  const double half_square = 0.5 * f * f;
  const double small = s * (half_square + series) + k * 0x1.a39ef35793c76p-33;
  return k * 0x1.62e42feep-1 - ((half_square - small) - f);
}

/// sqrt(x^2 + y^2) without spurious overflow or underflow, within 2 ulp.
[[nodiscard]] inline double hypot(double x, double y) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  if (ax == kInfinity || ay == kInfinity) return kInfinity;
  if (x != x || y != y) return std::numeric_limits<double>::quiet_NaN();
  const double large = ax > ay ? ax : ay;
  const double scale = large > 0x1p500 ? 0x1p-600 : (large < 0x1p-400 ? 0x1p600 : 1.0);
  const double unscale = large > 0x1p500 ? 0x1p600 : (large < 0x1p-400 ? 0x1p-600 : 1.0);
  const double sx = ax * scale;
  const double sy = ay * scale;
  return std::sqrt(sx * sx + sy * sy) * unscale;
}

}  // namespace rave
