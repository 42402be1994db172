// SPDX-License-Identifier: Apache-2.0
#include "rave/math/scalar.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "rave/base/random.hpp"

namespace rave {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr std::array kSpecial = {0.0,  -0.0,    kTiny,  -kTiny, 0x1p-1022, 3e-310, 1e-300,  1e-17,
                                 1.0,  -1.0,    0.5,    -0.5,   kPi,       -kPi,   kPi / 2, kPi / 4,
                                 1e6,  1e6 + 1, 1e22,   1e300,  kMax,      -kMax,  kInf,    -kInf,
                                 kNan, 709.78,  709.79, -745.1, -745.2,    -708.5, 2.0,     0.66};
// The multiple of pi/2 that a double comes nearest to (Muller, "Elementary Functions", 2006).
constexpr double kWorst = 0x1.6ac5b262ca1ffp+849;

/// Distance from the long double reference in units of the last place of its rounded value.
double ulps(double actual, long double expected) {
  if (std::isnan(expected)) return std::isnan(actual) ? 0.0 : 1e9;
  const auto rounded = static_cast<double>(expected);
  if (std::isinf(rounded) || rounded == 0) {
    if (actual == rounded && std::signbit(actual) == std::signbit(rounded)) return 0.0;
    if (std::isinf(actual) || std::isinf(rounded)) return 1e9;
  }
  const double size = std::max(std::abs(rounded), 0x1p-1022);
  const double ulp = std::ldexp(1.0, std::ilogb(size) - 52);
  return static_cast<double>(std::abs(static_cast<long double>(actual) - expected)) / ulp;
}

/// Arguments of every size that matters, the special ones first.
template <class Visit>
void for_arguments(Visit visit) {
  for (const double x : kSpecial) visit(x);
  visit(kWorst);
  RandomStream random(7, 0, 0, 0);
  for (int i = 0; i < 100'000; ++i) {
    visit(random.uniform(-8, 8));
    visit(random.uniform(-800, 800));
    visit(random.uniform(-1.1e6, 1.1e6));
    // Drawn one after the other: the order of two draws in one call is the compiler's choice.
    const double part = random.uniform(-1, 1);
    visit(std::ldexp(part, static_cast<int>(random.bits() % 2098) - 1074));
    // Close to multiples of pi/2, where the reduction cancels.
    visit(std::floor(random.uniform(-6e5, 6e5)) * (kPi / 2));
  }
}

template <class Function, class Reference>
void expect_accurate(std::string_view name, Function function, Reference reference, double bound) {
  double worst = 0;
  double where = 0;
  for_arguments([&](double x) {
    const double error = ulps(function(x), reference(static_cast<long double>(x)));
    if (!(error <= worst)) {
      worst = error;
      where = x;
    }
  });
  EXPECT_LE(worst, bound) << name << " at " << where;
  ::testing::Test::RecordProperty(std::string(name), std::to_string(worst));
}

TEST(Scalar, SineAndCosineAreWithinOneUlp) {
  expect_accurate(
      "sin", [](double x) { return sin(x); }, [](long double x) { return sinl(x); }, 1);
  expect_accurate(
      "cos", [](double x) { return cos(x); }, [](long double x) { return cosl(x); }, 1);
}

TEST(Scalar, TangentIsWithinThreeUlp) {
  expect_accurate(
      "tan", [](double x) { return tan(x); }, [](long double x) { return tanl(x); }, 3);
}

TEST(Scalar, ExponentialAndLogarithmAreWithinOneUlp) {
  expect_accurate(
      "exp", [](double x) { return exp(x); }, [](long double x) { return expl(x); }, 1);
  expect_accurate(
      "log", [](double x) { return log(x); }, [](long double x) { return logl(x); }, 1);
}

TEST(Scalar, LogarithmNearOneIsWithinOneUlp) {
  RandomStream random(8, 0, 0, 0);
  for (int i = 0; i < 100'000; ++i) {
    const double x = random.uniform(0.5, 2);
    ASSERT_LE(ulps(log(x), logl(static_cast<long double>(x))), 1) << x;
  }
}

TEST(Scalar, ArcFunctionsAreWithinThreeUlp) {
  RandomStream random(9, 0, 0, 0);
  for (int i = 0; i < 200'000; ++i) {
    const double x =
        i % 2 == 0 ? random.uniform(-1, 1) : 1 - std::ldexp(random.uniform(), -(i % 50));
    ASSERT_LE(ulps(asin(x), asinl(static_cast<long double>(x))), 3) << x;
    ASSERT_LE(ulps(acos(x), acosl(static_cast<long double>(x))), 3) << x;
  }
  for (const double x : kSpecial) {
    EXPECT_LE(ulps(asin(x), asinl(static_cast<long double>(x))), 3) << x;
    EXPECT_LE(ulps(acos(x), acosl(static_cast<long double>(x))), 3) << x;
  }
}

void expect_pair_accurate(double y, double x) {
  ASSERT_LE(ulps(atan2(y, x), atan2l(y, x)), 2) << y << " " << x;
  ASSERT_LE(ulps(hypot(y, x), hypotl(y, x)), 2) << y << " " << x;
}

TEST(Scalar, Atan2AndHypotAreWithinTwoUlp) {
  for (const double y : kSpecial) {
    for (const double x : kSpecial) expect_pair_accurate(y, x);
  }
  RandomStream random(10, 0, 0, 0);
  for (int i = 0; i < 200'000; ++i) {
    expect_pair_accurate(random.uniform(-3, 3), random.uniform(-3, 3));
    const double size = random.uniform(0.5, 1);
    expect_pair_accurate(std::ldexp(random.uniform(-1, 1), static_cast<int>(random.bits() % 60)),
                         std::ldexp(size, static_cast<int>(random.bits() % 60)));
    expect_pair_accurate(
        std::ldexp(random.uniform(-1, 1), static_cast<int>(random.bits() % 2098) - 1074),
        std::ldexp(random.uniform(-1, 1), static_cast<int>(random.bits() % 2098) - 1074));
  }
}

TEST(Scalar, ExactAngles) {
  EXPECT_EQ(atan2(1, 0), kPi / 2);
  EXPECT_EQ(atan2(1, 1), kPi / 4);
  EXPECT_EQ(atan2(0.0, -1), kPi);
  EXPECT_EQ(atan2(-0.0, -1), -kPi);
  EXPECT_EQ(sincos(0), (SinCos{0, 1}));
  EXPECT_EQ(exp(0), 1);
  EXPECT_EQ(log(1), 0);
  EXPECT_EQ(hypot(3, 4), 5);
  EXPECT_DOUBLE_EQ(deg_to_rad(180), kPi);
  EXPECT_DOUBLE_EQ(rad_to_deg(kPi / 2), 90);
}

TEST(WrapAngle, StaysInItsHalfOpenInterval) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(std::abs(wrap_angle(3 * kPi)), kPi, 1e-15);
  EXPECT_TRUE(std::isnan(wrap_angle(kInf)));
  EXPECT_TRUE(std::isnan(wrap_angle(kNan)));
  for_arguments([](double x) {
    if (!std::isfinite(x)) return;
    const double wrapped = wrap_angle(x);
    ASSERT_GT(wrapped, -kPi) << x;
    ASSERT_LE(wrapped, kPi) << x;
    ASSERT_EQ(wrap_angle(wrapped), wrapped);
    ASSERT_NEAR(sin(wrapped), sin(x), 5e-16) << x;
    ASSERT_NEAR(cos(wrapped), cos(x), 5e-16) << x;
  });
}

// The same constant in every build, compiler and processor: a change here changes every run hash.
TEST(Scalar, GivesTheSameBitsEverywhere) {
  std::uint64_t sum = 0;
  const auto take = [&sum](double value) {
    sum = (sum ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ULL;
    sum ^= sum >> 29U;
  };
  double before = 1;
  for_arguments([&](double x) {
    const SinCos both = sincos(x);
    for (const double value : {both.sin, both.cos, exp(x), log(x), atan2(x, before),
                               hypot(x, before), tan(x), asin(x), acos(x), wrap_angle(x)}) {
      take(value);
    }
    before = x;
  });
  EXPECT_EQ(sum, 8666069495888270629ULL);
}

}  // namespace
}  // namespace rave
