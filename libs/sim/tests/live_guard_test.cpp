// SPDX-License-Identifier: Apache-2.0
#include "../src/live_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "live_fixture.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kRadius_m = 0.2;
constexpr double kPeriod_s = 0.02;
constexpr double kFence_m = 2;

std::shared_ptr<const world::Body> disc() {
  world::Body body;
  body.shapes.push_back(world::make_disc({}, kRadius_m, 0, 0.3).value());
  return std::make_shared<const world::Body>(std::move(body));
}

/// A fence that ends at x = 2 m, and nothing else that could stop the robot.
GuardSpec fence_alone() {
  GuardSpec limits;
  limits.fence_W = {{-2, -2}, {kFence_m, -2}, {kFence_m, 2}, {-2, 2}};
  limits.watchdog_s = 1e6;
  limits.world_lost = WorldLostPolicy::kIgnore;
  return limits;
}

/// A cart that drives along x as its guard lets it, and says where it is all the time. Steps of an
/// engine come only when the test calls order().
class LiveGuardTest : public ::testing::Test {
 protected:
  void begin(GuardSpec limits, std::vector<LiveSensor> sensors = {}) {
    guard_.emplace(std::move(limits), LivePose{&queue_, ReadingKind::kPose, {}, from_seconds(0.5)},
                   std::move(sensors), from_seconds(kPeriod_s));
    order_.body = disc();
    order_.radius_m = kRadius_m;
    publish();
  }
  /// A step of the engine in which the program wants the cart to drive.
  void order(double v_mps) {
    order_.demands = {{velocity_command(v_mps, 0), CommandKind::kVelocity, true, clock_.now()}};
    order_.world_time = clock_.now();
    order_.reported = {{x_m_, 0, 0, 0, 0}, {v_mps_, 0, 0}, clock_.now(), true, false};
  }
  void publish() {
    const PoseReading pose{x_m_, 0, 0, 0, 0};
    ASSERT_TRUE(queue_.publish(clock_.now(), &pose, 1));
  }
  /// What the guard lets the cart do now.
  double ask() {
    Command allowed;
    guard_->limit(order_, clock_.now(), {&allowed, 1});
    begun_ |= guard_->take_begun();
    return allowed.value[0];
  }
  /// Time passes; the guard is asked each `asked_s`, the pose source speaks all the time.
  void drive(double duration_s, double asked_s = kPeriod_s, bool speaks = true) {
    const int per_call = static_cast<int>(std::lround(asked_s / kPeriod_s));
    const int count = static_cast<int>(std::lround(duration_s / kPeriod_s));
    for (int i = 0; i < count; ++i) {
      if (i % per_call == 0) v_mps_ = ask();
      x_m_ += v_mps_ * kPeriod_s;
      clock_.advance(kPeriod_s);
      if (speaks) publish();
    }
  }
  [[nodiscard]] bool begun(GuardLimit limit) const {
    return (begun_ >> static_cast<unsigned>(limit) & 1U) != 0;
  }

  HandClock clock_;
  SampleQueue queue_{ReadingKind::kPose, 1, 16, &clock_};
  std::optional<LiveGuard> guard_;
  GuardOrder order_;
  double x_m_ = 0;
  double v_mps_ = 0;
  std::uint32_t begun_ = 0;
};

TEST_F(LiveGuardTest, TheFenceHoldsThoughNoStepEverComes) {
  begin(fence_alone());
  order(1);
  drive(30);
  EXPECT_LE(x_m_, kFence_m - kRadius_m + 1e-3);
  EXPECT_GT(x_m_, kFence_m - kRadius_m - 0.05) << "nothing else has stopped it";
  EXPECT_TRUE(begun(GuardLimit::kFence));
}

TEST_F(LiveGuardTest, TheFenceHoldsWhenTheGuardItselfComesLate) {
  for (const double asked_s : {0.1, 0.2, 0.4}) {
    clock_.set(0);
    queue_.reopen();
    x_m_ = 0;
    v_mps_ = 0;
    begin(fence_alone());
    order(1);
    drive(60, asked_s);
    EXPECT_LE(x_m_, kFence_m - kRadius_m + 1e-3) << asked_s;
    EXPECT_GT(x_m_, 1) << asked_s;
  }
}

TEST_F(LiveGuardTest, ALongGapCountsLessAndLess) {
  begin(fence_alone());
  order(10);
  static_cast<void>(ask());
  constexpr double kGap_s = 0.4;
  clock_.advance(kGap_s);
  for (int call = 0; call < 400; ++call) {
    // It stands, but for a motion so small that only the bits of the pose show it.
    x_m_ = 1e-9 * ((call + 1) % 2);
    publish();
    const double dt_s = std::max(kPeriod_s, kGap_s * std::pow(0.99, call));
    // The way of docs/explanation/guard.md, with the usual reaction of 0.1 s and 0.5 m/s2.
    const double allowed_mps = ask();
    const double way_m = allowed_mps * (dt_s + 0.1) + allowed_mps * allowed_mps / (2 * 0.5);
    EXPECT_NEAR(way_m, kFence_m - kRadius_m, 2e-3) << call;
    clock_.advance(kPeriod_s);
  }
}

TEST_F(LiveGuardTest, TheWatchdogBitesByTheWallUntilTheNextCommand) {
  GuardSpec limits = fence_alone();
  limits.fence_W.clear();
  limits.watchdog_s = 0.4;
  begin(limits);
  order(0.2);
  drive(0.38);
  EXPECT_NEAR(x_m_, 0.2 * 0.38, 1e-9);
  drive(1);
  const double stood_m = x_m_;
  EXPECT_LT(stood_m, 0.2 * 0.44);
  EXPECT_EQ(v_mps_, 0);
  EXPECT_TRUE(begun(GuardLimit::kWatchdog));
  drive(10);
  EXPECT_EQ(x_m_, stood_m);
  order(0.2);
  drive(0.1);
  EXPECT_GT(x_m_, stood_m);
}

TEST_F(LiveGuardTest, BeforeItsProgramHasCommandedItStands) {
  begin(fence_alone());
  order(0.2);
  order_.demands[0].given.reset();
  EXPECT_EQ(ask(), 0) << "whatever its controller makes of it";
  EXPECT_TRUE(begun(GuardLimit::kWatchdog));
  order(0.2);
  EXPECT_EQ(ask(), 0.2);
}

TEST_F(LiveGuardTest, AStepThatDoesNotComeIsAWorldThatIsLost) {
  for (const WorldLostPolicy policy : {WorldLostPolicy::kStop, WorldLostPolicy::kSlow}) {
    GuardSpec limits = fence_alone();
    limits.fence_W.clear();
    limits.world_lost = policy;
    clock_.set(0);
    queue_.reopen();
    begun_ = 0;
    begin(limits);
    order(0.4);
    drive(0.48);
    EXPECT_EQ(v_mps_, 0.4);
    EXPECT_FALSE(begun(GuardLimit::kWorldLost));
    drive(0.1);
    EXPECT_EQ(v_mps_, policy == WorldLostPolicy::kStop ? 0 : limits.slow_speed_mps);
    EXPECT_TRUE(begun(GuardLimit::kWorldLost));
    order(0.4);
    drive(0.1);
    EXPECT_EQ(v_mps_, 0.4);
  }
}

TEST_F(LiveGuardTest, ThePoseIsLostByTheWallThoughTheEngineStillHasOne) {
  GuardSpec limits = fence_alone();
  begin(limits);
  order(0.2);
  drive(0.48, kPeriod_s, false);
  EXPECT_EQ(v_mps_, 0.2);
  order(0.2);
  drive(0.1, kPeriod_s, false);
  EXPECT_EQ(v_mps_, 0);
  EXPECT_TRUE(begun(GuardLimit::kPoseLost));
}

TEST_F(LiveGuardTest, NearTheFenceItStopsInTimeThoughItsPoseFallsSilent) {
  for (const double from_m : {1.0, 1.5, 1.7, 1.77}) {
    clock_.set(0);
    queue_.reopen();
    x_m_ = 0;
    v_mps_ = 0;
    begin(fence_alone());
    order(1);
    while (x_m_ < from_m) drive(kPeriod_s);
    drive(0.48, kPeriod_s, false);
    EXPECT_LE(x_m_, kFence_m - kRadius_m + 1e-3) << from_m;
  }
}

TEST_F(LiveGuardTest, AStampFromFarAheadIsNoPose) {
  begin(fence_alone());
  order(0.2);
  const PoseReading pose{};
  ASSERT_TRUE(queue_.publish(SimTime{from_seconds(100).ns}, &pose, 1));
  EXPECT_EQ(ask(), 0);
  EXPECT_TRUE(begun(GuardLimit::kPoseLost));
}

TEST_F(LiveGuardTest, APoseThatIsNoNumberIsNone) {
  begin(fence_alone());
  order(0.2);
  drive(0.1);
  for (int i = 0; i < 40; ++i) {
    clock_.advance(kPeriod_s);
    const PoseReading pose{std::nan(""), 0, 0, 0, 0};
    ASSERT_TRUE(queue_.publish(clock_.now(), &pose, 1));
  }
  EXPECT_EQ(ask(), 0);
  EXPECT_TRUE(begun(GuardLimit::kPoseLost));
}

TEST_F(LiveGuardTest, WithoutALivePoseSourceTheReportedPoseCounts) {
  guard_.emplace(fence_alone(), LivePose{nullptr, ReadingKind::kPose, {}, from_seconds(0.5)},
                 std::vector<LiveSensor>{}, from_seconds(kPeriod_s));
  order_.body = disc();
  order_.radius_m = kRadius_m;
  order(0.2);
  EXPECT_EQ(ask(), 0.2);
  order_.reported.pose.x_m = 5;
  EXPECT_EQ(ask(), 0) << "it is outside and would go on";
  order(0.2);
  clock_.advance(0.6);
  EXPECT_EQ(ask(), 0) << "its pose is stale";
}

TEST_F(LiveGuardTest, OthersHaveGoneOnSinceTheWorldThatTheyStandIn) {
  GuardSpec limits = fence_alone();
  limits.fence_W.clear();
  limits.separation_m = 0.3;
  limits.world_timeout_s = 10;
  begin(limits);
  order(0.1);
  const auto other = disc();
  order_.bodies = {other};
  order_.neighbours = {{other.get(), {2, 0, 0}, {-0.5, 0, 0}}};
  EXPECT_EQ(ask(), 0.1);
  drive(2.5);
  EXPECT_EQ(v_mps_, 0) << "by now it is where this one would go";
  EXPECT_TRUE(begun(GuardLimit::kSeparation));
  // One that goes away may have stopped right after the world was seen.
  clock_.advance(kPeriod_s);
  publish();
  order(0.1);
  order_.neighbours = {{other.get(), {x_m_ + 0.7, 0, 0}, {5, 0, 0}}};
  clock_.advance(kPeriod_s);
  publish();
  EXPECT_LT(ask(), 0.1);
}

TEST_F(LiveGuardTest, ASensorThatFallsSilentStopsIt) {
  SampleQueue laser(ReadingKind::kValues, 1, 4, &clock_);
  SampleQueue bumper(ReadingKind::kValues, 1, 4, &clock_);
  begin(fence_alone(), {{3, &laser, 1e6, false}, {5, &bumper, 0.2, true}});
  order(0.2);
  EXPECT_EQ(ask(), 0) << "the laser has said nothing yet";
  EXPECT_TRUE(begun(GuardLimit::kSensorLost));
  EXPECT_EQ(guard_->lost_sensor(), 3U);
  const double value = 1;
  ASSERT_TRUE(laser.publish(clock_.now(), &value, 1));
  EXPECT_EQ(ask(), 0.2);
  bumper.fail("cable pulled", 12);
  EXPECT_EQ(ask(), 0);
  EXPECT_EQ(guard_->lost_sensor(), 5U);
  bumper.recover();
  EXPECT_EQ(ask(), 0.2);
}

TEST_F(LiveGuardTest, ASensorWhoseSamplesComeLateStopsIt) {
  SampleQueue laser(ReadingKind::kValues, 1, 4, &clock_);
  // So long that no machine is slow enough to matter.
  begin(fence_alone(), {{3, &laser, 1000, false}});
  clock_.set(5000);
  publish();
  order(0.2);
  const double value = 1;
  for (const double lag_s : {1100.0, 500.0, 900.0, 1003.0}) {
    clock_.advance(1000);
    publish();
    order(0.2);
    ASSERT_TRUE(laser.publish(clock_.now() - from_seconds(lag_s), &value, 1));
    EXPECT_EQ(ask(), lag_s > 1000 ? 0 : 0.2) << lag_s;
  }
  EXPECT_TRUE(begun(GuardLimit::kSensorLost));
}

TEST_F(LiveGuardTest, SamplesThatBeginAnewStopItUntilTheEngineKnows) {
  begin(fence_alone());
  order(0.2);
  EXPECT_EQ(ask(), 0.2);
  queue_.begin_anew("carried away", 12);
  EXPECT_EQ(ask(), 0);
  EXPECT_TRUE(begun(GuardLimit::kUnarmed));
  // The engine has come to it, and somebody has armed the robot again.
  order_.breaks = 1;
  // Where it is now says nothing of its speed.
  clock_.advance(kPeriod_s);
  x_m_ = 1;
  publish();
  EXPECT_EQ(ask(), 0.2);
}

TEST_F(LiveGuardTest, WhoKeepsADistanceStandsWhileNobodyKnowsItsNeighbours) {
  GuardSpec limits = fence_alone();
  limits.separation_m = 0.3;
  begin(limits);
  order(0.2);
  order_.sees_others = false;
  EXPECT_EQ(ask(), 0);
  order_.sees_others = true;
  EXPECT_EQ(ask(), 0.2);
}

TEST_F(LiveGuardTest, WhatHoldsTheRobotComesWithTheOrder) {
  begin(fence_alone());
  order(0.2);
  order_.holds.stopped = true;
  EXPECT_EQ(ask(), 0);
  order_.holds = {.armed = false};
  EXPECT_EQ(ask(), 0);
  order_.holds = {.held = true};
  EXPECT_EQ(ask(), 0);
  order_.holds = {};
  EXPECT_EQ(ask(), 0.2);
}

}  // namespace
}  // namespace rave::sim::testing
