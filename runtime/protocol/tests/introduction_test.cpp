// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/introduction.hpp"

#include <gtest/gtest.h>

namespace rave::lock_step {
namespace {

const Identity kSelf{0, "one", 1, 7, 9};

std::string refusal(const Identity& other, const Identity& self = kSelf) {
  const Status fits = check_fits(self, introduction(other));
  return fits ? "" : fits.error().message;
}

TEST(Introduction, WhoIsOfTheSameRunFits) {
  EXPECT_EQ(refusal({1, "two", 5, 7, 9}), "");
  EXPECT_EQ(refusal({rave_wire_kNone, "environment manager", 0, 7, 9}), "");
}

TEST(Introduction, WhoIsNotIsToldWhatDiffers) {
  for (const std::uint64_t stamp : {8U, 10U, 0U}) {
    EXPECT_NE(refusal({1, "two", 5, 7, stamp}).find("`two` is another build of RAVE"),
              std::string::npos)
        << stamp;
  }
  for (const std::uint64_t scenario : {6U, 8U, 0U}) {
    EXPECT_NE(refusal({1, "two", 5, scenario, 9}).find("`two` has another scenario"),
              std::string::npos)
        << scenario;
  }
  Identity by_the_wall{1, "two", 5, 7, 9};
  by_the_wall.real_time = true;
  EXPECT_NE(refusal(by_the_wall).find("`two` runs in real time, and this process in lock-step"),
            std::string::npos);
  EXPECT_NE(
      refusal(kSelf, by_the_wall).find("`one` runs in lock-step, and this process in real time"),
      std::string::npos);
  EXPECT_EQ(refusal(by_the_wall, by_the_wall), "");
}

TEST(Introduction, OfTwoTheOneThatStartedFirstStays) {
  bus::HostInfo first = introduction(kSelf);
  bus::HostInfo second = first;
  first.started_ns = 10;
  second.started_ns = 11;
  first.writer = 5;
  second.writer = 4;
  EXPECT_FALSE(gives_way(first, second));
  EXPECT_TRUE(gives_way(second, first));
  second.started_ns = 10;
  EXPECT_TRUE(gives_way(first, second)) << "one of the two, for both the same";
  EXPECT_FALSE(gives_way(second, first));
}

}  // namespace
}  // namespace rave::lock_step
