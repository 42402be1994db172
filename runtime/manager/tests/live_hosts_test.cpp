// SPDX-License-Identifier: Apache-2.0
// A manager in real time: whose word counts of which robot.
#include "../src/live_hosts.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "own_corner.hpp"
#include "rave/sim_testing/engine_fixture.hpp"
#include "speaking_host.hpp"

namespace rave::manager {
namespace {

using namespace sim::testing;

/// Robot 0 runs on host `one`, robot 1 on `two`.
class LiveHostsTest : public ::testing::Test {
 protected:
  LiveHostsTest() {
    options_.bus = own_corner();
    options_.identity = {rave_wire_kNone, "environment manager", 0, 7, 9, true};
    options_.hosts = {{"one", {0}}, {"two", {1}}};
    options_.robots.push_back({"anna", from_seconds(1)});
    options_.robots.push_back({"bob", from_seconds(1)});
    options_.step = from_seconds(0.01);
    options_.log = &ears_;
    hosts_ = LiveHosts::open(options_).value();
  }
  /// The manager goes on until it is so; meanwhile `meanwhile` is done again and again.
  void go_until(const std::function<bool()>& so, const std::function<void()>& meanwhile,
                const char* what) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!so() && std::chrono::steady_clock::now() < end) {
      meanwhile();
      hosts_->wait(Duration{10'000'000});
      ASSERT_TRUE(hosts_->look_at_processes(true));
      hosts_->take_pings([this](const bus::ClockPing& ping) { hosts_->claim_slot(ping); });
      hosts_->take_states();
    }
    EXPECT_TRUE(so()) << what << "\n" << ears_.heard;
  }
  void slot(SpeakingHost& host, std::size_t number) {
    go_until([&] { return hosts_->slots()[number].writer == host.writer(); },
             [&] { host.ping(hosts_->endpoint().writer()); }, "the host is here");
  }
  [[nodiscard]] bool has_heard(std::string_view words) const {
    return ears_.heard.find(words) != std::string::npos;
  }
  /// Where a robot was said to be; -1 before.
  [[nodiscard]] double x_m(std::size_t robot) const {
    const real_time::RobotSight* const sight = hosts_->sight_of(robot);
    return sight != nullptr ? sight->X_WR.x : -1;
  }

  LiveManagerOptions options_;
  Ears ears_;
  std::unique_ptr<LiveHosts> hosts_;
};

TEST_F(LiveHostsTest, AHostSpeaksForItsOwnRobotsAlone) {
  SpeakingHost one(options_.bus, 0, "one");
  slot(one, 0);
  go_until([&] { return x_m(0) == 3; }, [&] { one.say(3, {0}); }, "it is believed of its own");
  go_until([&] { return has_heard("robot 1 does not run on host `one`"); },
           [&] {
             one.say(4, {0, 1});
           },
           "who says more is named");
  EXPECT_EQ(x_m(1), -1);
  EXPECT_FALSE(hosts_->stamp_of(1));
}

TEST_F(LiveHostsTest, OfTwoProcessesOfAHostTheOneThatSitsSpeaks) {
  SpeakingHost first(options_.bus, 0, "one");
  slot(first, 0);
  go_until([&] { return x_m(0) == 3; }, [&] { first.say(3, {0}); }, "the first is believed");
  SpeakingHost second(options_.bus, 0, "one");
  go_until([&] { return has_heard("host `one` is served by another process"); },
           [&] {
             second.ping(hosts_->endpoint().writer());
             second.say(9, {0});
           },
           "the second is named");
  EXPECT_EQ(x_m(0), 3);
  EXPECT_EQ(hosts_->slots()[0].writer, first.writer());
}

TEST_F(LiveHostsTest, WhatWasOvertakenOnTheWayIsOld) {
  SpeakingHost one(options_.bus, 0, "one");
  slot(one, 0);
  go_until([&] { return x_m(0) == 3; }, [&] { one.say(3, {0}, 2); }, "it is believed");
  const std::uint64_t states = hosts_->states();
  go_until([&] { return hosts_->states() > states + 5; }, [&] { one.say(4, {0}, 1.5); }, "it came");
  EXPECT_EQ(x_m(0), 3);
  go_until([&] { return x_m(0) == 5; }, [&] { one.say(5, {0}, 2.5); }, "what is newer counts");
}

}  // namespace
}  // namespace rave::manager
