// SPDX-License-Identifier: Apache-2.0
// Who speaks in the name of another process, and how much is told of other runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::bus::testing {
namespace {

/// A second bus of this process, as that of another one would be.
class Impostor {
 public:
  explicit Impostor(const TestDomain& domain) {
    BusConfig config = domain.config("impostor");
    config.beside = true;
    auto bus = Bus::open(config);
    EXPECT_TRUE(bus) << bus.error().text();
    bus_ = *std::move(bus);
    states_.emplace(*Writer<HostState>::create(*bus_));
  }
  /// The bus would sign it with its own name.
  void say(const TestDomain& domain, std::uint64_t name, std::uint64_t step) {
    HostState state{};
    std::ranges::copy(domain.run.bytes, state.run);
    state.writer = name;
    state.step = step;
    EXPECT_EQ(dds_write(states_->handle(), &state), DDS_RETCODE_OK);
  }
  [[nodiscard]] std::uint64_t name() const { return bus_->writer(); }

 private:
  std::unique_ptr<Bus> bus_;
  std::optional<Writer<HostState>> states_;
};

TEST(Impostor, WhatIsSentInTheNameOfAProcessThatIsThereIsRefused) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = Reader<HostState>::create(**bus);
  PeerProcess victim(domain, "idle", "victim");
  ASSERT_EQ(victim.line(), "ready");
  const BusEvent appeared = await_event(**bus, EventKind::kParticipantAppeared);
  ASSERT_EQ(appeared.participant, "victim");
  Impostor impostor(domain);
  std::uint64_t step = 0;
  std::uint64_t own = 0;
  const auto listen = [&] {
    reader->take([&](const HostState& state) {
      EXPECT_EQ(state.writer, impostor.name()) << "came through in the name of another process";
      own = state.step;
    });
  };
  ASSERT_TRUE(eventually([&] {
    impostor.say(domain, appeared.writer, ++step);
    impostor.say(domain, impostor.name(), step);
    listen();
    return (*bus)->refused_samples() >= 3;
  }));
  const BusEvent refused = await_event(**bus, EventKind::kRefused);
  EXPECT_EQ(refused.writer, appeared.writer);
  EXPECT_EQ(refused.text, "another process sent it in the name of this process");
  // In its own name it is heard.
  EXPECT_TRUE(eventually([&] {
    listen();
    return own > 0;
  }));
}

TEST(Impostor, ARunWithManyProcessesIsToldOnce) {
  const TestDomain ours;
  TestDomain theirs = ours;
  theirs.run = RunId::random();
  const auto bus = Bus::open(ours.config());
  ASSERT_TRUE(bus) << bus.error().text();
  std::vector<std::unique_ptr<PeerProcess>> strangers;
  for (const char* const name : {"one", "two", "three"}) {
    strangers.push_back(std::make_unique<PeerProcess>(theirs, "idle", name));
    ASSERT_EQ(strangers.back()->line(), "ready");
  }
  int told = 0;
  EXPECT_TRUE(eventually([&] {
    for (const BusEvent& event : (*bus)->take_events()) {
      told += event.kind == EventKind::kForeignRun ? 1 : 0;
    }
    return (*bus)->processes().size() == strangers.size();
  }));
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace rave::bus::testing
