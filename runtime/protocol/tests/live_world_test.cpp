// SPDX-License-Identifier: Apache-2.0
// The world of a host that hears of the robots of others now and then.
#include "rave/protocol/live_world.hpp"

#include <gtest/gtest.h>

#include "rave/math/transform.hpp"
#include "rave/sim_testing/engine_fixture.hpp"
#include "rave/sim_testing/radio_fixture.hpp"

namespace rave::real_time {
namespace {

using namespace sim::testing;
using sim::EventKind;
using sim::WorldStep;

constexpr RobotId kOwn{0};
constexpr RobotId kSimulated{1};  // of another host
constexpr RobotId kReal{2};       // of another host, too
constexpr std::int64_t kStep_ns = 10'000'000;

SimTime at(std::uint64_t step) { return {static_cast<std::int64_t>(step) * kStep_ns}; }

/// Three robots, of which the first runs here, at 0, 5 and 10 m.
sim::EngineSpec three_robots() {
  sim::EngineSpec spec;
  spec.seed = 7;
  sim::RobotType own = simulated_type();
  sim::RobotType other = simulated_type();
  sim::RobotType real = real_type({{"dt", 0.1}});
  for (sim::RobotType* const type : {&own, &other, &real}) {
    type->staleness = from_seconds(0.5);
    type->communicators.resize(2);
  }
  add_robot(spec, std::move(own));
  add_robot(spec, std::move(other), {5, 0, 0});
  add_robot(spec, std::move(real), {10, 0, 0});
  spec.local = {kOwn};
  spec.own_authority = true;
  return spec;
}

class LiveWorlds : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = LiveWorld::create(three_robots());
    ASSERT_TRUE(made) << made.error().text();
    live_ = *std::move(made);
  }
  /// The world of a step in which the own robot wants to go so.
  const WorldStep& step(std::uint64_t number, double v_mps = 0) {
    own_.begin(number);
    if (number > 0) own_.proposals = {{0}, {v_mps}, {0}, {0}};
    const Status status = live_->step(own_, world_);
    EXPECT_TRUE(status) << status.error().text();
    return world_;
  }
  const WorldStep& steps(std::uint64_t first, std::uint64_t last, double v_mps = 0) {
    for (std::uint64_t number = first; number < last; ++number) step(number, v_mps);
    return step(last, v_mps);
  }
  [[nodiscard]] const sim::ReportedPose& reported(RobotId robot) const {
    for (const sim::PoseReport& pose : world_.poses) {
      if (pose.robot == robot) return pose.reported;
    }
    ADD_FAILURE() << "no report of robot " << robot.value();
    static const sim::ReportedPose kNobody;
    return kNobody;
  }
  [[nodiscard]] std::size_t count(EventKind kind, RobotId robot) const {
    return static_cast<std::size_t>(std::count_if(
        live_->events().begin(), live_->events().end(),
        [&](const auto& event) { return event.kind == kind && event.robot == robot; }));
  }
  bool hear(std::uint32_t sequence, std::uint64_t writer = 1, RobotId robot = kSimulated,
            std::uint32_t communicator = 0) {
    sim::SentPacket packet;
    packet.robot = robot;
    packet.communicator = communicator;
    packet.sequence = sequence;
    packet.stamp_ns = 123;
    const std::vector<std::byte> bytes(sequence, std::byte{0x11});
    return live_->hear(writer, packet, bytes);
  }

  std::unique_ptr<LiveWorld> live_;
  sim::HostReport own_;
  WorldStep world_;
};

TEST_F(LiveWorlds, WhoHasNotBeenHeardOfIsNotThere) {
  step(0);
  EXPECT_EQ(world_.flags[0], WorldStep::kPresent);
  EXPECT_EQ(world_.flags[1], 0);
  EXPECT_EQ(world_.flags[2], 0);
  EXPECT_FALSE(reported(kSimulated).known);
  ASSERT_TRUE(live_->see({kSimulated, at(0), {1, 2, 0.5}, {}}));
  step(1);
  EXPECT_EQ(world_.flags[1], WorldStep::kPresent);
  EXPECT_EQ(world_.x_m[1], 1);
  EXPECT_EQ(world_.y_m[1], 2);
  EXPECT_TRUE(live_->events().empty());
}

TEST_F(LiveWorlds, ItsVelocityCarriesItOnForAsLongAsItsStaleness) {
  const Pose2 X_WR{3, 0, 0.4};
  const Twist2 velocity{1, 0, 0.8};
  ASSERT_TRUE(live_->see({kSimulated, at(0), X_WR, velocity}));
  steps(0, 20);
  const Pose2 after = integrate(X_WR, velocity, 0.2);
  EXPECT_NEAR(world_.x_m[1], after.x, 1e-12);
  EXPECT_NEAR(world_.y_m[1], after.y, 1e-12);
  EXPECT_NEAR(world_.yaw_rad[1], after.yaw, 1e-12);
  EXPECT_EQ(world_.vx_mps[1], 1);
  EXPECT_FALSE(reported(kSimulated).stale);

  steps(21, 50);
  EXPECT_FALSE(reported(kSimulated).stale);
  step(51);
  EXPECT_TRUE(reported(kSimulated).stale);
  EXPECT_EQ(count(EventKind::kPoseStale, kSimulated), 1U);
  steps(52, 90);
  const Pose2 last = integrate(X_WR, velocity, 0.5);
  EXPECT_NEAR(world_.x_m[1], last.x, 1e-12);
  EXPECT_NEAR(world_.y_m[1], last.y, 1e-12);
  EXPECT_EQ(world_.vx_mps[1], 0);
  EXPECT_EQ(world_.flags[1], WorldStep::kPresent) << "it stays there";
  EXPECT_TRUE(live_->events().empty()) << "it is told once";

  ASSERT_TRUE(live_->see({kSimulated, at(90), {7, 0, 0}, {}}));
  step(91);
  EXPECT_EQ(count(EventKind::kPoseBack, kSimulated), 1U);
  EXPECT_FALSE(reported(kSimulated).stale);
  EXPECT_EQ(world_.x_m[1], 7);
}

TEST_F(LiveWorlds, NewerSightsCountWhateverTheirOrder) {
  EXPECT_TRUE(live_->see({kSimulated, at(4), {4, 0, 0}, {}}));
  EXPECT_FALSE(live_->see({kSimulated, at(3), {3, 0, 0}, {}}));
  EXPECT_FALSE(live_->see({kSimulated, at(4), {5, 0, 0}, {}}));
  EXPECT_FALSE(live_->see({kOwn, at(9), {5, 0, 0}, {}})) << "it is known best here";
  EXPECT_FALSE(live_->see({RobotId(3), at(9), {5, 0, 0}, {}}));
  steps(0, 4);
  EXPECT_EQ(world_.x_m[1], 4);
  // A manager with another clock took over.
  live_->clock_changed();
  EXPECT_TRUE(live_->see({kSimulated, at(3), {3, 0, 0}, {}}));
  EXPECT_FALSE(live_->see({kSimulated, at(2), {2, 0, 0}, {}}));
}

TEST_F(LiveWorlds, MeasuresHowOldAPoseIsInTheFirstStepThatShowsIt) {
  ASSERT_TRUE(live_->see({kSimulated, at(0), {0, 0, 0}, {}}));
  steps(0, 8);
  EXPECT_EQ(live_->pose_delays().count, 0U) << "by this one it became known";
  ASSERT_TRUE(live_->see({kSimulated, at(6), {6, 0, 0}, {}}));
  steps(9, 12);
  ASSERT_TRUE(live_->see({kSimulated, at(12), {12, 0, 0}, {}}));
  step(13);
  // From a clock that is ahead.
  ASSERT_TRUE(live_->see({kSimulated, at(20), {20, 0, 0}, {}}));
  step(14);
  EXPECT_EQ(live_->pose_delays().count, 3U);
  EXPECT_EQ(live_->pose_delays().slowest, at(9) - at(6));
  EXPECT_EQ(live_->pose_delays().sum, at(10) - at(6));
  live_->clock_changed();
  ASSERT_TRUE(live_->see({kSimulated, at(2), {2, 0, 0}, {}}));
  step(15);
  EXPECT_EQ(live_->pose_delays().count, 3U) << "its stamp is by the clock of another manager";
}

TEST_F(LiveWorlds, ASightFromAClockThatIsAheadIsNotCarriedBack) {
  ASSERT_TRUE(live_->see({kSimulated, at(30), {4, 0, 0}, {1, 0, 0}}));
  steps(0, 3);
  EXPECT_EQ(world_.x_m[1], 4);
  EXPECT_EQ(reported(kSimulated).stamp, at(3));
}

TEST_F(LiveWorlds, OwnRobotsMakeWayAndOthersAreNeverMoved) {
  step(0);
  ASSERT_TRUE(live_->see({kSimulated, at(0), {0.2, 0, 0}, {}}));
  step(1);
  EXPECT_EQ(world_.x_m[1], 0.2);
  ASSERT_EQ(world_.pushed.size(), 1U);
  EXPECT_EQ(world_.pushed[0].robot, kOwn);
  EXPECT_LE(world_.pushed[0].X_WR.x, -0.1 + 1e-6);
  step(2);
  EXPECT_EQ(count(EventKind::kContact, kOwn), 1U);
  EXPECT_EQ(count(EventKind::kContact, kSimulated), 0U) << "that is for its own host to say";
}

TEST_F(LiveWorlds, OwnRobotsDoNotGoThroughOthers) {
  ASSERT_TRUE(live_->see({kSimulated, at(0), {1, 0, 0}, {}}));
  for (std::uint64_t number = 0; number < 100; ++number) {
    step(number, 1);
    live_->see({kSimulated, at(number), {1, 0, 0}, {}});
  }
  EXPECT_NEAR(world_.x_m[0], 0.7, 1e-3);
  EXPECT_NE(world_.flags[0] & WorldStep::kLimited, 0);
  EXPECT_EQ(world_.x_m[1], 1);
}

TEST_F(LiveWorlds, OnlyRealRobotsHaveAPast) {
  ASSERT_TRUE(live_->see({kSimulated, at(0), {1, 0, 0}, {}}));
  ASSERT_TRUE(live_->see({kReal, at(1), {11, 0, 0}, {}}));
  ASSERT_TRUE(live_->see({kReal, at(3), {13, 0, 0}, {}}));
  EXPECT_TRUE(step(0).samples.empty()) << "nothing of what is to come";
  ASSERT_EQ(steps(1, 2).samples.size(), 0U);
  ASSERT_EQ(step(3).samples.size(), 1U);
  EXPECT_EQ(world_.samples[0].robot, kReal);
  EXPECT_EQ(world_.samples[0].stamp, at(3));
  EXPECT_EQ(world_.samples[0].X_WR.x, 13);
}

TEST_F(LiveWorlds, MessagesAreOfTheStepInWhichTheyAreHeard) {
  steps(0, 4);
  EXPECT_TRUE(hear(2));
  EXPECT_TRUE(hear(5, 9, kReal, 1));
  EXPECT_TRUE(hear(1, 9, kReal, 0));
  EXPECT_FALSE(hear(2)) << "it came twice";
  EXPECT_FALSE(hear(1)) << "it was overtaken";
  EXPECT_TRUE(hear(1, 2)) << "another process counts anew";
  EXPECT_TRUE(hear(2, 2)) << "the number was used in this step, by the process before";
  EXPECT_FALSE(hear(1, 1, kOwn));
  EXPECT_FALSE(hear(1, 1, RobotId(9)));
  EXPECT_FALSE(hear(1, 1, kSimulated, 2)) << "it has no such communicator";
  step(5);
  std::vector<std::string> sent;
  for (const sim::SentPacket& packet : world_.sent.packets) {
    sent.push_back(fmt::format("{} {} {} {}", packet.robot.value(), packet.communicator,
                               packet.sequence, world_.sent.bytes_of(packet).size()));
    EXPECT_EQ(packet.complete_ns, at(4).ns);
    EXPECT_EQ(packet.stamp_ns, 123);
  }
  EXPECT_EQ(sent, (std::vector<std::string>{"1 0 1 1", "1 0 2 2", "2 0 1 1", "2 1 5 5"}));
  EXPECT_TRUE(step(6).sent.packets.empty());
}

TEST_F(LiveWorlds, WhatIsHeardBeforeTheFirstStepIsKept) {
  EXPECT_TRUE(hear(1));
  EXPECT_TRUE(step(0).sent.packets.empty());
  EXPECT_EQ(step(1).sent.packets.size(), 1U);
}

TEST_F(LiveWorlds, WhoFloodsIsNamedAndTakesNothingFromTheOthers) {
  const auto say = [this](RobotId robot, std::uint32_t sequence, std::size_t size) {
    sim::SentPacket packet;
    packet.robot = robot;
    packet.sequence = sequence;
    const std::vector<std::byte> bytes(size);
    return live_->hear(robot.value(), packet, bytes);
  };
  std::uint32_t number = 0;
  std::uint64_t dropped = 0;
  for (std::uint64_t now = 0; now < 3; ++now) {
    for (std::uint32_t i = 0; i < LiveWorld::kMostPackets; ++i) say(kSimulated, ++number, 4);
    EXPECT_TRUE(say(kReal, static_cast<std::uint32_t>(now) + 1, 60'000));
    if (now == 0) step(0);
    const std::uint32_t most = TalkLimit::kOnReception * (now == 0 ? TalkLimit::kMessagesAtOnce
                                                                   : TalkLimit::kMessagesPerStep);
    EXPECT_EQ(step(now + 1).sent.packets.size(), most + 1);
    dropped += LiveWorld::kMostPackets - most;
    EXPECT_EQ(world_.sent.packets.back().robot, kReal);
  }
  EXPECT_EQ(live_->dropped_packets(), dropped);
  EXPECT_EQ(live_->take_flooders(), (std::vector<RobotId>{kSimulated}));
  EXPECT_TRUE(live_->take_flooders().empty());
  // Long messages count by their bytes.
  for (std::uint32_t i = 0; i < 8; ++i) say(kReal, 10 + i, 60'000);
  EXPECT_EQ(step(4).sent.packets.size(), 7U);
  EXPECT_EQ(live_->take_flooders(), (std::vector<RobotId>{kReal}));
}

TEST_F(LiveWorlds, AHostThatComesLateBeginsWhereTheWorldShowsIt) {
  own_.begin(0);
  const RobotSight before{kOwn, at(340), {-2, 1, 0.3}, {}};
  ASSERT_TRUE(live_->see({kSimulated, at(350), {4, 0, 0}, {}}));
  const Status begun = live_->begin_at(352, std::span(&before, 1), own_);
  ASSERT_TRUE(begun) << begun.error().text();
  EXPECT_EQ(own_.step, 352U);
  ASSERT_TRUE(live_->step(own_, world_));
  EXPECT_EQ(world_.step, 352U);
  EXPECT_EQ(world_.x_m[0], -2);
  EXPECT_EQ(world_.y_m[0], 1);
  EXPECT_EQ(world_.x_m[1], 4);
  steps(353, 362, 1);
  EXPECT_NEAR(world_.x_m[0], -2 + 0.1 * std::cos(0.3), 1e-6);
}

TEST(LiveWorldSchedule, AHostThatComesLateMakesTheChangesOfBefore) {
  sim::EngineSpec spec = three_robots();
  const sim::ParameterChange larger{sim::ParameterChange::Part::kBody, 0, "scale", 1.2};
  spec.changes.push_back({5, kOwn, {larger}});
  auto live = LiveWorld::create(spec);
  ASSERT_TRUE(live) << live.error().text();
  sim::HostReport own;
  own.begin(0);
  ASSERT_TRUE((*live)->begin_at(352, {}, own));
  WorldStep world;
  ASSERT_TRUE((*live)->step(own, world));
  ASSERT_EQ(world.resized.size(), 1U);
  EXPECT_EQ(world.resized[0].robot, kOwn);
  EXPECT_EQ(world.resized[0].scale, 1.2);
}

TEST(LiveEngine, SensesOthersInTheirLayerAndMarksThemStale) {
  sim::EngineSpec spec;
  sim::RobotType looks = simulated_type();
  looks.sensors.push_back(laser());
  looks.sensors[0].layers = static_cast<LayerMask>(Layer::kSimulatedRobots);
  add_robot(spec, std::move(looks));
  add_robot(spec, simulated_type(), {2, 0, 0});
  spec.local = {kOwn};
  spec.own_authority = true;
  auto live = LiveWorld::create(spec);
  ASSERT_TRUE(live) << live.error().text();
  auto engine = make_engine(std::move(spec));
  ASSERT_NE(engine, nullptr);
  sim::HostReport own;
  WorldStep world;
  const auto advance = [&] {
    ASSERT_TRUE((*live)->step(own, world));
    ASSERT_TRUE(engine->apply(world));
    ASSERT_TRUE(engine->propose(own));
  };
  ASSERT_TRUE(engine->propose(own));
  advance();
  EXPECT_GT(range(*engine, kOwn, 0), 3) << "nobody has been heard of";
  ASSERT_TRUE((*live)->see({kSimulated, at(1), {2, 0, 0}, {-1, 0, 0}}));
  for (int i = 0; i < 11; ++i) advance();
  EXPECT_NEAR(range(*engine, kOwn, 0), 1.85 - 0.1, 1e-3);
  EXPECT_FALSE(engine->reported(kSimulated).stale);
  for (int i = 0; i < 60; ++i) advance();
  EXPECT_NEAR(range(*engine, kOwn, 0), 1.85 - 0.5, 1e-3);
  EXPECT_TRUE(engine->reported(kSimulated).stale);
}

/// One of two hosts, each of which runs one robot that talks.
struct TalkingHost {
  explicit TalkingHost(std::uint32_t robot) {
    sim::EngineSpec spec;
    add_robot(spec, talking_type());
    add_robot(spec, talking_type(), {1, 0, 0});
    spec.local = {RobotId(robot)};
    spec.own_authority = true;
    live = LiveWorld::create(spec).value();
    engine = make_engine(std::move(spec));
    EXPECT_TRUE(engine->propose(own));
  }
  void advance() {
    EXPECT_TRUE(live->step(own, world));
    EXPECT_TRUE(engine->apply(world));
    EXPECT_TRUE(engine->propose(own));
  }
  void tell(TalkingHost& other) const {
    for (const sim::SentPacket& packet : own.sent.packets) {
      other.live->hear(1, packet, own.sent.bytes_of(packet));
    }
  }

  std::unique_ptr<LiveWorld> live;
  std::unique_ptr<sim::Engine> engine;
  sim::HostReport own;
  WorldStep world;
};

TEST(LiveEngine, RobotsHearThoseOfOtherHostsWhoseStepsAreOthers) {
  Chatter::log().clear();
  TalkingHost first(0);
  TalkingHost second(1);
  for (int i = 0; i < 7; ++i) first.advance();
  Chatter::log().clear();
  for (int i = 0; i < 20; ++i) {
    first.advance();
    first.tell(second);
    second.advance();
    second.tell(first);
  }
  std::vector<std::uint32_t> numbers;
  for (const Heard& heard : Chatter::log()) {
    if (heard.to != 1) continue;
    EXPECT_EQ(heard.from, 0U);
    EXPECT_LE(heard.stamp_ns, heard.step * kStep_ns);
    numbers.push_back(heard.number);
  }
  ASSERT_GE(numbers.size(), 17U);
  for (std::size_t i = 1; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], numbers[i - 1] + 1);
  EXPECT_EQ(listeners(), (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace rave::real_time
