// SPDX-License-Identifier: Apache-2.0
// Robots and messages in real time through the bytes that other processes get.
#include "rave/protocol/live_messages.hpp"

#include <gtest/gtest.h>

#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

namespace rave::real_time {
namespace {

using bus::testing::Decoded;
using bus::testing::encode;

TEST(RobotColumns, ComeBackWithTheirVelocitiesAndTheStampsOfTheOtherClock) {
  RobotColumns columns;
  const RobotSight sights[] = {{RobotId(3), SimTime{1'000}, {1, -2, 3.0}, {0.5, -0.25, 2}},
                               {RobotId(8), SimTime{2'000}, {4, 5, -0.5}, {0, 0, 0}}};
  for (const RobotSight& sight : sights) columns.add(sight);
  bus::World world{};
  world.writer = 1;
  columns.lend(world.robots);
  Decoded<bus::World> decoded;
  ASSERT_TRUE(decoded.decode(encode(world)));
  ASSERT_TRUE(bus::validate(decoded.sample()));
  // In the message the velocity is that over ground, for who looks on.
  EXPECT_NEAR(decoded.sample().robots.vx_mps._buffer[0], 0.5 * std::cos(3.0) + 0.25 * std::sin(3.0),
              1e-12);
  for (std::size_t i = 0; i < 2; ++i) {
    const RobotSight read = read_robot(decoded.sample().robots, i, Duration{-300});
    EXPECT_EQ(read.robot, sights[i].robot);
    EXPECT_EQ(read.stamp.ns, sights[i].stamp.ns - 300);
    EXPECT_EQ(read.X_WR.x, sights[i].X_WR.x);
    EXPECT_EQ(read.X_WR.yaw, sights[i].X_WR.yaw);
    EXPECT_NEAR(read.velocity.vx, sights[i].velocity.vx, 1e-12);
    EXPECT_NEAR(read.velocity.vy, sights[i].velocity.vy, 1e-12);
    EXPECT_EQ(read.velocity.wz, sights[i].velocity.wz);
  }
  columns.clear();
  EXPECT_EQ(columns.size(), 0U);
}

TEST(Packets, ComeBackWithAllThatAReceiverMustKnow) {
  sim::SentPacket sent;
  sent.robot = RobotId(4);
  sent.communicator = 2;
  sent.sequence = 77;
  sent.to = Recipient::one(9);
  sent.stamp_ns = 5'000;
  sent.x_m = 1.5;
  sent.y_m = -2.5;
  sent.range_m = 3;
  sent.antenna_z_m = 0.4;
  sent.located = 1;
  sent.line_of_sight = 1;
  const std::vector<std::byte> bytes = {std::byte{1}, std::byte{2}, std::byte{255}};
  bus::Packet packet = packet_of(sent, bytes, 12, Duration{100});
  packet.writer = 1;
  Decoded<bus::Packet> decoded;
  ASSERT_TRUE(decoded.decode(encode(packet)));
  ASSERT_TRUE(bus::validate(decoded.sample()));
  EXPECT_EQ(decoded.sample().number, 12U);
  EXPECT_EQ(decoded.sample().sent_ns, 5'100);
  const sim::SentPacket read = read_packet(decoded.sample(), Duration{-100});
  EXPECT_EQ(read.robot, sent.robot);
  EXPECT_EQ(read.communicator, 2U);
  EXPECT_EQ(read.sequence, 77U);
  EXPECT_EQ(read.to, sent.to);
  EXPECT_EQ(read.stamp_ns, 5'000);
  EXPECT_EQ(read.x_m, 1.5);
  EXPECT_EQ(read.y_m, -2.5);
  EXPECT_EQ(read.range_m, 3);
  EXPECT_EQ(read.antenna_z_m, 0.4);
  EXPECT_EQ(read.located, 1);
  EXPECT_EQ(read.line_of_sight, 1);
  const auto payload = payload_of(decoded.sample());
  EXPECT_TRUE(std::equal(payload.begin(), payload.end(), bytes.begin(), bytes.end()));
}

}  // namespace
}  // namespace rave::real_time
