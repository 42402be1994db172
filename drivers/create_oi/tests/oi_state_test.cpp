// SPDX-License-Identifier: Apache-2.0
#include "create_oi/oi_state.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rave::oi {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(OiState, BitsOfPacketSeven) {
  for (unsigned bits = 0; bits < 16; ++bits) {
    OiState state;
    ASSERT_TRUE(read_packets(Bytes{7, static_cast<std::uint8_t>(bits)}, state));
    EXPECT_EQ(state.bump_right, (bits & 1U) != 0);
    EXPECT_EQ(state.bump_left, (bits & 2U) != 0);
    EXPECT_EQ(state.drop_right, (bits & 4U) != 0);
    EXPECT_EQ(state.drop_left, (bits & 8U) != 0);
    EXPECT_EQ(state.any_drop(), bits >= 4);
  }
}

TEST(OiState, WordsAndSigns) {
  OiState state;
  ASSERT_TRUE(read_packets(Bytes{22, 0x3f, 0x10, 23, 0xfe, 0x0c, 24,   0xfb, 25, 0x08, 0x98,
                                 26, 0x0a, 0x88, 35, 2,    43,   0xff, 0xff, 44, 0x80, 0x00},
                           state));
  EXPECT_EQ(state.voltage_mv, 16144);
  EXPECT_EQ(state.current_ma, -500);
  EXPECT_EQ(state.temperature_c, -5);
  EXPECT_EQ(state.charge_mah, 2200);
  EXPECT_EQ(state.capacity_mah, 2696);
  EXPECT_EQ(state.mode, Mode::kSafe);
  EXPECT_EQ(state.left_counts, 65535);
  EXPECT_EQ(state.right_counts, 32768);
}

TEST(OiState, EachCliffHasItsPlace) {
  OiState state;
  ASSERT_TRUE(read_packets(Bytes{9, 0, 10, 1, 11, 0, 12, 1, 21, 3}, state));
  EXPECT_FALSE(state.cliff_left);
  EXPECT_TRUE(state.cliff_front_left);
  EXPECT_FALSE(state.cliff_front_right);
  EXPECT_TRUE(state.cliff_right);
  EXPECT_TRUE(state.any_cliff());
  EXPECT_EQ(state.charging_state, 3);
}

TEST(OiState, PassesOverWhatItDoesNotKeepAndRefusesWhatEndsEarly) {
  OiState state;
  EXPECT_TRUE(read_packets(Bytes{19, 1, 2, 35, 3}, state));
  EXPECT_EQ(state.mode, Mode::kFull);
  EXPECT_FALSE(read_packets(Bytes{22, 1}, state));
  EXPECT_FALSE(read_packets(Bytes{59, 1}, state));
  EXPECT_TRUE(read_packets(Bytes{}, state));
}

}  // namespace
}  // namespace rave::oi
