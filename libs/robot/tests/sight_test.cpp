// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/sight.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rave {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kFree = std::numeric_limits<float>::infinity();

int count(Sectors sectors) {
  int count = 0;
  for (int i = 0; i < Sectors::kCount; ++i) count += sectors.has(i) ? 1 : 0;
  return count;
}

TEST(Sectors, CoverAnInterval) {
  EXPECT_EQ(count(Sectors::between(0, 0)), 1);
  EXPECT_TRUE(Sectors::between(0, 0).has(0));
  EXPECT_TRUE(Sectors::between(-1e-9, -1e-9).has(63));
  EXPECT_EQ(count(Sectors::ahead(Sectors::kWidth_rad)), 2);
  EXPECT_EQ(count(Sectors::ahead(kMustSee_rad)), 16);
  EXPECT_EQ(count(Sectors::behind(kMustSee_rad)), 16);
  EXPECT_FALSE((Sectors::ahead(kMustSee_rad) & Sectors::behind(kMustSee_rad)).any());
  EXPECT_EQ(count(Sectors::between(-kPi, kPi)), 64);
  EXPECT_EQ(count(Sectors::between(-100, 100)), 64);
  // A direction is the same whichever way round it is counted.
  for (double rad = -3; rad < 3; rad += 0.1) {
    EXPECT_EQ(Sectors::between(rad, rad), Sectors::between(rad + 2 * kPi, rad + 2 * kPi)) << rad;
    EXPECT_EQ(Sectors::between(rad, rad), Sectors::between(rad - 2 * kPi, rad - 2 * kPi)) << rad;
  }
}

TEST(Sectors, HaveTheirMiddle) {
  for (int i = 0; i < Sectors::kCount; ++i) {
    const double middle_rad = Sectors::middle_rad(i);
    EXPECT_TRUE(Sectors::between(middle_rad, middle_rad).has(i)) << i;
    EXPECT_LE(std::abs(middle_rad), kPi);
  }
}

TEST(Sight, IsBlindWhereEveryRayIsUnknown) {
  Sight sight;
  const Sectors ahead = Sectors::between(0, 0);
  const Sectors left = Sectors::between(1, 1);
  EXPECT_FALSE(sight.blind().any()) << "where no ray is, nothing is expected";
  sight.add(ahead, kUnknown);
  sight.add(left, kFree);
  EXPECT_EQ(sight.blind(), ahead);
  sight.add(ahead, kUnknown);
  EXPECT_EQ(sight.blind(), ahead);
  sight.add(ahead, -kFree);  // too near to measure: seen
  EXPECT_FALSE(sight.blind().any());
  sight.clear();
  sight.add(left, kUnknown);
  EXPECT_EQ(sight.blind(), left);
}

TEST(Sight, AGapOfTwoSectorsIsFoundWhereverItLies) {
  constexpr double kRay_rad = 0.25 * kPi / 180;
  for (double at_rad = -1; at_rad < 1; at_rad += 0.013) {
    Sight sight;
    for (double rad = -2; rad < 2; rad += kRay_rad) {
      const bool gap = std::abs(rad - at_rad) <= Sectors::kWidth_rad;
      sight.add(Sectors::between(rad, rad), gap ? kUnknown : 2.0F);
    }
    EXPECT_TRUE(sight.blind().any()) << at_rad;
  }
}

}  // namespace
}  // namespace rave
