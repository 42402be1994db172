// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/pulse.hpp"

#include <gtest/gtest.h>

#include "rave/bus/reader.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::lock_step {
namespace {

TEST(Pulse, SaysAtOnceHowManyRobotsAreRealNow) {
  const bus::testing::TestDomain domain;
  bus::testing::PeerProcess host(domain, "pulse", "host", {}, "peer_lock_step");
  const auto bus = bus::Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  auto reader = bus::Reader<bus::ProcessState>::create(**bus);
  ASSERT_TRUE(reader) << reader.error().text();
  bus::ProcessState last{};
  const auto says = [&](std::uint32_t real) {
    return bus::testing::eventually([&] {
      reader->take([&](const bus::ProcessState& state) { last = state; });
      return last.number > 0 && last.real_robots == real;
    });
  };
  // It speaks once an hour unless something has changed, so each of these is a beat of its own.
  ASSERT_TRUE(bus::testing::eventually([&] { return reader->writers() == 1; }));
  host.poke();
  ASSERT_TRUE(says(0));
  EXPECT_EQ(last.robots, 3U);
  host.poke();
  EXPECT_TRUE(says(1));
  host.poke();
  EXPECT_TRUE(says(2));
  EXPECT_EQ(host.end(), 0);
}

}  // namespace
}  // namespace rave::lock_step
