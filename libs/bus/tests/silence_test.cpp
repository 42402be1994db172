// SPDX-License-Identifier: Apache-2.0
// When silence of others counts, for a bus whose process stood still, and what is heard after it.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "rave/bus/reader.hpp"
#include "rave/bus/standstill.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::bus::testing {
namespace {

TEST(Silence, AStandstillSinceTheLastWaitIsKnownToWhoJudgesSilence) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  static_cast<void>((*bus)->take_events());
  const auto before = std::chrono::steady_clock::now();
  // This is the standstill: as if suspended, nothing waits or looks meanwhile.
  std::this_thread::sleep_for(std::chrono::nanoseconds((*bus)->config().lease.ns));
  EXPECT_GT((*bus)->standstill().silence_counts_from(), before);
}

// A process that forgot it needs to hear again what it said of itself, though DDS repeats nothing.
TEST(Silence, WhatAProcessSaidIsHeardAgainWhenItIsBack) {
  constexpr std::size_t kRobots = 100;
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto roster = Reader<RosterEntry>::create(**bus);
  auto obstacles = Reader<Obstacle>::create(**bus);
  const auto entries = [&] { return roster->take([](const RosterEntry&) {}); };
  PeerProcess lasting(domain, "furnish", "lasting", {"count=" + std::to_string(kRobots)});
  std::size_t heard = 0;
  EXPECT_TRUE(eventually([&] { return (heard += entries()) == kRobots; }));
  PeerProcess peer(domain, "furnish", "sleeper", {"count=" + std::to_string(kRobots)});
  EXPECT_TRUE(eventually([&] { return (heard += entries()) == 2 * kRobots; }));
  std::size_t seen = 0;
  EXPECT_TRUE(
      eventually([&] { return (seen += obstacles->take([](const Obstacle&) {})) == 2 * kRobots; }));
  peer.pause();
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantLost).participant, "sleeper");
  EXPECT_EQ(entries(), 0U);
  peer.resume();
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantAppeared).participant, "sleeper");
  EXPECT_EQ(entries(), kRobots) << "those of the one that is back, and each once";
  EXPECT_EQ(entries(), 0U);
  EXPECT_EQ(obstacles->take([](const Obstacle&) {}), 0U) << "nobody forgets them with their writer";
  EXPECT_EQ(peer.end(), 0);
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantLost).participant, "sleeper");
  EXPECT_EQ(entries(), 0U);
  EXPECT_EQ(lasting.end(), 0);
}

}  // namespace
}  // namespace rave::bus::testing
