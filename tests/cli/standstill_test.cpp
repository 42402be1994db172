// SPDX-License-Identifier: Apache-2.0
// Processes of a run that stand still for longer than their lease, as a suspended computer does.
#include <csignal>

#include "onlooker.hpp"
#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;

class Standstill : public SharedWorld {
 protected:
  void begin(const std::string& scenario, Words words) {
    words.insert(words.end(), {"--run", run_.text()});
    start("env", "env", scenario, words);
    start_host("one", scenario, words);
    start_host("two", scenario, words);
  }
  /// The manager stands until the hosts have missed it, so it has missed them as well.
  void let_manager_stand() {
    signal("env", SIGSTOP);
    for (const char* const host : {"one", "two"}) {
      wait_for_line(host, "the environment manager is lost");
    }
    signal("env", SIGCONT);
    wait_for_line("env", "stood still: this process, for");
  }
  void wait_for_step(std::uint64_t step) {
    auto steps = StepListener::open(run_, apart());
    ASSERT_TRUE(steps) << steps.error().text();
    wait_until(
        [&] {
          (*steps)->listen();
          return (*steps)->step() >= step;
        },
        "step " + std::to_string(step));
  }

  bus::RunId run_ = bus::RunId::random();
};

class AManagerStandsStill : public Standstill, public ::testing::WithParamInterface<const char*> {};

TEST_P(AManagerStandsStill, AndTheRunGoesOnWithAllHosts) {
  const Words span = {"--duration", "60", "--no-record", "--no-picture"};
  const std::string scenario = crowd_with_policy(GetParam(), 0.5);
  const std::string alone = hash_alone(scenario, {"--duration", "60"});
  ASSERT_EQ(alone.size(), 16U);
  begin(scenario, span);
  wait_for_step(500);
  let_manager_stand();
  EXPECT_EQ(end_of("env"), 0) << console("env");
  EXPECT_EQ(console("env").find("is gone in step"), std::string::npos) << console("env");
  EXPECT_EQ(console("env").find("has not answered for"), std::string::npos) << console("env");
  EXPECT_EQ(result("env")["hash"], alone);
  for (const char* const host : {"one", "two"}) {
    EXPECT_EQ(end_of(host), 0) << console(host);
    EXPECT_TRUE(result(host)["whole"]) << result(host).dump();
  }
}
INSTANTIATE_TEST_SUITE_P(Policies, AManagerStandsStill,
                         ::testing::Values("wait", "drop", "restart"),
                         [](const auto& policy) { return std::string(policy.param); });

TEST_F(Standstill, AManagerInRealTimeCountsNoHostAsLostAndSaysThatItStood) {
  begin("live.yaml", {"--no-record"});
  // Worlds come again only to hosts to which they have come.
  for (const char* const host : {"one", "two"}) {
    wait_for_line(host, "the clock of the environment manager differs");
  }
  let_manager_stand();
  for (const char* const host : {"one", "two"}) wait_for_line(host, "worlds arrive again");
  for (const char* const who : {"env", "one", "two"}) signal(who, SIGINT);
  for (const char* const who : {"env", "one", "two"}) {
    EXPECT_EQ(end_of(who), std::string_view(who) == "env" ? 1 : 0) << console(who);
  }
  EXPECT_EQ(console("env").find("is gone; the others continue"), std::string::npos)
      << console("env");
  const auto json = result("env");
  EXPECT_NE(json["problems"].dump().find("the environment manager stood still"), std::string::npos)
      << json["problems"];
  EXPECT_EQ(json["problems"].dump().find("was lost"), std::string::npos) << json["problems"];
}

TEST_F(Standstill, AHostThatStoodStillHasNotLostItsManager) {
  const Words span = {"--duration", "60", "--no-record", "--no-picture"};
  const std::string alone = hash_alone("crowd.yaml", {"--duration", "60"});
  begin("crowd.yaml", span);
  wait_for_step(500);
  signal("one", SIGSTOP);
  wait_for_line("env", "host `one` is gone in step");
  signal("one", SIGCONT);
  EXPECT_EQ(end_of("env"), 0) << console("env");
  EXPECT_EQ(result("env")["hash"], alone);
  EXPECT_EQ(end_of("one"), 0) << console("one");
  EXPECT_EQ(console("one").find("the environment manager is lost"), std::string::npos)
      << console("one");
}

TEST_F(Standstill, AHostThatWasDroppedAsleepEndsThoughTheRunIsOver) {
  begin(crowd_with_policy("drop", 5), {"--duration", "100000", "--no-record", "--no-picture"});
  wait_for_step(100);
  signal("one", SIGSTOP);
  wait_for_line("env", "host `one` is gone in step");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
  EXPECT_EQ(end_of("two"), 0) << console("two");
  signal("one", SIGCONT);
  wait_until([this] { return !runs("one"); }, "the host ends");
  EXPECT_EQ(end_of("one"), 1);
  // It may still hear what was told to it while it slept.
  const std::string why = result("one")["ending"].dump();
  EXPECT_TRUE(why.find("after this host stood still") != std::string::npos ||
              why.find("the run continued without this host") != std::string::npos)
      << why;
}

}  // namespace
}  // namespace rave::cli_test
