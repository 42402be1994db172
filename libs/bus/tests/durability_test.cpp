// SPDX-License-Identifier: Apache-2.0
// Who comes late has all that is there.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::bus::testing {
namespace {

TEST(Durability, ALateReaderHasAllFiveObstaclesAndRobotsNotOne) {
  const TestDomain domain;
  PeerProcess peer(domain, "furnish", "early", {"count=5"});
  ASSERT_EQ(peer.line(), "ready");
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto obstacles = Reader<Obstacle>::create(**bus);
  auto roster = Reader<RosterEntry>::create(**bus);
  std::set<std::string> boxes;
  std::set<std::string> robots;
  EXPECT_TRUE(eventually([&] {
    obstacles->take([&](const Obstacle& obstacle) {
      EXPECT_EQ(elements(elements(obstacle.stands.shapes).front().x_m).size(), 4U);
      boxes.insert(obstacle.stands.name);
    });
    roster->take([&](const RosterEntry& entry) { robots.insert(entry.name); });
    return boxes.size() >= 5 && robots.size() >= 5;
  }));
  EXPECT_EQ(boxes, (std::set<std::string>{"box0", "box1", "box2", "box3", "box4"}));
  EXPECT_EQ(robots, (std::set<std::string>{"robot0", "robot1", "robot2", "robot3", "robot4"}));
}

TEST(Durability, AnObstacleGoesWhenItIsTakenAwayAndNotWhenItsWriterEnds) {
  const TestDomain domain;
  PeerProcess peer(domain, "furnish", "early", {"count=3"});
  ASSERT_EQ(peer.line(), "ready");
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto obstacles = Reader<Obstacle>::create(**bus);
  std::set<std::uint32_t> there;
  std::set<std::uint32_t> gone;
  const auto listen = [&] {
    obstacles->take([&](const Obstacle& obstacle) { there.insert(obstacle.id); },
                    [&](const Obstacle& obstacle) { gone.insert(obstacle.id); });
  };
  EXPECT_TRUE(eventually([&] { return listen(), there.size() == 3; }));
  peer.poke();
  EXPECT_EQ(peer.line(), "disposed");
  EXPECT_TRUE(eventually([&] { return listen(), !gone.empty(); }));
  EXPECT_EQ(peer.end(), 0);
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantLost).participant, "early");
  listen();
  EXPECT_EQ(gone, (std::set<std::uint32_t>{0}));
}

TEST(Durability, AnObstacleThatWentBeforeItWasLookedAtIsGone) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto obstacles = Reader<Obstacle>::create(**bus);
  PeerProcess peer(domain, "furnish", "early", {"count=3"});
  ASSERT_EQ(peer.line(), "ready");
  // They come, and are left where they are.
  auto waits = WaitSet::create(**bus);
  ASSERT_TRUE(waits->add(*obstacles));
  ASSERT_EQ(waits->wait(Duration{kPatience_s * 1'000'000'000LL}), Woken::kReady);
  peer.poke();
  ASSERT_EQ(peer.line(), "disposed");
  EXPECT_EQ(peer.end(), 0);
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantLost).participant, "early");
  std::set<std::uint32_t> there;
  obstacles->take([&](const Obstacle& obstacle) { there.insert(obstacle.id); },
                  [&](const Obstacle& obstacle) { there.erase(obstacle.id); });
  EXPECT_EQ(there, (std::set<std::uint32_t>{1, 2}));
}

}  // namespace
}  // namespace rave::bus::testing
