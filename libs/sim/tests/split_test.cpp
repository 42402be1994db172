// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "split_run.hpp"
#include "split_scene.hpp"

namespace rave::sim::testing::crowd {
namespace {

/// What happened in a run of one engine, and its hash after each step.
struct Track {
  std::vector<std::vector<Event>> events;
  std::vector<RunHash> hashes;
  RadioCounts counts;
};

Track alone(unsigned threads) {
  Track track;
  const auto engine = make_engine(scene(threads));
  for (std::uint64_t k = 0; k < kSteps; ++k) {
    if (k == kHandStep) {
      engine->stop(kStoppedByHand);
      const ParameterChange changes[] = {speed_by_hand()};
      EXPECT_TRUE(engine->set_parameters(kChangedByHand, changes));
      EXPECT_TRUE(engine->change_obstacle(removed_by_hand()));
    }
    track.events.push_back(run(*engine, 1));
    track.hashes.push_back(engine->hash());
  }
  track.counts = engine->radio_counts();
  return track;
}

const Track& reference() {
  static const Track kTrack = alone(1);
  return kTrack;
}

void expect_same(const std::vector<Event>& split, const std::vector<Event>& one) {
  ASSERT_EQ(split.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(split[i].step, one[i].step);
    EXPECT_EQ(split[i].robot, one[i].robot);
    EXPECT_EQ(split[i].kind, one[i].kind) << split[i].text << " / " << one[i].text;
    EXPECT_EQ(split[i].other, one[i].other);
    EXPECT_EQ(split[i].text, one[i].text);
  }
}

/// What hosts are told of the step that is done.
void expect_same_contacts(const std::vector<Event>& told, std::uint64_t step) {
  std::vector<Event> expected = reference().events[step];
  std::erase_if(expected, [](const Event& event) {
    return event.kind != EventKind::kContact && event.kind != EventKind::kPinned;
  });
  ASSERT_EQ(told.size(), expected.size()) << "step " << step;
  for (std::size_t i = 0; i < told.size(); ++i) {
    ASSERT_EQ(told[i].step, step);
    ASSERT_EQ(told[i].robot, expected[i].robot) << "step " << step;
    ASSERT_EQ(told[i].kind, expected[i].kind) << "step " << step;
    ASSERT_EQ(told[i].other, expected[i].other) << "step " << step;
  }
}

void ask_by_hand(WorldAuthority& authority) {
  WorldInput stop;
  stop.robot = kStoppedByHand;
  ASSERT_TRUE(authority.ask(stop));
  WorldInput change;
  change.robot = kChangedByHand;
  change.action = Change{{speed_by_hand()}};
  ASSERT_TRUE(authority.ask(change));
  WorldInput obstacle;
  obstacle.action = removed_by_hand();
  ASSERT_TRUE(authority.ask(obstacle));
}

/// Runs the scene on these hosts and compares each step with one engine.
void expect_the_same_run(const std::vector<std::uint32_t>& host_of, unsigned threads) {
  SplitRun run([threads] { return scene(threads); }, host_of);
  ASSERT_NE(run.authority, nullptr);
  for (std::uint64_t k = 0; k < kSteps; ++k) {
    // The world of step k + 1 is made at the end of step k.
    if (k + 1 == kHandStep) ask_by_hand(*run.authority);
    ASSERT_TRUE(run.advance());
    ASSERT_EQ(run.authority->steps_done(), k + 1);
    ASSERT_EQ(run.hosts[0]->steps_done(), k + 1);
    ASSERT_NO_FATAL_FAILURE(expect_same(run.events(), reference().events[k])) << "step " << k;
    ASSERT_EQ(run.hash(), reference().hashes[k]) << "step " << k;
  }
  ASSERT_TRUE(run.apply());
  EXPECT_EQ(run.radio_counts(), reference().counts);
  EXPECT_TRUE(run.authority->refusals().empty());
}

TEST(Split, TheSceneIsAsBusyAsItIsMeantToBe) {
  std::vector<Event> all;
  for (const auto& step : reference().events) all.insert(all.end(), step.begin(), step.end());
  EXPECT_GT(of_kind(all, EventKind::kContact).size(), 60U);
  EXPECT_GE(of_kind(all, EventKind::kPinned).size(), 1U);
  EXPECT_EQ(of_kind(all, EventKind::kProgramFailed).size(), 1U);
  EXPECT_EQ(of_kind(all, EventKind::kProgramFailed)[0].robot, kFailing);
  EXPECT_EQ(of_kind(all, EventKind::kChanged).size(), 4U);
  EXPECT_EQ(of_kind(all, EventKind::kChangeRefused).size(), 5U);
  EXPECT_EQ(of_kind(all, EventKind::kObstacleAdded).size(), 7U);
  EXPECT_EQ(of_kind(all, EventKind::kObstacleMoved).size(), 2U);
  EXPECT_EQ(of_kind(all, EventKind::kObstacleRemoved).size(), 2U);
  const auto contacts = of_kind(all, EventKind::kContact);
  const auto with_new = std::count_if(contacts.begin(), contacts.end(), [](const Event& event) {
    return event.other.value() >= 5 + kRobots;
  });
  EXPECT_GE(with_new, 4) << "robots run into what has come";
  EXPECT_EQ(of_kind(all, EventKind::kStopped).size(), 1U);
  EXPECT_GE(of_kind(all, EventKind::kPoseStale).size(), 4U);
  EXPECT_GE(of_kind(all, EventKind::kPoseBack).size(), 4U);
  EXPECT_GE(of_kind(all, EventKind::kGuardSlowed).size(), 5U);
  const RadioCounts& counts = reference().counts;
  EXPECT_GT(counts.delivered, 1000U);
  EXPECT_GT(counts.lost_range, 100U);
  EXPECT_GT(counts.lost_obstacle, 100U);
  EXPECT_GT(counts.lost_chance, 100U);
}

TEST(Split, OneHostOfAllRobots) { expect_the_same_run(split({30}), 1); }
TEST(Split, OneHostOfAllRobotsOnThreeThreads) { expect_the_same_run(split({30}), 3); }
TEST(Split, OneRobotAndTheRest) { expect_the_same_run(split({1, 29}), 1); }
TEST(Split, OneRobotAndTheRestOnThreeThreads) { expect_the_same_run(split({1, 29}), 3); }
TEST(Split, TheRestAndOneRealRobot) { expect_the_same_run(split({29, 1}), 1); }
TEST(Split, ThreeHosts) { expect_the_same_run(split({10, 10, 10}), 1); }
TEST(Split, ThreeHostsOnThreeThreads) { expect_the_same_run(split({10, 10, 10}), 3); }
TEST(Split, ThreeHostsInterleaved) { expect_the_same_run(interleaved(3), 1); }
TEST(Split, ThreeHostsInterleavedOnThreeThreads) { expect_the_same_run(interleaved(3), 3); }
TEST(Split, AHostForEachRobot) { expect_the_same_run(interleaved(kRobots), 1); }

TEST(Split, TheSumNoticesOneBitOfOnePercept) {
  for (const auto& [robot, sensor] : {std::pair{RobotId(7), 0U}, {RobotId(28), 1U}}) {
    SplitRun run([] { return scene(1); }, interleaved(3));
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(run.advance());
    ASSERT_EQ(run.hash(), reference().hashes[49]);
    run.hosts[robot.value() % 3]->flip_percept_bit(robot, sensor);
    for (int k = 50; k < 60; ++k) ASSERT_TRUE(run.advance());
    EXPECT_NE(run.hash(), reference().hashes[59]) << robot.value();
  }
}

TEST(Split, TheSumNoticesTheLastBitOfOneProposal) {
  SplitRun run([] { return scene(1); }, interleaved(3));
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(run.advance());
  ASSERT_TRUE(run.apply());
  std::vector<const HostReport*> all;
  for (std::size_t h = 0; h < run.hosts.size(); ++h) {
    ASSERT_TRUE(run.hosts[h]->propose(run.reports[h]));
    all.push_back(&run.reports[h]);
  }
  double& vx_mps = run.reports[1].proposals.vx_mps[0];
  vx_mps = std::nextafter(vx_mps, 9.0);
  ASSERT_TRUE(run.authority->step(all, run.world));
  EXPECT_NE(run.hash(), reference().hashes[50]);
}

TEST(Split, TheMessageToTheHostsDoesNotDependOnTheSplit) {
  SplitRun one([] { return scene(1); }, split({30}));
  SplitRun three([] { return scene(1); }, interleaved(3));
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(one.advance());
    ASSERT_TRUE(three.advance());
    ASSERT_EQ(one.world.x_m, three.world.x_m);
    ASSERT_EQ(one.world.wz_radps, three.world.wz_radps);
    ASSERT_EQ(one.world.flags, three.world.flags);
    ASSERT_EQ(one.world.sent.bytes, three.world.sent.bytes);
    ASSERT_EQ(one.world.sent.packets.size(), three.world.sent.packets.size());
    ASSERT_EQ(one.world.touches.size(), three.world.touches.size());
    ASSERT_EQ(one.world.samples.size(), three.world.samples.size());
    ASSERT_EQ(one.world.obstacles.size(), three.world.obstacles.size());
    for (std::size_t i = 0; i < one.world.obstacles.size(); ++i) {
      ASSERT_EQ(one.world.obstacles[i].id, three.world.obstacles[i].id);
    }
  }
}

TEST(Split, ANewAuthorityGoesOnToTheBit) {
  SplitRun run([] { return scene(1); }, interleaved(3));
  for (std::uint64_t k = 0; k < kSteps; ++k) {
    if (k + 1 == kHandStep) ask_by_hand(*run.authority);
    if (k % 7 == 6) {
      auto successor = WorldAuthority::create(scene(1), interleaved(3));
      ASSERT_TRUE(successor) << successor.error().text();
      const Status resumed = (*successor)->resume(run.world, run.authority->state());
      ASSERT_TRUE(resumed) << resumed.error().text();
      // What was asked for and not told to anybody is gone with the first.
      if (k + 1 == kHandStep) ask_by_hand(**successor);
      run.authority = *std::move(successor);
    }
    ASSERT_TRUE(run.advance());
    ASSERT_EQ(run.authority->steps_done(), k + 1);
    ASSERT_EQ(run.hash(), reference().hashes[k]) << "step " << k;
    ASSERT_NO_FATAL_FAILURE(expect_same_contacts(run.authority->state().done, k));
  }
}

TEST(Split, AnAuthorityOfAnotherWorldDoesNotGoOn) {
  SplitRun run([] { return scene(1); }, interleaved(3));
  AuthorityState state = run.authority->state();
  WorldStep small = run.world;
  small.x_m.pop_back();
  const Status other = run.authority->resume(small, state);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("a world of 29 robots, but there are 30"), std::string::npos)
      << other.error().message;
  state.pinned = {RobotId(kRobots)};
  EXPECT_FALSE(run.authority->resume(run.world, state));
  EXPECT_TRUE(run.advance());
}

TEST(Split, AResetOfAllBeginsTheSameRun) {
  SplitRun run([] { return scene(2); }, interleaved(3));
  for (int k = 0; k < 150; ++k) ASSERT_TRUE(run.advance());
  for (int again = 0; again < 2; ++again) {
    EXPECT_GT(run.authority->refused_count(), 0U);
    run.authority->reset();
    EXPECT_EQ(run.authority->refused_count(), 0U);
    EXPECT_TRUE(run.authority->refused().empty());
    for (auto& host : run.hosts) ASSERT_TRUE(host->reset());
    EXPECT_EQ(run.hash(), RunHash());
    ASSERT_TRUE(run.exchange());
    for (int k = 0; k < 150; ++k) ASSERT_TRUE(run.advance());
    EXPECT_EQ(run.hash(), reference().hashes[149]);
  }
}

}  // namespace
}  // namespace rave::sim::testing::crowd
