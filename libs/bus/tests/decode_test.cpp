// SPDX-License-Identifier: Apache-2.0
// What the deserialiser of the bus does with bytes.
#include <gtest/gtest.h>

#include "rave/bus_testing/sample_messages.hpp"
#include "receive_any.hpp"

namespace rave::bus::testing {
namespace {

std::vector<std::byte> encoded_world(std::uint32_t count) {
  RobotArrays robots(count, 3);
  World world{};
  world.writer = 1;
  world.step = 3;
  robots.lend(world.robots);
  return encode(world);
}

TEST(Decode, AWorldComesBack) {
  const auto bytes = encoded_world(100);
  Decoded<World> decoded;
  ASSERT_TRUE(decoded.decode(bytes));
  EXPECT_EQ(decoded.sample().step, 3U);
  EXPECT_EQ(elements(decoded.sample().robots.x_m)[7], 10.0);
  EXPECT_TRUE(validate(decoded.sample()));
}

TEST(Decode, TenThousandRobotsTakeSixHundredKilobytes) {
  const std::size_t size = encoded_world(10'000).size();
  EXPECT_GT(size, 10'000U * 60);
  EXPECT_LT(size, 10'000U * 60 + 200);
}

TEST(Decode, NoStartOfASampleIsTakenForAWhole) {
  const auto bytes = encoded_world(4);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Decoded<World> decoded;
    EXPECT_FALSE(decoded.decode(std::span(bytes).first(size))) << size;
  }
}

TEST(Decode, ASequenceThatClaimsMoreThanItsBoundIsRefused) {
  RobotArrays robots(rave_wire_kMaxRobots + 1, 0);
  World world{};
  robots.lend(world.robots);
  EXPECT_TRUE(encode(world).empty());

  // A length of 2^32 - 1 behind run, writer, step and time.
  auto bytes = encoded_world(4);
  for (std::size_t i = 40; i < 44; ++i) bytes[i] = std::byte{0xff};
  Decoded<World> decoded;
  EXPECT_FALSE(decoded.decode(bytes));
}

TEST(Decode, AnUnknownKindIsRefused) {
  Command command{};
  command.kind = rave_wire_COMMAND_TEXT;
  auto bytes = encode(command);
  Decoded<Command> text;
  ASSERT_TRUE(text.decode(bytes));
  bytes[28] = std::byte{200};  // Behind run, writer and robot.
  Decoded<Command> unknown;
  EXPECT_FALSE(unknown.decode(bytes));
}

}  // namespace
}  // namespace rave::bus::testing
