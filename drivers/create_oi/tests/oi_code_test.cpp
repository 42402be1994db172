// SPDX-License-Identifier: Apache-2.0
#include "create_oi/oi_code.hpp"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace rave::oi {
namespace {

std::string bytes(std::initializer_list<unsigned> values) {
  std::string text;
  for (const unsigned value : values) text += static_cast<char>(value);
  return text;
}

TEST(OiCode, GroupsHaveTheSizesOfTheSpecification) {
  const std::map<int, std::size_t> sizes{{0, 26}, {1, 10},   {2, 6},    {3, 10},   {4, 14}, {5, 12},
                                         {6, 52}, {100, 80}, {101, 28}, {106, 12}, {107, 9}};
  for (const auto& [id, size] : sizes) {
    EXPECT_EQ(packet_size(static_cast<std::uint8_t>(id)), size) << id;
  }
}

TEST(OiCode, PacketsHaveTheSizesOfTheSpecification) {
  for (const int id : {19, 20, 22, 23, 25, 26, 27, 31, 33, 39, 42, 43, 44, 46, 51, 54, 57}) {
    EXPECT_EQ(packet_size(static_cast<std::uint8_t>(id)), 2U) << id;
  }
  for (const int id : {7, 8, 18, 21, 24, 32, 34, 35, 38, 45, 52, 53, 58}) {
    EXPECT_EQ(packet_size(static_cast<std::uint8_t>(id)), 1U) << id;
  }
  for (const int id : {59, 99, 102, 105, 108, 255}) {
    EXPECT_EQ(packet_size(static_cast<std::uint8_t>(id)), 0U) << id;
  }
}

TEST(OiCode, DriveDirectSendsTheRightWheelFirstAndHighBytesFirst) {
  EXPECT_EQ(drive_direct_command(-200, 258), bytes({145, 0x01, 0x02, 0xff, 0x38}));
  EXPECT_EQ(drive_direct_command(900, -900), bytes({145, 0xfe, 0x0c, 0x01, 0xf4}))
      << "500 mm/s is the limit";
}

TEST(OiCode, OtherCommands) {
  EXPECT_EQ(start_command(), bytes({128}));
  EXPECT_EQ(mode_command(Mode::kSafe), bytes({131}));
  EXPECT_EQ(mode_command(Mode::kFull), bytes({132}));
  EXPECT_EQ(mode_command(Mode::kPassive), bytes({128}));
  EXPECT_EQ(pause_stream_command(), bytes({150, 0}));
  EXPECT_EQ(stream_command(std::vector<std::uint8_t>{29, 13}), bytes({148, 2, 29, 13}));
}

}  // namespace
}  // namespace rave::oi
