// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stop_token>
#include <thread>

#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::bus::testing {
namespace {

TEST(Waits, AWaitEndsByTimeAndByStop) {
  const TestDomain domain;
  const auto bus = Bus::open(domain.config());
  ASSERT_TRUE(bus) << bus.error().text();
  const auto reader = Reader<World>::create(**bus);
  auto waits = WaitSet::create(**bus);
  ASSERT_TRUE(waits->add(*reader));
  EXPECT_EQ(waits->wait(Duration{1'000'000}), Woken::kTimeout);
  std::stop_source stop;
  std::jthread other([&] { stop.request_stop(); });
  EXPECT_EQ(waits->wait(Duration{-1}, stop.get_token()), Woken::kStopped);
  EXPECT_EQ(waits->wait(Duration{-1}, stop.get_token()), Woken::kStopped);
  EXPECT_EQ(waits->wait(Duration{0}), Woken::kTimeout);
}

}  // namespace
}  // namespace rave::bus::testing
