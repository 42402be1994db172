// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/standstill.hpp"

#include <gtest/gtest.h>

namespace rave::bus {
namespace {

using std::chrono::milliseconds;

constexpr Standstill::Clock::time_point kStart{std::chrono::hours(1)};

/// A process that looks at given times, and whose machine is never suspended.
class StandstillTest : public ::testing::Test {
 protected:
  void look_at(milliseconds when, Duration waited = {}) {
    standstill_.look(kStart + when, when, waited);
  }
  Standstill standstill_{from_seconds(0.2), from_seconds(3)};
};

TEST_F(StandstillTest, AProcessThatLooksOftenNeverStood) {
  for (int i = 0; i < 50; ++i) look_at(milliseconds(200 * i));
  EXPECT_EQ(standstill_.silence_counts_from(), Standstill::Clock::time_point{});
  EXPECT_EQ(standstill_.stood().ns, 0);
}

TEST_F(StandstillTest, SilenceDuringAGapAndTheGraceAfterItProvesNothing) {
  look_at(milliseconds(0));
  look_at(milliseconds(1500));
  EXPECT_EQ(standstill_.silence_counts_from(), kStart + milliseconds(4500));
  EXPECT_EQ(standstill_.stood(), from_seconds(1.5));
  look_at(milliseconds(1600));
  EXPECT_EQ(standstill_.silence_counts_from(), kStart + milliseconds(4500));
}

TEST_F(StandstillTest, AWaitIsNoGapAndOneThatTookLongerIs) {
  look_at(milliseconds(0));
  look_at(milliseconds(5100), from_seconds(5));
  EXPECT_EQ(standstill_.stood().ns, 0);
  look_at(milliseconds(65'000), Duration{-1});
  EXPECT_EQ(standstill_.stood().ns, 0) << "of a wait without limit nobody knows";
  look_at(milliseconds(65'600), from_seconds(0.1));
  EXPECT_EQ(standstill_.stood(), from_seconds(0.5));
}

TEST_F(StandstillTest, ASuspendedMachineCountsThoughItsClockStood) {
  standstill_.look(kStart, milliseconds(0), {});
  standstill_.look(kStart + milliseconds(10), std::chrono::minutes(5), {});
  EXPECT_EQ(standstill_.stood(), from_seconds(300));
  EXPECT_EQ(standstill_.silence_counts_from(), kStart + milliseconds(3010));
}

}  // namespace
}  // namespace rave::bus
