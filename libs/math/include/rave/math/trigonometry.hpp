// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "rave/math/two_sum.hpp"

/// Sine, cosine and arc tangent, bit-identical on every processor and at every optimisation level:
/// they use only +, -, * and / in a fixed order, selections and bit operations. They assume IEEE
/// 754 doubles rounded to nearest and -ffp-contract=off, which rave::base exports. Angles in
/// radians. All are pure; any thread. A NaN result is always the default quiet NaN.
namespace rave {

/// The double nearest to pi.
inline constexpr double kPi = 0x1.921fb54442d18p+1;

/// Sine and cosine of one angle.
struct SinCos {
  double sin = 0;
  double cos = 1;

  friend constexpr bool operator==(SinCos, SinCos) noexcept = default;
};

namespace detail {

/// An angle minus a multiple of pi/2: value + tail is in about [-pi/4, pi/4].
struct ReducedAngle {
  double value = 0;
  double tail = 0;
  /// The multiple, modulo 4.
  std::uint64_t quadrant = 0;
};

/// Up to this angle n * kHalfPi1 and the next two products are exact (n has at most 20 bits, each
/// part 33).
inline constexpr double kMaxQuickAngle = 1.0e6;
// pi/2 as the sum of three parts of 33 bits and a remainder (Cody and Waite, "Software Manual for
// the Elementary Functions", 1980; this split as in fdlibm).
inline constexpr double kHalfPi1 = 0x1.921fb544p+0;
inline constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
inline constexpr double kHalfPi3 = 0x1.3198a2ep-69;
inline constexpr double kHalfPi4 = 0x1.b839a252049c1p-104;
/// Adding and subtracting 1.5 * 2^52 rounds to the nearest integer; the low bits of the sum are
/// then those of the integer.
inline constexpr double kRounder = 0x1.8p52;

/// For |angle| <= kMaxQuickAngle.
[[nodiscard]] inline ReducedAngle reduce_quick(double angle) noexcept {
  const double shifted = angle * 0x1.45f306dc9c883p-1 + kRounder;
  const double n = shifted - kRounder;
  const TwoSum first = two_sum(angle - n * kHalfPi1, -(n * kHalfPi2));
  const TwoSum second = two_sum(first.sum, -(n * kHalfPi3));
  const double rest = first.error + second.error - n * kHalfPi4;
  const double value = second.sum + rest;
  return {value, (second.sum - value) + rest, std::bit_cast<std::uint64_t>(shifted) & 3U};
}

/// For any finite angle beyond kMaxQuickAngle; as exact as reduce_quick, but ten times slower
/// (Payne and Hanek, "Radian reduction for trigonometric functions", 1983, in integers).
[[nodiscard]] ReducedAngle reduce_huge(double angle) noexcept;

/// Sine and cosine on [-pi/4, pi/4]; minimax coefficients of fdlibm (k_sin.c, k_cos.c; Sun
/// Microsystems 1993), errors below 2^-58.
[[nodiscard]] inline SinCos sincos_kernel(double x, double tail) noexcept {
  const double z = x * x;
  const double s =
      0x1.111111110f8a6p-7 +
      z * (-0x1.a01a019c161d5p-13 +
           z * (0x1.71de357b1fe7dp-19 + z * (-0x1.ae5e68a2b9cebp-26 + z * 0x1.5d93a5acfd57cp-33)));
  const double cube = z * x;
  const double sine = x - ((z * (0.5 * tail - cube * s) - tail) + cube * 0x1.5555555555549p-3);
  const double c = z * (0x1.555555555554cp-5 +
                        z * (-0x1.6c16c16c15177p-10 +
                             z * (0x1.a01a019cb159p-16 +
                                  z * (-0x1.27e4f809c52adp-22 +
                                       z * (0x1.1ee9ebdb4b1c4p-29 + z * -0x1.8fae9be8838d4p-37)))));
  const double half = 0.5 * z;
  const double near_one = 1.0 - half;
  const double cosine = near_one + (((1.0 - near_one) - half) + (z * c - x * tail));
  return {sine, cosine};
}

[[nodiscard]] inline double flip_sign_if(double value, std::uint64_t odd) noexcept {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ (odd << 63U));
}

[[nodiscard]] inline SinCos unreduce(SinCos part, std::uint64_t quadrant) noexcept {
  const bool swapped = (quadrant & 1U) != 0;
  const double sine = swapped ? part.cos : part.sin;
  const double cosine = swapped ? part.sin : part.cos;
  return {flip_sign_if(sine, (quadrant >> 1U) & 1U),
          flip_sign_if(cosine, ((quadrant + 1U) >> 1U) & 1U)};
}

[[nodiscard]] SinCos sincos_huge(double angle) noexcept;

}  // namespace detail

/// Sine and cosine together, within 1 ulp for every finite angle_rad; NaN otherwise.
[[nodiscard]] inline SinCos sincos(double angle_rad) noexcept {
  if (!(std::abs(angle_rad) <= detail::kMaxQuickAngle)) return detail::sincos_huge(angle_rad);
  const detail::ReducedAngle reduced = detail::reduce_quick(angle_rad);
  SinCos result =
      detail::unreduce(detail::sincos_kernel(reduced.value, reduced.tail), reduced.quadrant);
  // The sums of the reduction lose the sign of -0.
  result.sin = angle_rad == 0.0 ? angle_rad : result.sin;
  return result;
}

/// The sine; see sincos().
[[nodiscard]] inline double sin(double angle_rad) noexcept { return sincos(angle_rad).sin; }
/// The cosine; see sincos().
[[nodiscard]] inline double cos(double angle_rad) noexcept { return sincos(angle_rad).cos; }

/// The angle of the vector (x, y) in [-pi, pi], within 2 ulp; signs of zero and infinities as in
/// IEC 60559. Rational approximation of Cephes (atan.c; Moshier 1984 to 2000).
[[nodiscard]] inline double atan2(double y, double x) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  if (!(ax <= kInfinity && ay <= kInfinity)) return std::numeric_limits<double>::quiet_NaN();
  const bool steep = ay > ax;
  double small = steep ? ax : ay;
  double large = steep ? ay : ax;
  if (large == kInfinity) {
    small = small == kInfinity ? 1.0 : 0.0;
    large = 1.0;
  }
  // Prevents overflow of small + large and a subnormal 0.66 * large; quotients do not change.
  const double scale = large > 0x1p1000 ? 0.25 : (large < 0x1p-900 ? 0x1p100 : 1.0);
  small *= scale;
  large = large == 0.0 ? 1.0 : large * scale;
  const bool diagonal = small > 0.66 * large;
  const double t = diagonal ? (small - large) / (small + large) : small / large;
  const double z = t * t;
  const double p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z -
                     7.500855792314704667340e1) *
                        z -
                    1.228866684490136173410e2) *
                       z -
                   6.485021904942025371773e1;
  const double q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
                     4.328810604912902668951e2) *
                        z +
                    4.853903996359136964868e2) *
                       z +
                   1.945506571482613964425e2;
  const double angle = t + t * (z * p / q);
  // The result is k pi/4 + sign * angle; pi/4 is split in two parts so that k times the first is
  // exact.
  const bool behind = std::signbit(x);
  const double first = diagonal ? 1.0 : 0.0;
  const double half = steep ? 2.0 - first : first;
  const double k = behind ? 4.0 - half : half;
  const double signed_angle = steep != behind ? -angle : angle;
  const double result = k * 0x1.921fb544p-1 + (k * 0x1.0b4611a626331p-35 + signed_angle);
  return std::copysign(result, y);
}

}  // namespace rave
