// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/realities.hpp"

#include <gtest/gtest.h>

#include "rave/bus/sequence.hpp"

namespace rave::real_time {
namespace {

/// Robots 0 and 1 run on host 0, which is this one, 2 on host 1 and 3 on host 2.
class RealitiesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    bus::BusConfig config;
    config.participant = "realities";
    config.run = bus::RunId::random();
    config.tag = "test-" + config.run.text();
    config.domain = 67;
    auto bus = bus::Bus::open(config);
    ASSERT_TRUE(bus) << bus.error().text();
    bus_ = *std::move(bus);
    auto made = Realities::create(*bus_, 0, {0, 0, 1, 2});
    ASSERT_TRUE(made) << made.error().text();
    realities_.emplace(*std::move(made));
  }

  void say(std::uint64_t writer, std::uint32_t host, std::uint32_t robot, bool simulated) {
    bus::RosterEntry entry{};
    entry.writer = writer;
    entry.host = host;
    entry.robot = robot;
    entry.kind = simulated ? rave_wire_ROBOT_SIMULATED : rave_wire_ROBOT_REAL;
    realities_->hear(entry);
  }
  /// What is new of robot 2; "nothing" if nothing is.
  std::string news() {
    const auto all = realities_->take();
    if (all.empty()) return "nothing";
    EXPECT_EQ(all.size(), 1U);
    EXPECT_EQ(all.front().robot, RobotId(2));
    return all.front().simulated ? "simulated" : "real";
  }

  std::unique_ptr<bus::Bus> bus_;
  std::optional<Realities> realities_;
};

TEST_F(RealitiesTest, AreToldWhenTheyChange) {
  EXPECT_EQ(news(), "nothing");
  say(7, 1, 2, true);
  EXPECT_EQ(news(), "simulated");
  EXPECT_EQ(news(), "nothing");
  say(7, 1, 2, false);
  EXPECT_EQ(news(), "real");
  say(7, 1, 2, false);
  EXPECT_EQ(news(), "nothing");
}

TEST_F(RealitiesTest, OfTwoProcessesOfAHostTheFirstCounts) {
  say(7, 1, 2, true);
  say(7, 1, 2, false);
  EXPECT_EQ(news(), "real");
  say(8, 1, 2, true);
  EXPECT_EQ(news(), "nothing") << "who was started by mistake is not believed";
  realities_->lose(7);
  EXPECT_EQ(news(), "simulated") << "whoever came in its place is";
  realities_->lose(8);
  EXPECT_EQ(news(), "nothing");
}

TEST_F(RealitiesTest, AProcessSpeaksForTheHostThatItSpokeForFirst) {
  say(7, 1, 2, true);
  EXPECT_EQ(news(), "simulated");
  say(7, 2, 3, false);
  EXPECT_EQ(news(), "nothing");
}

TEST_F(RealitiesTest, OfRobotsElsewhereAloneAreHeard) {
  say(7, 1, 0, false);
  say(7, 1, 9, false);
  say(7, 0, 1, false);
  EXPECT_EQ(news(), "nothing");
}

}  // namespace
}  // namespace rave::real_time
