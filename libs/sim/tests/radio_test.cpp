// SPDX-License-Identifier: Apache-2.0
#include "rave/sim_testing/radio_fixture.hpp"

namespace rave::sim::testing {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST_F(RadioTest, IsHeardWithinTheRangeAndNotBeyond) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}, {"until", 1}}, {{"range_m", 5}}));
  add_twin(spec, {4.5, 0, 0});
  add_twin(spec, {0, 5.5, 0});
  add_twin(spec, {-3, -3, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  EXPECT_EQ(listeners(), (Ids{1, 3}));
  EXPECT_EQ(engine->radio_counts().lost_range, 1U);
  expect_balance(engine->radio_counts());
}

TEST_F(RadioTest, TheShorterOfTwoRangesCounts) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}, {"until", 1}}, {{"range_m", 50}}));
  add_robot(spec, talking_type({{"only", 0}}, {{"range_m", 2}}), {3, 0, 0});
  add_robot(spec, talking_type({{"only", 0}}), {30, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  EXPECT_EQ(listeners(), (Ids{2}));
}

TEST_F(RadioTest, ReportedPosesDecideAndNotTrueOnes) {
  EngineSpec spec;
  RobotType lost = talking_type({{"until", 1}, {"only", 0}}, {{"range_m", 5}});
  lost.sensors.push_back(virtual_sensor<Beacon>("beacon", {{"offset_m", 100}, {"error_m", 0}}));
  lost.pose_from = 0;
  RobotType here = talking_type({{"until", 1}, {"only", 0}}, {{"range_m", 5}});
  add_robot(spec, std::move(here));
  add_robot(spec, std::move(lost), {1, 0, 0});
  add_twin(spec, {-97, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  EXPECT_EQ(listeners(), (Ids{2}));
}

TEST_F(RadioTest, ARealRobotHearsByItsReportedPose) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}}, {{"range_m", 5}}));
  RobotType real = real_type({{"x", 4.5}, {"vx", 0.5}});
  add_transmitter(real);
  add_communicator(real, {{"range_m", 5}});
  real.program = chatter({{"only", 0}});
  add_robot(spec, std::move(real));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 200);
  ASSERT_FALSE(Chatter::log().empty());
  // It drives off and passes 5 m after one second; a message sent then arrives a step later.
  EXPECT_EQ(Chatter::log().front().step, 1);
  EXPECT_NEAR(static_cast<double>(Chatter::log().back().step), 100, 2);
  EXPECT_GT(engine->radio_counts().lost_range, 90U);
}

TEST_F(RadioTest, AWallInBetweenStopsItIfTheModelAsks) {
  for (const bool sight : {false, true}) {
    Chatter::log().clear();
    EngineSpec spec;
    add_robot(spec, talking_type({{"only", 0}, {"until", 1}}, {{"sight", sight ? 1.0 : 0.0}}));
    add_twin(spec, {2, 0, 0});  // behind the wall
    add_twin(spec, {0, 2, 0});
    add_twin(spec, {0, 4, 0});  // behind a robot
    spec.world.obstacles.push_back(box({1, 0, 0}, 0.1, 1));
    spec.world.obstacles.push_back(box({0, 1, 0}, 1, 0.1, 0.05));  // too low to matter
    const auto engine = make_engine(std::move(spec));
    run(*engine, 3);
    EXPECT_EQ(listeners(), sight ? (Ids{2}) : (Ids{1, 2, 3}));
    EXPECT_EQ(engine->radio_counts().lost_obstacle, sight ? 2U : 0U);
    expect_balance(engine->radio_counts());
  }
}

TEST_F(RadioTest, AMessageToOneOrToATeamReachesOnlyThose) {
  for (const double range_m : {0.0, 10.0}) {
    for (const double to : {2.0, -2.0, 0.0, 99.0}) {
      Chatter::log().clear();
      EngineSpec spec;
      add_robot(spec,
                talking_type({{"only", 0}, {"until", 1}, {"to", to}}, {{"range_m", range_m}}));
      for (const double x_m : {1.0, 2.0, 3.0}) add_twin(spec, {x_m, 0, 0});
      const char* teams[] = {"red", "blue", "blue", "red"};
      for (std::size_t r = 0; r < 4; ++r) spec.robots[r].team = teams[r];
      const auto engine = make_engine(std::move(spec));
      run(*engine, 3);
      const Ids expected = to == 2 ? Ids{2} : to == -2 ? Ids{3} : Ids{};
      EXPECT_EQ(listeners(), expected) << "to " << to << ", range " << range_m;
      EXPECT_EQ(engine->radio_counts().addressed, expected.size());
      EXPECT_EQ(engine->radio_counts().sent, 1U);
    }
  }
}

TEST_F(RadioTest, LossesAreAsOftenAsTheModelSays) {
  EngineSpec spec;
  add_robot(spec, talking_type({}, {{"loss", 0.2}}));
  for (int r = 1; r < 11; ++r) add_twin(spec, {1.0 * r, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 1000);
  const RadioCounts& c = engine->radio_counts();
  ASSERT_EQ(c.addressed, 110'000U);
  // Four standard deviations of a binomial distribution.
  EXPECT_NEAR(static_cast<double>(c.lost_chance), 22'000, 4 * 132.7);
  // Each receiver loses its own share.
  std::map<std::uint32_t, int> heard;
  for (const Heard& h : Chatter::log()) ++heard[h.to];
  for (const auto& [robot, count] : heard) EXPECT_NEAR(count, 8000, 4 * 40) << robot;
}

TEST_F(RadioTest, DelaysAreRoundedUpToStepsAndAtLeastOne) {
  const std::pair<double, std::int64_t> cases[] = {{0, 1},      {0.001, 1}, {0.01, 1},
                                                   {0.0101, 2}, {0.025, 3}, {1, 100}};
  for (const auto& [delay_s, steps] : cases) {
    Chatter::log().clear();
    EngineSpec spec;
    add_robot(spec, talking_type({{"only", 0}, {"until", 1}}, {{"delay_s", delay_s}}));
    add_twin(spec, {1, 0, 0});
    const auto engine = make_engine(std::move(spec));
    run(*engine, 120);
    ASSERT_EQ(Chatter::log().size(), 1U) << delay_s;
    EXPECT_EQ(Chatter::log()[0].step, steps) << delay_s;
    EXPECT_EQ(Chatter::log()[0].stamp_ns, 0);
  }
}

TEST_F(RadioTest, ArrivalsAreOrderedBySenderAndNumberWhateverTheDelay) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"until", 200}}, {{"jitter_s", 0.08}}));
  for (int r = 1; r < 5; ++r) add_twin(spec, {1.0 * r, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 300);
  ASSERT_EQ(Chatter::log().size(), 200U * 20U);
  bool overtaken = false;
  for (std::size_t i = 1; i < Chatter::log().size(); ++i) {
    const Heard& a = Chatter::log()[i - 1];
    const Heard& b = Chatter::log()[i];
    if (a.to != b.to || a.step != b.step) continue;
    EXPECT_LT(std::tie(a.from, a.number), std::tie(b.from, b.number));
    overtaken = overtaken || a.from != b.from;
  }
  EXPECT_TRUE(overtaken);
}

TEST_F(RadioTest, RateAndQueueAreExact) {
  EngineSpec spec;
  // 10 bytes with the overhead take 10 ms; three fit into the queue.
  add_robot(spec, talking_type({{"only", 0}, {"count", 5}, {"until", 1}},
                               {{"rate", 1000}, {"queue", 30}, {"overhead", 6}}));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 10);
  ASSERT_EQ(Chatter::log().size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    // The first leaves completely at 10 ms, which is the next step.
    EXPECT_EQ(Chatter::log()[i].step, i + 1);
    EXPECT_EQ(Chatter::log()[i].number, i + 1);
  }
  EXPECT_EQ(engine->radio_counts().offered, 5U);
  EXPECT_EQ(engine->radio_counts().sent, 3U);
  EXPECT_EQ(engine->radio_counts().lost_queue, 2U);
  expect_balance(engine->radio_counts());
}

TEST_F(RadioTest, AConstantOverloadGoesThroughAtTheRate) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}, {"count", 2}, {"size", 20}},
                               {{"rate", 800}, {"queue", 100}}));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 1000);
  // 25 ms each; the 400th is complete at the end of the last step.
  EXPECT_EQ(engine->radio_counts().sent, 400U);
  EXPECT_EQ(engine->radio_counts().offered, 2000U);
}

TEST_F(RadioTest, CommunicatorsOfOneTransmitterShareItsRate) {
  for (const double own : {0.0, 500.0}) {
    Chatter::log().clear();
    EngineSpec spec;
    RobotType type = simulated_type();
    add_transmitter(type, 1000);
    add_communicator(type, {{"rate", own}}, "air");
    add_communicator(type, {}, "wire");
    type.program = chatter({{"only", 0}, {"count", 2}, {"size", 10}, {"until", 1}});
    add_robot(spec, std::move(type));
    add_twin(spec, {1, 0, 0});
    const auto engine = make_engine(std::move(spec));
    run(*engine, 20);
    std::vector<std::pair<std::int64_t, std::uint32_t>> heard;
    for (const Heard& h : Chatter::log()) heard.emplace_back(h.step, h.number);
    using Times = std::vector<std::pair<std::int64_t, std::uint32_t>>;
    // 1 and 2 go over `air`, 3 and 4 over `wire`. At equal claims `air` comes first; when its own
    // rate holds it back, `wire` goes on.
    EXPECT_EQ(heard, own == 0 ? (Times{{1, 1}, {2, 2}, {3, 3}, {4, 4}})
                              : (Times{{2, 1}, {2, 3}, {4, 2}, {4, 4}}));
  }
}

TEST_F(RadioTest, AFullMailboxLosesTheNewest) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}, {"count", 7}, {"until", 1}}));
  add_robot(spec, talking_type({{"only", 0}}, {{"messages", 4}}), {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  ASSERT_EQ(Chatter::log().size(), 4U);
  EXPECT_EQ(Chatter::log()[3].number, 4U);
  EXPECT_EQ(engine->radio_counts().lost_mailbox, 3U);
  expect_balance(engine->radio_counts());
}

TEST_F(RadioTest, AnOutboxTakesNoMoreThanItHolds) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}, {"count", 7}, {"until", 1}}, {{"messages", 4}}));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  EXPECT_EQ(engine->radio_counts().offered, 4U);
  EXPECT_EQ(engine->radio_counts().refused, 3U);
}

TEST_F(RadioTest, WhatAFailingProgramSaidLastIsNotSent) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}, {"throw_at", 3}}));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 10);
  EXPECT_EQ(engine->radio_counts().offered, 3U);
}

TEST_F(RadioTest, AModelThatThrowsIsReportedOnceForEachOfItsRobots) {
  EngineSpec spec;
  add_robot(spec, talking_type({}, {{"throws", 1}}));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  const auto events = of_kind(run(*engine, 10), EventKind::kDriverFailed);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].text, "communicator `air` (driver `model`): threw an exception: no idea");
  EXPECT_EQ(engine->radio_counts().delivered, 0U);
  expect_balance(engine->radio_counts());
}

TEST_F(RadioTest, TracesShowWhatWasSentAndDelivered) {
  EngineSpec spec;
  add_robot(spec, talking_type({{"only", 0}, {"count", 2}, {"until", 2}}));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 2);
  // Step 1 delivers what step 0 sent, and sends.
  ASSERT_EQ(engine->radio().size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const RadioTrace& trace = engine->radio()[i];
    EXPECT_EQ(trace.delivered, i < 2);
    EXPECT_EQ(trace.from, RobotId(0));
    EXPECT_EQ(trace.to, i < 2 ? RobotId(1) : RobotId());
    EXPECT_EQ(trace.sequence, i + 1);
    EXPECT_EQ(trace.stamp_ns, i < 2 ? 0 : 10'000'000);
    ASSERT_EQ(trace.payload.size(), 4U);
    EXPECT_EQ(std::to_integer<std::size_t>(trace.payload[0]), i + 1);
  }
}

}  // namespace
}  // namespace rave::sim::testing
