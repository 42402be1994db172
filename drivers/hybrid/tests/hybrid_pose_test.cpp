// SPDX-License-Identifier: Apache-2.0
#include "hybrid_pose.hpp"

#include <cmath>
#include <stdexcept>

#include "fusing.hpp"
#include "rave/base/random.hpp"
#include "rave/math/gaussian.hpp"
#include "rave/math/scalar.hpp"

namespace rave {
namespace {

using Pose = testing::Fusing<HybridPose>;
using Readings = std::vector<PoseReading>;

TEST(HybridPose, WeighsByInverseVariance) {
  Pose fusing;
  ASSERT_TRUE(fusing.start());
  const auto fused = fusing.fuse(Readings{{0, 10, 0.2, 1, 4}}, Readings{{3, 40, 0.7, 2, 1}});
  ASSERT_EQ(fused.size(), 1U);
  EXPECT_DOUBLE_EQ(fused[0].x_m, 1);
  EXPECT_DOUBLE_EQ(fused[0].y_m, 20);
  EXPECT_DOUBLE_EQ(fused[0].yaw_rad, 0.6);
  EXPECT_DOUBLE_EQ(fused[0].variance_xy_m2, 2.0 / 3);
  EXPECT_DOUBLE_EQ(fused[0].variance_yaw_rad2, 0.8);
}

TEST(HybridPose, YawTakesTheShortWay) {
  Pose fusing;
  ASSERT_TRUE(fusing.start());
  const auto across =
      fusing.fuse(Readings{{0, 0, kPi - 0.1, 1, 1}}, Readings{{0, 0, 0.3 - kPi, 1, 1}});
  EXPECT_NEAR(across[0].yaw_rad, 0.1 - kPi, 1e-12);
  const auto near =
      fusing.fuse(Readings{{0, 0, 0.1 - kPi, 1, 3}}, Readings{{0, 0, kPi - 0.1, 1, 1}});
  EXPECT_NEAR(near[0].yaw_rad, kPi - 0.05, 1e-12);
}

TEST(HybridPose, ParametersStandForWhatReadingsState) {
  Pose fusing;
  fusing.set("real_sigma_xy_m", 1.0);
  fusing.set("virtual_sigma_xy_m", 2.0);
  fusing.set("real_sigma_yaw_deg", 3.0);
  fusing.set("virtual_sigma_yaw_deg", 3.0);
  ASSERT_TRUE(fusing.start());
  const auto fused = fusing.fuse(Readings{{0, 0, 0, 0, 0}}, Readings{{5, 0, 0.2, 99, 99}});
  EXPECT_NEAR(fused[0].x_m, 1, 1e-12);
  EXPECT_NEAR(fused[0].yaw_rad, 0.1, 1e-12);
}

TEST(HybridPose, AHalfWithoutAReadingLeavesTheOther) {
  Pose fusing;
  ASSERT_TRUE(fusing.start());
  EXPECT_EQ(fusing.fuse(Readings{{1, 2, 3, 4, 5}}, Readings{})[0].x_m, 1);
  EXPECT_EQ(fusing.fuse(Readings{}, Readings{{6, 2, 3, 4, 5}})[0].x_m, 6);
  EXPECT_TRUE(fusing.fuse(Readings{}, Readings{}).empty());
}

TEST(HybridPose, ThrowsRatherThanGuessAVariance) {
  Pose fusing;
  ASSERT_TRUE(fusing.start());
  const PoseReading good{0, 0, 0, 1, 1};
  for (const double bad : {0.0, -1.0, double{NAN}, double{INFINITY}}) {
    EXPECT_THROW(fusing.fuse(Readings{{0, 0, 0, bad, 1}}, Readings{good}), std::runtime_error);
    EXPECT_THROW(fusing.fuse(Readings{good}, Readings{{0, 0, 0, 1, bad}}), std::runtime_error);
  }
}

TEST(HybridPose, TheErrorOfTheMeanIsWhatItStates) {
  Pose fusing;
  ASSERT_TRUE(fusing.start());
  RandomStream random(5, 0, 0, 0);
  constexpr int kSamples = 20000;
  constexpr double kReal = 0.3;
  constexpr double kVirtual = 0.5;
  double squares = 0;
  double stated = 0;
  for (int i = 0; i < kSamples; ++i) {
    const auto fused =
        fusing.fuse(Readings{{kReal * gaussian(random), 0, 0, kReal * kReal, 1}},
                    Readings{{kVirtual * gaussian(random), 0, 0, kVirtual * kVirtual, 1}});
    squares += fused[0].x_m * fused[0].x_m;
    stated = fused[0].variance_xy_m2;
  }
  // Five standard errors of a variance.
  EXPECT_NEAR(squares / kSamples, stated, 5 * stated * std::sqrt(2.0 / kSamples));
}

}  // namespace
}  // namespace rave
