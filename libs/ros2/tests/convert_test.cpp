// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2/convert.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave::ros2 {
namespace {

TEST(Ros2Convert, TimesGoThereAndBack) {
  for (const std::int64_t ns :
       {0LL, 1LL, 1'700'000'000'123'456'789LL, 2'147'483'647'999'999'999LL}) {
    const Time time = time_of(ns);
    EXPECT_LT(time.nanosec, 1'000'000'000U);
    EXPECT_EQ(nanoseconds(time), std::min<std::int64_t>(ns, 2'147'483'647'000'000'000LL)) << ns;
  }
  EXPECT_EQ(nanoseconds(time_of(-5)), 0);
}

TEST(Ros2Convert, HeadingsGoThereAndBack) {
  for (int i = -31; i <= 31; ++i) {
    const double yaw_rad = 0.1 * i;
    const Attitude attitude = attitude_of(quaternion_of(yaw_rad));
    EXPECT_NEAR(attitude.yaw_rad, yaw_rad, 1e-12);
    EXPECT_NEAR(attitude.tilt_rad, 0, 1e-7);
  }
  EXPECT_EQ(attitude_of({0, 0, -1, 0}).yaw_rad, kPi);
}

TEST(Ros2Convert, TiltIsTheAngleFromUpright) {
  // About x by 30 degrees, and then about z by 90: z = q_z * q_x.
  const double x = std::sin(kPi / 12);
  const double w = std::cos(kPi / 12);
  const double h = std::sqrt(0.5);
  const Attitude attitude = attitude_of({h * x, h * x, h * w, h * w});
  EXPECT_NEAR(attitude.yaw_rad, kPi / 2, 1e-12);
  EXPECT_NEAR(attitude.tilt_rad, kPi / 6, 1e-12);
  EXPECT_NEAR(attitude_of({1, 0, 0, 0}).tilt_rad, kPi, 1e-12);
}

TEST(Ros2Convert, PosesAreSeenFromAbove) {
  Pose pose = spatial({1, -2, 0.5}, 0.3);
  EXPECT_EQ(pose.position.z, 0.3);
  const auto seen = planar(pose);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->position(), (Vec2{1, -2}));
  EXPECT_NEAR(seen->yaw, 0.5, 1e-15);
  pose.orientation = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  EXPECT_EQ(planar(pose).error().message,
            "the pose is tilted by 90 degrees; robots in RAVE stay level");
}

}  // namespace
}  // namespace rave::ros2
