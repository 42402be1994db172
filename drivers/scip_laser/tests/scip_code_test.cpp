// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_code.hpp"

#include <gtest/gtest.h>

namespace rave::scip {
namespace {

TEST(Code, ChecksumsOfTheSpecification) {
  EXPECT_EQ(checksum("00"), 'P');
  EXPECT_EQ(checksum("99"), 'b');
  EXPECT_EQ(checksum("AMIN:44"), '7');
  EXPECT_EQ(checksum("DMAX:5600"), '_');
  EXPECT_EQ(checksum("ARES:1024"), '\\');
}

TEST(Code, NumbersOfTwoThreeAndFourCharacters) {
  EXPECT_EQ(decode("CB"), 1234U);          // 0x43 - 0x30 = 19, 0x42 - 0x30 = 18: 19 * 64 + 18
  EXPECT_EQ(decode("1Dh"), 5432U);         // 1, 20, 56: (1 * 64 + 20) * 64 + 56
  EXPECT_EQ(decode("m2@0"), 16'000'000U);  // 61, 2, 16, 0
  EXPECT_EQ(decode("0000"), 0U);
  EXPECT_EQ(decode("oooo"), 0xffffffU);
  EXPECT_FALSE(decode("0/0"));
  EXPECT_FALSE(decode("0p0"));
  EXPECT_FALSE(decode("\xff\xff"));
}

TEST(UnwrappedTime, GoesOnOverTheTurn) {
  UnwrappedTime time;
  EXPECT_DOUBLE_EQ(time.seconds(0xffffff), 16777.215);
  EXPECT_DOUBLE_EQ(time.seconds(99), 16777.315);
  EXPECT_DOUBLE_EQ(time.seconds(199), 16777.415);
}

TEST(UnwrappedTime, ALittleBackIsBack) {
  UnwrappedTime time;
  EXPECT_DOUBLE_EQ(time.seconds(10'000), 10);
  EXPECT_DOUBLE_EQ(time.seconds(9'900), 9.9);
  EXPECT_DOUBLE_EQ(time.seconds(10'000), 10);
  time.reset();
  EXPECT_DOUBLE_EQ(time.seconds(3), 0.003);
}

}  // namespace
}  // namespace rave::scip
