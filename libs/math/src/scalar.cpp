// SPDX-License-Identifier: Apache-2.0
#include "rave/math/scalar.hpp"

#include <array>

namespace rave::detail {

namespace {

// 2/pi: 64 zero bits, then its first 1216 binary digits.
constexpr std::array<std::uint64_t, 20> kTwoOverPi = {
    0x0000000000000000, 0xA2F9836E4E441529, 0xFC2757D1F534DDC0, 0xDB6295993C439041,
    0xFE5163ABDEBBC561, 0xB7246E3A424DD2E0, 0x06492EEA09D1921C, 0xFE1DEB1CB129A73E,
    0xE88235F52EBB4484, 0xE99C7026B45F7E41, 0x3991D639835339F4, 0x9C845F8BBDF9283B,
    0x1FF897FFDE05980F, 0xEF2F118B5A0A6D1F, 0x6D367ECF27CB09B7, 0x4F463F669E5FEA2D,
    0x7527BAC7EBE5F17B, 0x3D0739F78A5292EA, 0x6BFB5FB11F8D5D08, 0x56033046FC7B6BAB};

struct WideProduct {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
};

constexpr WideProduct multiply(std::uint64_t a, std::uint64_t b) noexcept {
  constexpr std::uint64_t kMask = 0xFFFFFFFFU;
  const std::uint64_t low = (a & kMask) * (b & kMask);
  const std::uint64_t middle1 = (a >> 32U) * (b & kMask) + (low >> 32U);
  const std::uint64_t middle2 = (a & kMask) * (b >> 32U) + (middle1 & kMask);
  return {(a >> 32U) * (b >> 32U) + (middle1 >> 32U) + (middle2 >> 32U),
          (middle2 << 32U) | (low & kMask)};
}

std::uint64_t bits_from(std::size_t position) noexcept {
  const std::size_t word = position / 64;
  const std::size_t shift = position % 64;
  if (shift == 0) return kTwoOverPi[word];
  return (kTwoOverPi[word] << shift) | (kTwoOverPi[word + 1] >> (64 - shift));
}

}  // namespace

ReducedAngle reduce_huge(double angle) noexcept {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(angle);
  const std::uint64_t mantissa = (bits & 0xFFFFFFFFFFFFFULL) | 0x10000000000000ULL;
  const auto exponent = static_cast<int>((bits >> 52U) & 0x7FFU) - 1075;
  // Digits of 2/pi that contribute multiples of 4 quadrants are skipped.
  const auto start = static_cast<std::size_t>(exponent) + 62;
  const WideProduct third = multiply(mantissa, bits_from(start + 128));
  const WideProduct second = multiply(mantissa, bits_from(start + 64));
  std::uint64_t middle = second.low + third.high;
  std::uint64_t top =
      mantissa * bits_from(start) + second.high + static_cast<std::uint64_t>(middle < second.low);
  std::uint64_t quadrant = top >> 62U;

  // The bits after the two quadrant bits are a fraction of a quadrant; above one half it is counted
  // back from the next quadrant.
  top = (top << 2U) | (middle >> 62U);
  middle = (middle << 2U) | (third.low >> 62U);
  bool negative = (top >> 63U) != 0;
  if (negative) {
    ++quadrant;
    top = ~top;
    middle = ~middle;
  }
  int scale = 0;
  while ((top >> 63U) == 0 && scale < 64) {
    top = (top << 1U) | (middle >> 63U);
    middle <<= 1U;
    ++scale;
  }
  const double power = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - scale) << 52U);
  const double high = static_cast<double>(top >> 11U) * 0x1p-53 * power;
  const double low =
      static_cast<double>(((top & 0x7FFU) << 42U) | (middle >> 22U)) * 0x1p-106 * power;
  const TwoSum product = two_product(high, 0x1.921fb54442d18p+0);
  const double rest = product.error + (high * 0x1.1a62633145c07p-54 + low * 0x1.921fb54442d18p+0);
  double value = product.sum + rest;
  double tail = (product.sum - value) + rest;
  if ((bits >> 63U) != 0) {
    negative = !negative;
    quadrant = 4U - (quadrant & 3U);
  }
  return {negative ? -value : value, negative ? -tail : tail, quadrant & 3U};
}

SinCos sincos_huge(double angle) noexcept {
  if (!std::isfinite(angle)) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    return {kNan, kNan};
  }
  const ReducedAngle reduced = reduce_huge(angle);
  return unreduce(sincos_kernel(reduced.value, reduced.tail), reduced.quadrant);
}

double wrap_outside(double angle) noexcept {
  if (!std::isfinite(angle)) return std::numeric_limits<double>::quiet_NaN();
  double wrapped = 0;
  if (std::abs(angle) <= kMaxQuickAngle) {
    const double n = (angle * 0x1.45f306dc9c883p-3 + kRounder) - kRounder;
    const TwoSum first = two_sum(angle - n * (4 * kHalfPi1), -(n * (4 * kHalfPi2)));
    const TwoSum second = two_sum(first.sum, -(n * (4 * kHalfPi3)));
    wrapped = second.sum + (first.error + second.error - n * (4 * kHalfPi4));
  } else {
    const ReducedAngle reduced = reduce_huge(angle);
    // Quadrant 3 is -1 instead of +3.
    const double quarters = reduced.quadrant == 3U ? -1.0 : static_cast<double>(reduced.quadrant);
    wrapped = quarters * (0.5 * kPi) + reduced.value;
  }
  // pi represents half a turn, and rounding may exceed the interval slightly.
  if (wrapped > kPi) wrapped -= 2.0 * kPi;
  if (wrapped <= -kPi) wrapped += 2.0 * kPi;
  return wrapped > kPi ? kPi : wrapped;
}

}  // namespace rave::detail
