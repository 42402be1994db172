// SPDX-License-Identifier: Apache-2.0
// Orders to robots of several hosts: by the authority, and forwarded by the hosts of the robots.
#include <limits>

#include "orders_world.hpp"
#include "split_run.hpp"

namespace rave::sim::testing {
namespace {

/// What people ask in the run below, by step.
std::vector<std::pair<int, WorldInput>> orders_of_a_day() {
  WorldInput again = drive(kDriver, 0.2, -0.5);
  again.author.name = "bert";
  return {{5, drive(kDriver, 0.5, 0.3)},
          {9, drive(kDriver, 0.4, 0.3)},
          {12, goal(kGoalGetter, {1, -1.5})},
          {12, path(kListener, {{1, 0}, {1, 1}})},
          {15, place(kListener, {2, 1}, 0.5)},
          {15, words(kListener, "hello")},
          {20, again},
          {25, cancel(kDriver)},
          {30, cancel(RobotId())}};
}

constexpr int kDay = 60;

/// The hash after each step of one process in which they are asked.
std::vector<RunHash> hashes_of_the_day() {
  const auto day = orders_of_a_day();
  const auto alone = make_engine(small_world());
  std::vector<RunHash> hashes;
  for (int k = 0; k < kDay; ++k) {
    for (const auto& [step, input] : day) {
      if (step != k) continue;
      EXPECT_EQ(why(alone->check_order(input)), "");
      EXPECT_EQ(why(alone->order(input)), "");
    }
    run(*alone, 1);
    hashes.push_back(alone->hash());
  }
  return hashes;
}

const std::vector<std::vector<std::uint32_t>> kSplits = {{0, 0, 0}, {0, 1, 0}, {2, 1, 0}};

TEST(SplitOrders, HostsGiveTheSameRunAsOneProcess) {
  const auto hashes = hashes_of_the_day();
  const auto day = orders_of_a_day();
  for (const auto& hosts : kSplits) {
    SplitRun split(small_world, hosts);
    for (int k = 0; k < kDay; ++k) {
      // The world of step k + 1 is made at the end of step k.
      for (const auto& [step, input] : day) {
        if (step != k + 1) continue;
        const auto asked = split.authority->ask(input);
        ASSERT_TRUE(asked) << asked.error().text();
      }
      ASSERT_TRUE(split.advance());
      ASSERT_EQ(split.hash(), hashes[static_cast<std::size_t>(k)]) << "step " << k;
      EXPECT_TRUE(split.authority->refusals().empty());
    }
  }
}

/// The same day, each order in the report of the host of its robot.
class ForwardedDay {
 public:
  explicit ForwardedDay(const std::vector<std::uint32_t>& host_of)
      : host_of_(host_of), run(small_world, host_of) {
    run.asks = [this](std::vector<HostReport>& reports) { put_inputs(reports); };
  }

 private:
  void put_inputs(std::vector<HostReport>& reports) {
    asked = 0;
    for (const auto& [step, input] : day_) {
      if (step != static_cast<int>(reports[0].step)) continue;
      for (std::uint32_t r = 0; r < host_of_.size(); ++r) {
        if (input.robot.valid() && input.robot.value() != r) continue;
        WorldInput own = input;
        own.robot = RobotId(r);
        own.sequence = 1000 + ++asked;
        reports[host_of_[r]].inputs.push_back(own);
      }
    }
  }
  std::vector<std::uint32_t> host_of_;
  std::vector<std::pair<int, WorldInput>> day_ = orders_of_a_day();

 public:
  std::size_t asked = 0;  ///< In the last reports.
  SplitRun run;
};

TEST(SplitOrders, HostsThatForwardThemGiveTheSameRunAndAreAnswered) {
  const auto hashes = hashes_of_the_day();
  for (const auto& hosts : kSplits) {
    ForwardedDay day(hosts);
    std::size_t answers = 0;
    for (int k = 0; k < kDay; ++k) {
      ASSERT_TRUE(day.run.advance());
      ASSERT_EQ(day.run.hash(), hashes[static_cast<std::size_t>(k)]) << "step " << k;
      ASSERT_EQ(day.run.world.answers.size(), day.asked) << "each is answered in its step";
      EXPECT_TRUE(day.run.world.refusals.empty());
      for (const InputAnswer& answer : day.run.world.answers) {
        EXPECT_EQ(answer.sequence, ++answers) << "they are numbered";
      }
    }
    EXPECT_EQ(answers, orders_of_a_day().size() + 2) << "one of them is to all three robots";
  }
}

TEST(SplitOrders, OfWhatHostsForwardTheAuthorityRefusesWhatItKnows) {
  SplitRun plain(small_world, {0, 1, 1});
  SplitRun asked(small_world, {0, 1, 1});
  bool once = true;
  asked.asks = [&](std::vector<HostReport>& reports) {
    if (!std::exchange(once, false)) return;
    reports[0].inputs = {place(kListener, {4, 0}), goal(kListener, {1e6, 0})};
    reports[0].inputs[0].sequence = 7;
    reports[0].inputs[1].sequence = 8;
  };
  ASSERT_TRUE(plain.advance());
  ASSERT_TRUE(asked.advance());
  ASSERT_EQ(asked.world.answers.size(), 2U);
  EXPECT_EQ(asked.world.answers[1].asked, 8U);
  ASSERT_EQ(asked.world.refusals.size(), 2U);
  EXPECT_EQ(asked.world.refusals[0].sequence, asked.world.answers[0].sequence);
  EXPECT_NE(asked.world.refusals[0].text.find("it would overlap `wall`"), std::string::npos);
  EXPECT_NE(asked.world.refusals[1].text.find("is outside the world"), std::string::npos);
  EXPECT_TRUE(asked.world.inputs.empty());
  EXPECT_TRUE(asked.authority->refusals().empty()) << "nobody asked here";
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(plain.advance());
    ASSERT_TRUE(asked.advance());
  }
  EXPECT_EQ(asked.hash(), plain.hash());
}

TEST(SplitOrders, AHostForwardsForItsOwnRobotsOnly) {
  SplitRun run(small_world, {0, 1, 1});
  ASSERT_TRUE(run.apply());
  for (std::size_t h = 0; h < 2; ++h) ASSERT_TRUE(run.hosts[h]->propose(run.reports[h]));
  const auto refused = [&](const WorldInput& input) {
    HostReport report = run.reports[0];
    report.inputs = {input};
    return why(run.authority->check(report));
  };
  EXPECT_EQ(refused(drive(kListener, 0.1, 0)), "");
  EXPECT_NE(refused(drive(kDriver, 0.1, 0)).find("an input that its host may not forward"),
            std::string::npos);
  EXPECT_NE(refused(cancel(RobotId())), "");
  WorldInput change;
  change.action = Change();
  change.robot = kListener;
  EXPECT_NE(refused(change), "");
  EXPECT_NE(refused(goal(kListener, {std::numeric_limits<double>::quiet_NaN(), 0})), "");
}

TEST(SplitOrders, WhatAHostRefusesChangesNothing) {
  SplitRun plain(small_world, {0, 1, 1});
  SplitRun asked(small_world, {0, 1, 1});
  const auto wall = asked.authority->ask(place(kListener, {4, 0}));
  ASSERT_TRUE(wall) << "only the step that does it looks for room";
  const auto deaf = asked.authority->ask(words(kDriver, "hello"));
  ASSERT_TRUE(deaf) << "only its host knows its program";
  EXPECT_FALSE(asked.authority->ask(goal(kListener, {1e9, 0})));
  std::vector<std::string> refusals;
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(plain.advance());
    ASSERT_TRUE(asked.advance());
    for (const InputRefusal& refusal : asked.authority->refusals()) {
      refusals.push_back(refusal.text);
    }
  }
  EXPECT_EQ(asked.hash(), plain.hash());
  ASSERT_EQ(refusals.size(), 2U);
  EXPECT_NE(refusals[0].find("it would overlap `wall`"), std::string::npos) << refusals[0];
  EXPECT_NE(refusals[1].find("its program takes no texts"), std::string::npos) << refusals[1];
}

}  // namespace
}  // namespace rave::sim::testing
