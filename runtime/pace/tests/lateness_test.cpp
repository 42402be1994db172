// SPDX-License-Identifier: Apache-2.0
// Deadlines by a clock that goes only where the test puts it.
#include "rave/pace/lateness.hpp"

#include <gtest/gtest.h>

#include "rave/pace/late_watch.hpp"
#include "rave/sim/guard.hpp"

namespace rave::runtime {
namespace {

using std::chrono::milliseconds;
using Clock = Lateness::Clock;
using Blame = std::map<std::string, std::uint64_t>;

class LatenessTest : public ::testing::Test {
 protected:
  static constexpr milliseconds kPeriod{10};

  [[nodiscard]] Clock::time_point due(int step) const { return zero_ + step * kPeriod; }
  void pass(milliseconds time) { now_ += time; }
  /// Sleeps until a step is due, if it is not yet.
  void wake(int step) {
    now_ = std::max(now_, due(step));
    lateness_.woke(due(step), now_);
  }
  void work(sim::Phase phase, milliseconds time) {
    pass(time);
    total_.ns[static_cast<std::size_t>(phase)] += std::chrono::nanoseconds(time).count();
    lateness_.worked(total_, now_);
  }
  void make_step(int step, milliseconds decide) {
    wake(step);
    work(sim::Phase::kDecide, decide);
    lateness_.done(now_);
  }

  Clock::time_point zero_{std::chrono::hours(5)};
  Clock::time_point now_ = zero_;
  sim::PhaseTimes total_;
  Lateness lateness_{kPeriod};
};

TEST_F(LatenessTest, AStepHasUntilTheNextOneIsDue) {
  for (int step = 0; step < 3; ++step) make_step(step, kPeriod);
  EXPECT_EQ(lateness_.facts().deadlines, 3U);
  EXPECT_EQ(lateness_.facts().missed, 0U);
  EXPECT_EQ(lateness_text(lateness_.facts()), "all 3 met");
  make_step(3, milliseconds(11));
  EXPECT_EQ(lateness_.facts().missed, 1U);
  EXPECT_EQ(lateness_.facts().worst_ns, 1'000'000);
}

TEST_F(LatenessTest, AMomentIsAsOldAsItsStepIsOverdue) {
  wake(0);
  EXPECT_EQ(lateness_.age(now_), Clock::duration());
  EXPECT_EQ(lateness_.age(due(1)), kPeriod);
  EXPECT_EQ(lateness_.behind(due(1)), Clock::duration());
  pass(milliseconds(700));
  lateness_.done(now_);
  wake(1);
  EXPECT_EQ(lateness_.age(now_), milliseconds(690)) << "it has not caught up";
  EXPECT_EQ(lateness_.behind(now_), milliseconds(680));
}

TEST_F(LatenessTest, ThoseWhoWaitedForALateStepAreLateToo) {
  make_step(0, milliseconds(35));
  for (int step = 1; step < 10; ++step) make_step(step, milliseconds(2));
  // Until 10, 20, 30, 40 and 50 ms; done at 35, 37, 39, 41 and, in time, 43.
  EXPECT_EQ(lateness_.facts().deadlines, 10U);
  EXPECT_EQ(lateness_.facts().missed, 4U);
  EXPECT_EQ(lateness_.facts().worst_ns, 25'000'000);
  EXPECT_EQ(lateness_.facts().blame, (Blame{{"decide", 4}})) << "quick steps have no blame";
  EXPECT_DOUBLE_EQ(lateness_.facts().missed_pct(), 40);
}

TEST_F(LatenessTest, BlamesWhatTookTheTimeSinceAStepWasInTime) {
  make_step(0, milliseconds(1));
  wake(1);
  work(sim::Phase::kSense, milliseconds(4));
  pass(milliseconds(7));
  lateness_.did(Lateness::Part::kRecord, now_);
  lateness_.done(now_);
  EXPECT_EQ(lateness_.facts().blame, (Blame{{"record", 1}}));
  EXPECT_EQ(lateness_.busiest(), "record");
  make_step(2, milliseconds(1));  // in time: all is forgiven
  now_ = due(3) + milliseconds(12);
  wake(3);
  lateness_.done(now_);
  EXPECT_EQ(lateness_.facts().blame, (Blame{{"machine", 1}, {"record", 1}}))
      << "nobody did anything, and it was not let run";
}

TEST_F(LatenessTest, WhoIsCalledFromWithinTheEngineIsNotCountedAsItsNextIngest) {
  wake(0);
  work(sim::Phase::kDecide, milliseconds(2));
  pass(milliseconds(20));
  lateness_.did(Lateness::Part::kOnlookers, now_);
  // The engine has measured until here since its last phase ended.
  total_.ns[static_cast<std::size_t>(sim::Phase::kIngest)] += 21'000'000;
  pass(milliseconds(1));
  lateness_.worked(total_, now_);
  lateness_.done(now_);
  EXPECT_EQ(lateness_.facts().blame, (Blame{{"observers", 1}}));
}

TEST_F(LatenessTest, StepsThatWereDueAndNeverDoneAreMissed) {
  make_step(0, milliseconds(45));
  EXPECT_EQ(lateness_.facts().missed, 1U);
  // Until 45 ms the deadlines of the steps 1, 2 and 3 have passed, and not that of step 4.
  lateness_.end(due(99), now_);
  EXPECT_EQ(lateness_.facts().deadlines, 4U);
  EXPECT_EQ(lateness_.facts().missed, 4U);
  EXPECT_EQ(lateness_.facts().worst_ns, 35'000'000);
}

TEST_F(LatenessTest, AfterTheLastStepNoneIsMissed) {
  make_step(0, milliseconds(3));
  make_step(1, milliseconds(3));
  pass(milliseconds(500));
  lateness_.end(due(1), now_);
  EXPECT_EQ(lateness_.facts().deadlines, 2U);
  EXPECT_EQ(lateness_.facts().missed, 0U);
}

TEST_F(LatenessTest, WithoutAPaceNothingIsCounted) {
  Lateness without{Clock::duration()};
  without.woke(due(0), due(50));
  without.done(due(60));
  without.end(due(1), due(100));
  EXPECT_EQ(without.facts(), LatenessFacts());
  EXPECT_EQ(without.behind(due(70)), Clock::duration());
}

TEST_F(LatenessTest, ProcessesAreAddedUp) {
  LatenessFacts one{100, 3, 5'000'000, 0, {{"decide", 3}}};
  one += {50, 4, 9'000'000, 2, {{"decide", 1}, {"sense", 3}}};
  EXPECT_EQ(one, (LatenessFacts{150, 7, 9'000'000, 2, {{"decide", 4}, {"sense", 3}}}));
  EXPECT_EQ(one.worst_phase(), "decide");
  EXPECT_EQ(lateness_text(one),
            "7 of 150 missed (4.7 %), by up to 0.009 s: decide 4, sense 3; real robots were "
            "stopped 2x");
}

TEST_F(LatenessTest, ALiveRunThatMissedTooManyOrStoppedARobotIsNotWhole) {
  LatenessFacts facts{1000, 10, 15'000'000, 0, {{"decide", 10}}};
  EXPECT_TRUE(lateness_problems(facts, 1).empty()) << "one in a hundred may be late";
  facts.missed = 11;
  auto problems = lateness_problems(facts, 1);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0],
            "more than 1 % of the deadlines were missed: 11 of 1000 missed (1.1 %), by up to 0.015 "
            "s: decide 10");
  EXPECT_TRUE(lateness_problems(facts, 100).empty());
  facts.stops = 1;
  problems = lateness_problems(facts, 100);
  ASSERT_EQ(problems.size(), 1U) << "whatever share may be missed";
  EXPECT_NE(problems[0].find("real robots were stopped 1x"), std::string::npos) << problems[0];
}

/// Two robots, of which the first is real.
class LateStops : public LatenessTest {
 protected:
  LateStops() {
    spec_.types.resize(2);
    spec_.types[0].simulated = false;
    spec_.robots.resize(2);
    spec_.robots[1].type = 1;
  }
  static sim::Event stopped(std::uint32_t robot, sim::GuardLimit limit) {
    return {1,
            RobotId(robot),
            sim::EventKind::kGuardStopped,
            BodyId(),
            "",
            static_cast<std::uint32_t>(limit)};
  }
  [[nodiscard]] std::uint64_t stops_of(const sim::Event& event, Duration world_age) {
    LateWatch watch(kPeriod, log_, nullptr);
    // By now it is behind by a second.
    watch.count().woke(Clock::now() - std::chrono::seconds(1), Clock::now());
    watch.look(spec_, std::span(&event, 1), world_age);
    return watch.facts().stops;
  }

  sim::EngineSpec spec_;
  NullLogSink log_;
};

TEST_F(LateStops, AreThoseOfRealRobotsByAWorldThatIsTooOld) {
  EXPECT_EQ(stops_of(stopped(0, sim::GuardLimit::kWorldLost), {}), 1U);
  EXPECT_EQ(stops_of(stopped(1, sim::GuardLimit::kWorldLost), {}), 0U);
  EXPECT_EQ(stops_of(stopped(0, sim::GuardLimit::kFence), {}), 0U);
}

TEST_F(LateStops, AreNotThoseOfAHostThatWasSentNoWorld) {
  EXPECT_EQ(stops_of(stopped(0, sim::GuardLimit::kWorldLost), from_seconds(1.5)), 0U);
  EXPECT_EQ(stops_of(stopped(0, sim::GuardLimit::kWorldLost), from_seconds(0.1)), 1U);
}

}  // namespace
}  // namespace rave::runtime
