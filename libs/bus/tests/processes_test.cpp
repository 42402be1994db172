// SPDX-License-Identifier: Apache-2.0
// The bus between processes: who hears whom, and who notices what.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

#include "rave/bus/host_claims.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::bus::testing {
namespace {

/// Packets go to a peer that sends them back; with the text of the first that returns.
std::string round_trip(Bus& bus) {
  auto writer = Writer<Packet>::create(bus);
  auto reader = Reader<Packet>::create(bus);
  std::vector<std::uint8_t> payload(64, 'r');
  std::string returned;
  std::uint64_t number = 0;
  const bool came = eventually([&] {
    // Again and again: what is sent before the other side knows of us is not for it.
    Packet packet{};
    packet.number = ++number;
    packet.from_robot = 3;
    borrow(packet.payload, payload);
    EXPECT_TRUE(writer->write(packet));
    reader->take([&](const Packet& answer) {
      EXPECT_EQ(answer.to_robot, 3U);
      EXPECT_EQ(answer.from_robot, 77U);
      const auto bytes = elements(answer.payload);
      returned.assign(bytes.begin(), bytes.end());
    });
    return !returned.empty();
  });
  return came ? returned : "nothing";
}

TEST(Processes, APacketGoesThereAndBack) {
  const TestDomain domain;
  PeerProcess peer(domain, "echo", "echo");
  ASSERT_EQ(peer.line(), "ready");
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  EXPECT_EQ(round_trip(**bus), std::string(64, 'r'));
  EXPECT_EQ(peer.end(), 0);
}

TEST(Processes, WhoLooksForHubsFindsTheseAloneAndIsFoundByOthers) {
  const TestDomain domain;
  PeerProcess first(domain, "idle", "first", {"reach=hub"});
  PeerProcess second(domain, "idle", "second", {"reach=hub"});
  PeerProcess host(domain, "idle", "host", {"reach=hubs"});
  for (PeerProcess* const peer : {&first, &second, &host}) ASSERT_EQ(peer->line(), "ready");
  BusConfig config = domain.config("another host");
  config.reach = Reach::kHubs;
  const auto ours = Bus::open(config);
  ASSERT_TRUE(ours) << ours.error().text();
  const auto knows = [](Bus& bus, const std::string& name) {
    static_cast<void>(bus.take_events());
    return std::ranges::any_of(bus.processes(),
                               [&](const BusProcess& process) { return process.name == name; });
  };
  EXPECT_TRUE(eventually([&] { return knows(**ours, "first") && knows(**ours, "second"); }));
  config = domain.config("onlooker");
  config.beside = true;
  const auto onlooker = Bus::open(config);
  ASSERT_TRUE(onlooker) << onlooker.error().text();
  EXPECT_TRUE(eventually([&] {
    return knows(**onlooker, "first") && knows(**onlooker, "host") &&
           knows(**onlooker, "another host");
  }));
  EXPECT_FALSE(knows(**ours, "host"));
  EXPECT_EQ(host.end(), 0);
}

TEST(Processes, AStuckReaderHoldsNobodyUpAndHearsAgainLater) {
  const TestDomain domain;
  PeerProcess peer(domain, "echo", "stuck", {"lease_s=600"});
  ASSERT_EQ(peer.line(), "ready");
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto writer = Writer<Packet>::create(**bus);
  auto reader = Reader<Packet>::create(**bus);
  std::uint64_t number = 0;
  std::uint64_t echoed = 0;
  const auto say = [&](std::vector<std::uint8_t>& payload) {
    Packet packet{};
    packet.number = ++number;
    packet.from_robot = 3;
    borrow(packet.payload, payload);
    return writer->write(packet);
  };
  const auto listen = [&] {
    reader->take([&](const Packet& answer) { echoed = std::max(echoed, answer.number); });
  };
  std::vector<std::uint8_t> word(64, 'w');
  ASSERT_TRUE(eventually([&] { return static_cast<void>(say(word)), listen(), echoed > 0; }));

  peer.pause();
  // Ten times what a writer may hold for readers that are to get everything. If it waited half a
  // second for each, the test would not see its end.
  std::vector<std::uint8_t> page(60'000, 'p');
  for (int i = 0; i < 3000; ++i) {
    const Status status = say(page);
    if (!status) {
      ASSERT_EQ(status.error().code, ErrorCode::kTimeout) << status.error().text();
    }
  }

  peer.resume();
  const std::uint64_t last = number;
  EXPECT_TRUE(eventually([&] { return static_cast<void>(say(word)), listen(), echoed > last; }));
  EXPECT_EQ(peer.end(), 0);
}

TEST(Processes, APeerOfAListIsFoundWithoutMulticast) {
  const TestDomain domain;
  PeerProcess peer(domain, "echo", "echo", {"peer=127.0.0.1"});
  ASSERT_EQ(peer.line(), "ready");
  BusConfig config = domain.config();
  config.multicast = Multicast::kNone;
  config.peers = {"localhost"};
  const auto bus = Bus::open(config);
  ASSERT_TRUE(bus) << bus.error().text();
  EXPECT_EQ(round_trip(**bus), std::string(64, 'r'));
}

TEST(Processes, TwoHostsAreBothHeardAlthoughFewSamplesAreKept) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<HostState>::create(**bus);
  PeerProcess first(domain, "host", "one", {"host=1", "count=50"});
  PeerProcess second(domain, "host", "two", {"host=2", "count=50"});
  for (PeerProcess* peer : {&first, &second}) {
    ASSERT_EQ(peer->line(), "ready");
    ASSERT_EQ(peer->line(), "written");
  }
  std::map<std::uint32_t, std::uint64_t> newest;
  EXPECT_TRUE(eventually([&] {
    reader->take([&](const HostState& state) {
      EXPECT_EQ(elements(state.resolved.id).front(), 2 * state.host);
      newest[state.host] = state.step;
    });
    return newest[1] == 50 && newest[2] == 50;
  }));
  EXPECT_EQ((*bus)->refused_samples(), 0U);
}

TEST(Processes, ASecondProcessForAHostIsRefusedUntilTheFirstIsGone) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<HostState>::create(**bus);
  HostClaims claims(2);
  bool claimed = false;
  std::string why;
  const auto listen = [&] {
    reader->take([&](const HostState& state) {
      const Status status = claims.claim(state.host, state.writer);
      claimed = claimed || status.has_value();
      if (status) return;
      why = status.error().message;
      reader->refuse(state, why);
    });
  };
  PeerProcess first(domain, "host", "one", {"host=1", "count=1"});
  ASSERT_EQ(first.line(), "ready");
  ASSERT_TRUE(eventually([&] { return listen(), claimed; }));
  PeerProcess second(domain, "host", "again", {"host=1", "count=1"});
  ASSERT_TRUE(eventually([&] { return listen(), !why.empty(); }));
  EXPECT_NE(why.find("host 1 is already served by process"), std::string::npos) << why;
  EXPECT_EQ(await_event(**bus, EventKind::kRefused).text, why);

  EXPECT_EQ(first.line(), "written");
  EXPECT_EQ(first.end(), 0);
  const BusEvent lost = await_event(**bus, EventKind::kParticipantLost);
  EXPECT_EQ(lost.participant, "one");
  claims.release(lost.writer);
  EXPECT_TRUE(claims.claim(1, lost.writer + 1)) << "the host is free again";
}

TEST(Processes, AKilledProcessIsNoticed) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<HostState>::create(**bus);
  auto waits = WaitSet::create(**bus);
  ASSERT_TRUE(waits->add_events());
  PeerProcess peer(domain, "idle", "victim");
  ASSERT_EQ(peer.line(), "ready");
  const BusEvent appeared = await_event(**bus, EventKind::kWriterAppeared);
  EXPECT_EQ(appeared.participant, "victim");
  EXPECT_EQ(appeared.topic, "rave/host_state");

  const auto start = std::chrono::steady_clock::now();
  peer.kill();
  bool writer_lost = false;
  bool participant_lost = false;
  for (int i = 0; i < 100 && !(writer_lost && participant_lost); ++i) {
    EXPECT_EQ(waits->wait(Duration{kPatience_s * 1'000'000'000LL}), Woken::kReady);
    for (const BusEvent& event : (*bus)->take_events()) {
      EXPECT_EQ(event.participant, "victim") << event.line();
      EXPECT_EQ(event.writer, appeared.writer);
      writer_lost |= event.kind == EventKind::kWriterLost;
      participant_lost |= event.kind == EventKind::kParticipantLost;
    }
  }
  EXPECT_TRUE(writer_lost);
  EXPECT_TRUE(participant_lost);
  // Recorded only: how long it takes depends on what else the machine does.
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  RecordProperty("noticed_after_s", std::to_string(took.count()));
  std::printf("noticed after %.3f s\n", took.count());
}

// If Cyclone DDS forgot a silent process so soon, it could crash: see BusConfig::forget.
TEST(Processes, ASilentProcessIsLostButNotForgottenAndComesBack) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  const auto reader = Reader<Packet>::create(**bus);
  PeerProcess peer(domain, "echo", "sleeper");
  ASSERT_EQ(peer.line(), "ready");
  const BusEvent first = await_event(**bus, EventKind::kWriterAppeared);
  EXPECT_EQ(first.participant, "sleeper");
  peer.pause();
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantLost).writer, first.writer);
  EXPECT_TRUE((*bus)->processes().empty());
  EXPECT_EQ(reader->writers(), 1U) << "DDS still knows it";
  peer.resume();
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantAppeared).writer, first.writer);
  EXPECT_EQ((*bus)->processes().size(), 1U);
  EXPECT_EQ(round_trip(**bus), std::string(64, 'r'));
  EXPECT_EQ(peer.end(), 0);
  EXPECT_EQ(await_event(**bus, EventKind::kParticipantLost).writer, first.writer);
  EXPECT_TRUE(eventually([&] { return reader->writers() == 0; })) << "it said good-bye";
}

TEST(Processes, TwoRunsOnOneMachineDoNotMeet) {
  const TestDomain ours;
  TestDomain theirs = ours;
  theirs.run = RunId::random();
  PeerProcess stranger(theirs, "furnish", "stranger", {"count=3"});
  PeerProcess friendly(ours, "furnish", "friend", {"count=2"});
  ASSERT_EQ(stranger.line(), "ready");
  ASSERT_EQ(friendly.line(), "ready");
  const auto bus = Bus::open(ours.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<Obstacle>::create(**bus);
  // That it is there is known; what it says is not.
  const BusEvent foreign = await_event(**bus, EventKind::kForeignRun);
  EXPECT_EQ(foreign.participant, "stranger");
  EXPECT_NE(foreign.text.find(theirs.run.text()), std::string::npos);
  std::map<std::uint32_t, int> seen;
  EXPECT_TRUE(eventually([&] {
    reader->take([&](const Obstacle& obstacle) { ++seen[obstacle.id]; });
    return seen.size() == 2;
  }));
  EXPECT_EQ(reader->writers(), 1U);
  EXPECT_FALSE(seen.contains(2));
  EXPECT_EQ((*bus)->foreign_samples(), 0U);
}

TEST(Processes, ASampleOfAnotherRunInOurPartitionIsCountedAndDropped) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<World>::create(**bus);
  PeerProcess peer(domain, "stray", "stray");
  ASSERT_EQ(peer.line(), "ready");
  EXPECT_TRUE(eventually([&] {
    reader->take([](const World&) { ADD_FAILURE() << "a sample of another run came through"; });
    return (*bus)->foreign_samples() >= 3;
  }));
  EXPECT_EQ(await_event(**bus, EventKind::kForeignRun).topic, "rave/world");
}

TEST(Processes, AWorldOfTenThousandRobotsArrivesWhole) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<World>::create(**bus);
  PeerProcess peer(domain, "world", "authority", {"robots=10000"});
  ASSERT_EQ(peer.line(), "ready");
  int worlds = 0;
  EXPECT_TRUE(eventually([&] {
    reader->take([&](const World& world) {
      ++worlds;
      const auto x = elements(world.robots.x_m);
      const auto wz = elements(world.robots.wz_radps);
      ASSERT_EQ(x.size(), 10'000U);
      for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_EQ(x[i], static_cast<double>(i + world.step));
        ASSERT_EQ(wz[i], 0.25);
      }
    });
    return worlds >= 5;
  }));
  EXPECT_EQ((*bus)->refused_samples(), 0U);
  EXPECT_EQ(peer.end(), 0);
}

TEST(Processes, ABadPoseIsRefusedWithItsPlace) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<World>::create(**bus);
  PeerProcess peer(domain, "world", "broken", {"robots=3", "nan=1"});
  ASSERT_EQ(peer.line(), "ready");
  EXPECT_TRUE(eventually([&] {
    reader->take([](const World&) { ADD_FAILURE() << "a robot that is nowhere came through"; });
    return (*bus)->refused_samples() > 0;
  }));
  EXPECT_EQ(await_event(**bus, EventKind::kRefused).text,
            "robots.x_m[1] is nan, not within +-10000000");
}

TEST(Processes, AWriterThatDoesNotMatchIsToldWithTheRemedy) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  const auto reader = Reader<World>::create(**bus);
  PeerProcess peer(domain, "unreliable", "lossy");
  ASSERT_EQ(peer.line(), "ready");
  const BusEvent event = await_event(**bus, EventKind::kIncompatible);
  EXPECT_EQ(event.topic, "rave/world");
  EXPECT_NE(event.text.find("reliability does not match; make the writer reliable"),
            std::string::npos)
      << event.text;
}

TEST(Processes, AProcessHasOneBusInADomain) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  const auto second = Bus::open(domain.config());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kState);
  EXPECT_NE(second.error().message.find("has a bus in domain"), std::string::npos);
}

TEST(Processes, BusesBesideTakeNoNumberFromOthers) {
  const TestDomain domain;
  BusConfig beside = domain.config("driver");
  beside.beside = true;
  const auto first = Bus::open(beside);
  const auto second = Bus::open(beside);
  ASSERT_TRUE(first) << first.error().text();
  ASSERT_TRUE(second) << second.error().text();
  // They are in one domain, as two processes would be.
  EXPECT_EQ(await_event(**second, EventKind::kParticipantAppeared).participant, "driver");
  for (const std::uint32_t number : {domain.domain, 230U, 229U}) {
    BusConfig other = domain.config("host");
    other.domain = number;
    const auto bus = Bus::open(other);
    EXPECT_TRUE(bus) << number << ": " << bus.error().text();
  }
}

TEST(Processes, ASampleThatIsTooLongIsNotSent) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto writer = Writer<Packet>::create(**bus);
  std::vector<std::uint8_t> payload(70'000);
  Packet packet{};
  borrow(packet.payload, payload);
  const Status status = writer->write(packet);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE(status.error().message.starts_with("rave/radio: the sample cannot be sent"));
  payload.resize(10);
  borrow(packet.payload, payload);
  EXPECT_TRUE(writer->write(packet));
}

TEST(Processes, AnInterfaceThatIsNotThereIsNamed) {
  BusConfig config = TestDomain().config();
  config.interface = "nosuch0";
  config.multicast = Multicast::kData;
  const auto bus = Bus::open(config);
  ASSERT_FALSE(bus);
  EXPECT_NE(bus.error().message.find("nosuch0: does not match an available interface"),
            std::string::npos)
      << bus.error().message;
}

}  // namespace
}  // namespace rave::bus::testing
