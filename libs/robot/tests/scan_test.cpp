// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/scan.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "rave/math/scalar.hpp"

namespace rave {
namespace {

/// A robot with one range sensor of two beams, 0.1 m ahead of its origin and turned to the left.
class ScanTest : public ::testing::Test {
 protected:
  Scan scan_of(double cone_rad, const std::vector<float>& ranges_m) {
    info_.name = "sonars";
    info_.kind = ReadingKind::kRanges;
    info_.capacity = 2;
    info_.X_RS = {0.1, 0, 0.5 * kPi};
    info_.range_max_m = 4;
    info_.bearings_rad = bearings_rad_;
    info_.cone_rad = cone_rad;
    raw_.sensors = &info_;
    raw_.sensor_count = 1;
    header_.count = static_cast<std::uint32_t>(ranges_m.size());
    view_ = {&header_, ranges_m.data()};
    DecideItem item;
    item.sensors = &view_;
    Scan scan{rave::Setup(raw_)};
    scan.update(Percepts(item));
    return scan;
  }

  static constexpr double bearings_rad_[2] = {0.0, -0.5 * kPi};
  SensorInfo info_;
  ProgramSetup raw_;
  SampleHeader header_;
  SensorView view_;
};

TEST_F(ScanTest, PutsRaysIntoTheRobotsFrame) {
  const Scan scan = scan_of(0, {2.0F, 3.0F});
  ASSERT_EQ(scan.hits().size(), 2U);
  EXPECT_NEAR(scan.hits()[0].p_R.x, 0.1, 1e-12);
  EXPECT_NEAR(scan.hits()[0].p_R.y, 2.0, 1e-12);
  EXPECT_NEAR(scan.hits()[1].distance_m, 3.1, 1e-12);
  EXPECT_NEAR(scan.hits()[1].bearing_rad, 0, 1e-12);
  EXPECT_NEAR(scan.nearest_m(-0.1, 0.1), 3.1, 1e-12);
  EXPECT_EQ(scan.nearest_m(-2, -1), std::numeric_limits<double>::infinity());
}

TEST_F(ScanTest, AConeStandsForItsWholeArc) {
  const Scan scan = scan_of(0.4, {2.0F, 3.0F});
  ASSERT_EQ(scan.hits().size(), 6U);
  EXPECT_NEAR(scan.hits()[4].p_R.x, 0.1 + 3.0 * cos(0.2), 1e-12);
  EXPECT_NEAR(scan.hits()[4].p_R.y, 3.0 * sin(0.2), 1e-12);
  EXPECT_NEAR(scan.hits()[5].p_R.y, -3.0 * sin(0.2), 1e-12);
}

TEST_F(ScanTest, IsOldWhenASensorHasNotSpokenForLongerThanItMay) {
  header_.sequence = 1;
  EXPECT_FALSE(scan_of(0, {2.0F, 3.0F}).is_old()) << "it has no largest age";
  info_.max_age_s = 0.3;
  EXPECT_FALSE(scan_of(0, {2.0F, 3.0F}).is_old());
  header_.stamp_ns = -299'999'999;
  EXPECT_FALSE(scan_of(0, {2.0F, 3.0F}).is_old());
  header_.stamp_ns = -300'000'001;
  EXPECT_TRUE(scan_of(0, {2.0F, 3.0F}).is_old());
  header_ = {};
  EXPECT_TRUE(scan_of(0, {}).is_old()) << "nothing has come yet";
}

TEST_F(ScanTest, NoReturnIsFreeAndNotANumberIsNothing) {
  const Scan scan =
      scan_of(0, {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()});
  EXPECT_TRUE(scan.hits().empty());
  ASSERT_EQ(scan.beams().size(), 1U);
  EXPECT_EQ(scan.beams()[0].free_m, 4.0);
}

TEST_F(ScanTest, WhatItCannotSeeAheadTouchesItsBody) {
  raw_.robot.radius_m = 0.2;
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  const Scan scan = scan_of(0, {2.0F, unknown});  // the second one looks ahead
  ASSERT_EQ(scan.hits().size(), 2U);
  EXPECT_FALSE(scan.hits()[0].blind);
  EXPECT_TRUE(scan.hits()[1].blind);
  EXPECT_NEAR(scan.hits()[1].distance_m, 0.2, 1e-12);
  EXPECT_NEAR(std::sqrt(squared_norm(scan.hits()[1].p_R)), 0.2, 1e-12);
  EXPECT_NEAR(scan.nearest_m(-0.1, 0.1), 0.2, 1e-12);
  EXPECT_TRUE((scan.blind() & Sectors::ahead(0.1)).any());
  // A cone is blind in all its width, unless another one sees there.
  const Scan cones = scan_of(0.6, {2.0F, unknown});
  EXPECT_TRUE((cones.blind() & Sectors::between(0.25, 0.25)).any());
  EXPECT_FALSE((scan_of(3.2, {2.0F, unknown}).blind() & Sectors::between(0.2, 0.2)).any());
}

TEST_F(ScanTest, WhatItCannotSeeBesideOrBehindIsNoHit) {
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  const Scan scan = scan_of(0, {unknown, 3.0F});
  EXPECT_EQ(scan.hits().size(), 1U);
  EXPECT_TRUE((scan.blind() & Sectors::between(0.5 * kPi, 0.5 * kPi)).any());
}

TEST_F(ScanTest, TooNearToMeasureIsAHitAtTheSensor) {
  const Scan scan = scan_of(0, {-std::numeric_limits<float>::infinity(), 3.0F});
  ASSERT_EQ(scan.hits().size(), 2U);
  EXPECT_NEAR(scan.hits()[0].distance_m, 0.1, 1e-12);
}

TEST_F(ScanTest, IsEmptyBeforeTheFirstSample) { EXPECT_TRUE(scan_of(0, {}).beams().empty()); }

}  // namespace
}  // namespace rave
