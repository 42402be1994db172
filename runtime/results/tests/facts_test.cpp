// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <tuple>

#include "facts_sample.hpp"

namespace rave::runtime::testing {
namespace {

constexpr FactsLimits kLimits{4, 8};

TEST(Facts, ComeBackBitByBit) {
  const auto bytes = encode_facts(sample_whose(), sample_facts(1));
  const auto back = decode_facts(bytes, sample_whose(), kLimits);
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(encode_facts(sample_whose(), *back), bytes);
  EXPECT_TRUE(std::signbit(back->robots.at(0).y_m));
  EXPECT_EQ(back->goals.arrivals.at(1).time_s, 1.5);
}

TEST(Facts, WhatIsCutIsRefused) {
  const auto bytes = encode_facts(sample_whose(), sample_facts(1));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_facts(std::span(bytes).first(size), sample_whose(), kLimits)) << size;
  }
}

TEST(Facts, ThoseOfAnotherRunOrHostOrWorldAreRefused) {
  const auto bytes = encode_facts(sample_whose(), sample_facts(3));
  const auto run = decode_facts(bytes, {8, "left"}, kLimits);
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().message.find("another scenario"), std::string::npos);
  const auto host = decode_facts(bytes, {7, "right"}, kLimits);
  ASSERT_FALSE(host);
  EXPECT_NE(host.error().message.find("of host `left`, not of `right`"), std::string::npos);
  const auto robots = decode_facts(bytes, sample_whose(), {3, 8});
  ASSERT_FALSE(robots);
  EXPECT_NE(robots.error().message.find("robots or bodies that do not exist"), std::string::npos);
  EXPECT_FALSE(decode_facts(bytes, sample_whose(), {4, 1}));
}

TEST(Facts, OfThisVersionHaveTheBytesOfTheSample) {
  std::ifstream file(RAVE_SOURCE_DIR "/runtime/results/tests/corpus_facts/sample.cdr",
                     std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto bytes = encode_facts(sample_whose(), sample_facts(1));
  const bool same =
      text.size() == bytes.size() && std::memcmp(text.data(), bytes.data(), bytes.size()) == 0;
  EXPECT_TRUE(same) << "another layout needs another version, and a new sample";
  if (same) return;
  const std::string now = ::testing::TempDir() + "rave-results-sample.cdr";
  std::ofstream(now, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  ADD_FAILURE() << "what it is now is in " << now;
}

TEST(Facts, OfTwoHostsAddUpInAnyOrder) {
  RunFacts whole;
  RunFacts turned;
  merge(sample_facts(1), whole);
  merge(sample_facts(3), whole);
  merge(sample_facts(3), turned);
  merge(sample_facts(1), turned);
  EXPECT_EQ(encode_facts(sample_whose(), whole), encode_facts(sample_whose(), turned));
  ASSERT_EQ(whole.robots.size(), 2U);
  EXPECT_EQ(whole.robots[0].robot, 1U);
  EXPECT_EQ(whole.radio.sent, 6U);
  EXPECT_EQ(whole.hits["simulated"]["real"], 4U);
  EXPECT_NEAR(whole.closest["real-simulated"].gap_m, 0.2, 1e-12);
  EXPECT_EQ(whole.goals.touches[0], 4U);
  EXPECT_EQ(whole.sightings->all().total, 10U);
  ASSERT_EQ(whole.tracks.size(), 4U);
  EXPECT_FALSE(whole.tracks[1].track.odometry_only);
  EXPECT_EQ(whole.tracks[1].robot, 3U);
  EXPECT_EQ(whole.events[0].step, 3U);
  EXPECT_EQ(whole.events[1].robot, RobotId(3));
  ASSERT_EQ(whole.shadows.size(), 2U);
  EXPECT_EQ(whole.shadows[0].robot, 1U);
  EXPECT_EQ(whole.shadows[1].robot, 3U);
  ASSERT_TRUE(whole.world);
  EXPECT_EQ(whole.world->first_step, 1U) << "who saw more of the world tells of it";
}

sim::Event obstacle(std::uint64_t step, sim::EventKind kind, std::uint32_t change) {
  return {step, RobotId(), kind, BodyId(7), "`crate`", change};
}

TEST(Facts, AnObstacleThatHostsHadAtDifferentStepsCameOnce) {
  using sim::EventKind;
  RunFacts first;
  first.events = {
      obstacle(10, EventKind::kObstacleAdded, 1), obstacle(20, EventKind::kObstacleMoved, 2),
      obstacle(31, EventKind::kObstacleMoved, 3), obstacle(40, EventKind::kObstacleRemoved, 4)};
  RunFacts second;
  second.events = {obstacle(11, EventKind::kObstacleAdded, 1),
                   obstacle(30, EventKind::kObstacleMoved, 3)};
  // It came when the obstacle had gone.
  RunFacts late;
  late.events = {obstacle(50, EventKind::kObstacleAdded, 4),
                 obstacle(50, EventKind::kObstacleRemoved, 4)};
  const std::vector<const RunFacts*> all = {&first, &second, &late};
  for (const std::vector<int>& order :
       {std::vector<int>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
    RunFacts whole;
    for (const int i : order) merge(*all[static_cast<std::size_t>(i)], whole);
    std::vector<std::pair<std::uint64_t, EventKind>> events;
    for (const sim::Event& event : whole.events) events.emplace_back(event.step, event.kind);
    EXPECT_EQ(events, (std::vector<std::pair<std::uint64_t, EventKind>>{
                          {10, EventKind::kObstacleAdded},
                          {20, EventKind::kObstacleMoved},
                          {30, EventKind::kObstacleMoved},
                          {40, EventKind::kObstacleRemoved}}));
  }
  RunFacts alone;
  merge(late, alone);
  EXPECT_EQ(alone.events.size(), 2U) << "what one process says twice is there twice";
}

TEST(Facts, AnObstacleThatAHostHadWhenItHadBeenMovedCameOnce) {
  using sim::EventKind;
  const auto at = [](std::uint64_t step, EventKind kind, std::uint32_t change, const char* place) {
    sim::Event event = obstacle(step, kind, change);
    event.text = place;
    return event;
  };
  // A step of this one fell between its coming and the move.
  RunFacts between;
  between.events = {at(11, EventKind::kObstacleAdded, 1, "here"),
                    at(12, EventKind::kObstacleMoved, 2, "there"),
                    at(30, EventKind::kObstacleRemoved, 3, "")};
  // This one heard of both at once, and sooner.
  RunFacts both;
  both.events = {at(10, EventKind::kObstacleAdded, 2, "there"),
                 at(31, EventKind::kObstacleRemoved, 3, "")};
  // And this one of all three, at the step at which it went.
  RunFacts all;
  all.events = {at(30, EventKind::kObstacleAdded, 3, "there"),
                at(30, EventKind::kObstacleRemoved, 3, "")};
  const std::vector<const RunFacts*> hosts = {&between, &both, &all};
  std::vector<int> order = {0, 1, 2};
  do {
    RunFacts whole;
    for (const int i : order) merge(*hosts[static_cast<std::size_t>(i)], whole);
    std::vector<std::tuple<std::uint64_t, EventKind, std::string>> events;
    for (const sim::Event& e : whole.events) events.emplace_back(e.step, e.kind, e.text);
    EXPECT_EQ(events, (std::vector<std::tuple<std::uint64_t, EventKind, std::string>>{
                          {10, EventKind::kObstacleAdded, "here"},
                          {10, EventKind::kObstacleMoved, "there"},
                          {30, EventKind::kObstacleRemoved, ""}}));
  } while (std::next_permutation(order.begin(), order.end()));
  // Without anybody who knows more, it came as it was seen to come.
  RunFacts little;
  merge(all, little);
  merge(both, little);
  ASSERT_EQ(little.events.size(), 2U);
  EXPECT_EQ(little.events[0].kind, EventKind::kObstacleAdded);
  EXPECT_EQ(little.events[0].step, 10U);
  EXPECT_EQ(little.events[0].detail, 2U);
}

TEST(Facts, OfAHostThatCameBackTheLatterCount) {
  RunFacts whole;
  merge(sample_facts(1), whole);
  RunFacts later = sample_facts(1);
  later.robots[0].commands = 99;
  merge(std::move(later), whole);
  ASSERT_EQ(whole.robots.size(), 1U);
  EXPECT_EQ(whole.robots[0].commands, 99U);
}

}  // namespace
}  // namespace rave::runtime::testing
