// SPDX-License-Identifier: Apache-2.0
// Sensors that speak all the time, and whose words cannot be believed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../src/live_guard.hpp"
#include "live_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// A cart on x in front of a fence at 2 m, with a laser of 36 rays.
class LiveGuardDoubt : public ::testing::Test {
 protected:
  static constexpr double kPeriod_s = 0.02;
  static constexpr double kRadius_m = 0.2;
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  LiveGuardDoubt() {
    limits_.fence_W = {{-9, -2}, {2, -2}, {2, 2}, {-9, 2}};
    limits_.watchdog_s = 1e6;
    limits_.world_lost = WorldLostPolicy::kIgnore;
  }
  void begin() {
    SensorInfo info;
    info.capacity = 36;
    for (int i = 0; i < 36; ++i) bearings_rad_.push_back(i * kPi / 18 - kPi);
    info.bearings_rad = bearings_rad_.data();
    guard_.emplace(limits_, LivePose{&poses_, ReadingKind::kPose, {}, from_seconds(0.5), 4},
                   std::vector<LiveSensor>{}, from_seconds(kPeriod_s),
                   std::vector<LiveRanges>{{7, &scans_, ray_sectors(info)}});
    world::Body body;
    body.shapes.push_back(world::make_disc({}, kRadius_m, 0, 0.3).value());
    order_.body = std::make_shared<const world::Body>(std::move(body));
    order_.radius_m = kRadius_m;
  }
  /// Time passes, and the cart does what its guard lets it do of a command.
  void drive(double v_mps, double w_radps, double duration_s) {
    for (int i = 0; i < std::lround(duration_s / kPeriod_s); ++i) {
      say();
      order_.demands = {
          {velocity_command(v_mps, w_radps), CommandKind::kVelocity, true, clock_.now()}};
      order_.world_time = clock_.now();
      guard_->limit(order_, clock_.now(), {&allowed_, 1});
      begun_ |= guard_->take_begun();
      x_m_ += allowed_.value[0] * kPeriod_s;
      yaw_rad_ += allowed_.value[1] * kPeriod_s;
      farthest_m_ = std::max(farthest_m_, x_m_);
      clock_.advance(kPeriod_s);
    }
  }
  [[nodiscard]] bool begun(GuardLimit limit) const {
    return (begun_ >> static_cast<unsigned>(limit) & 1U) != 0;
  }

  GuardSpec limits_;
  HandClock clock_;
  SampleQueue poses_{ReadingKind::kPose, 1, 16, &clock_};
  SampleQueue scans_{ReadingKind::kRanges, 36, 16, &clock_};
  std::vector<double> bearings_rad_;
  std::optional<LiveGuard> guard_;
  GuardOrder order_;
  Command allowed_;
  double x_m_ = -8;
  double yaw_rad_ = 0;
  double farthest_m_ = -8;
  bool pose_is_frozen_ = false;
  bool scan_is_frozen_ = false;
  std::vector<float> scan_m_ = std::vector<float>(36, 3.0F);
  std::uint32_t begun_ = 0;

 private:
  void say() {
    if (!pose_is_frozen_) said_ = {x_m_, 0, yaw_rad_, 0, 0};
    ASSERT_TRUE(poses_.publish(clock_.now(), &said_, 1));
    if (!scan_is_frozen_) scan_m_[0] += 1e-3F;
    ASSERT_TRUE(scans_.publish(clock_.now(), scan_m_.data(), 36));
  }
  PoseReading said_;
};

TEST_F(LiveGuardDoubt, ARobotWhosePoseRepeatsItselfStandsAndSaysWhichSensorItIs) {
  begin();
  drive(0.3, 0, 2);
  EXPECT_EQ(begun_, 0U);
  pose_is_frozen_ = true;
  const double from_m = x_m_;
  drive(0.3, 0, 3);
  EXPECT_EQ(allowed_, velocity_command(0, 0));
  EXPECT_LE(x_m_ - from_m, 0.3 * 0.66);
  EXPECT_TRUE(begun(GuardLimit::kFrozen));
  EXPECT_EQ(guard_->frozen_sensor(), 4U);
  // It speaks the truth again.
  pose_is_frozen_ = false;
  drive(0.3, 0, 0.1);
  EXPECT_EQ(allowed_, velocity_command(0.3, 0));
}

TEST_F(LiveGuardDoubt, APoseThatRepeatsItselfDoesNotLeadItOverTheFence) {
  x_m_ = 1.2;
  limits_.frozen_s = 60;  // nothing else stops it
  begin();
  drive(0.3, 0, 0.5);
  pose_is_frozen_ = true;
  drive(0.3, 0, 5);
  EXPECT_LE(farthest_m_, 2 - kRadius_m + 1e-3);
  EXPECT_GT(farthest_m_, 1.4);
  EXPECT_FALSE(begun(GuardLimit::kFrozen));
}

TEST_F(LiveGuardDoubt, ARobotWhoseScanRepeatsItselfStandsWhetherItTurnsOrDrives) {
  for (const double turn_radps : {0.0, 0.5}) {
    begun_ = 0;
    begin();
    scan_is_frozen_ = false;
    drive(0.3 - 0.6 * turn_radps, turn_radps, 1);
    EXPECT_EQ(begun_, 0U);
    scan_is_frozen_ = true;
    drive(0.3 - 0.6 * turn_radps, turn_radps, 1);
    EXPECT_EQ(allowed_, velocity_command(0, 0));
    EXPECT_TRUE(begun(GuardLimit::kFrozen));
    EXPECT_EQ(guard_->frozen_sensor(), 7U);
  }
}

TEST_F(LiveGuardDoubt, WhoStandsMaySayTheSameForEver) {
  begin();
  pose_is_frozen_ = scan_is_frozen_ = true;
  drive(0, 0, 60);
  EXPECT_EQ(begun_, 0U);
  pose_is_frozen_ = scan_is_frozen_ = false;
  drive(0.3, 0, 1);
  EXPECT_EQ(begun_, 0U);
}

TEST_F(LiveGuardDoubt, TheFileSwitchesItOff) {
  limits_.frozen_s = 0;
  limits_.fence_W.clear();
  begin();
  pose_is_frozen_ = scan_is_frozen_ = true;
  drive(0.3, 0.1, 20);
  EXPECT_EQ(begun_, 0U);
  EXPECT_EQ(allowed_, velocity_command(0.3, 0.1));
}

TEST_F(LiveGuardDoubt, WhoeverReleasesItTriesAgain) {
  begin();
  pose_is_frozen_ = true;  // it leans against a wall
  drive(0.3, 0, 2);
  EXPECT_EQ(allowed_, velocity_command(0, 0));
  order_.holds.stopped = true;
  drive(0.3, 0, 0.1);
  order_.holds.stopped = false;
  drive(-0.3, 0, 0.1);
  EXPECT_EQ(allowed_, velocity_command(-0.3, 0));
}

TEST_F(LiveGuardDoubt, ABlindRobotTurnsButDoesNotDriveThere) {
  begin();
  drive(0.3, 0, 0.5);
  EXPECT_EQ(begun_, 0U);
  scan_m_[18] = kUnknown;  // ahead
  drive(0.3, 0.2, 0.1);
  EXPECT_EQ(allowed_, velocity_command(0, 0.2));
  EXPECT_TRUE(begun(GuardLimit::kBlind));
  drive(-0.3, 0.2, 0.1);
  EXPECT_EQ(allowed_, velocity_command(-0.3, 0.2));
  scan_m_[18] = 3;
  scan_m_[35] = kUnknown;  // behind
  drive(-0.3, 0.2, 0.1);
  EXPECT_EQ(allowed_, velocity_command(0, 0.2));
  drive(0.3, 0.2, 0.1);
  EXPECT_EQ(allowed_, velocity_command(0.3, 0.2));
  scan_m_[9] = kUnknown;  // beside
  drive(0.3, 0.2, 0.1);
  EXPECT_EQ(allowed_, velocity_command(0.3, 0.2));
}

TEST_F(LiveGuardDoubt, TheFileSaysHowFarItMustSeeToTheSide) {
  limits_.must_see_rad = 0.1;
  begin();
  scan_m_[20] = kUnknown;  // 20 degrees to the left
  drive(0.3, 0, 0.1);
  EXPECT_EQ(allowed_, velocity_command(0.3, 0));
  limits_.must_see_rad = 0;
  begin();
  scan_m_[18] = kUnknown;
  drive(0.3, 0, 0.1);
  EXPECT_EQ(allowed_, velocity_command(0.3, 0));
}

}  // namespace
}  // namespace rave::sim::testing
