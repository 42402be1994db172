// SPDX-License-Identifier: Apache-2.0
// When silence of others counts, for a bus whose process stood still.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

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

}  // namespace
}  // namespace rave::bus::testing
