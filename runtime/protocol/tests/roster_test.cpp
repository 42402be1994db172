// SPDX-License-Identifier: Apache-2.0
// Robots as hosts describe them, through the bytes that others get.
#include "rave/protocol/roster.hpp"

#include <gtest/gtest.h>

#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

namespace rave::lock_step::testing {
namespace {

using bus::testing::Decoded;
using bus::testing::encode;

/// One robot of one type.
sim::EngineSpec one_robot() {
  sim::EngineSpec spec;
  spec.types.emplace_back();
  sim::RobotSpec& robot = spec.robots.emplace_back();
  robot.name = "anna";
  robot.team = "blue";
  return spec;
}

/// As another process gets it; says what is wrong with it.
std::string through(bus::RosterEntry& entry, Decoded<bus::RosterEntry>& decoded) {
  entry.writer = 1;
  if (!decoded.decode(encode(entry))) return "no message";
  const Status status = bus::validate(decoded.sample());
  return status ? "accepted" : status.error().message;
}

TEST(Roster, ARobotIsDescribed) {
  Decoded<bus::RosterEntry> decoded;
  bus::RosterEntry sent = describe(one_robot(), RobotId(0));
  ASSERT_EQ(through(sent, decoded), "accepted");
  const bus::RosterEntry& entry = decoded.sample();
  EXPECT_STREQ(entry.name, "anna");
  EXPECT_STREQ(entry.team, "blue");
  EXPECT_EQ(entry.kind, rave_wire_ROBOT_SIMULATED);
}

TEST(Roster, AHandOverMakesItAnotherRobot) {
  sim::EngineSpec spec = one_robot();
  sim::RobotType& real = spec.types.emplace_back();
  real.simulated = false;
  spec.robots[0].type = 1;
  Decoded<bus::RosterEntry> decoded;
  bus::RosterEntry sent = describe(spec, RobotId(0));
  ASSERT_EQ(through(sent, decoded), "accepted");
  EXPECT_EQ(decoded.sample().kind, rave_wire_ROBOT_REAL);
}

TEST(Roster, WhatTheBusHasNoRoomForIsLeftOut) {
  sim::EngineSpec spec = one_robot();
  spec.robots[0].name = std::string(100, 'n');
  Decoded<bus::RosterEntry> decoded;
  bus::RosterEntry sent = describe(spec, RobotId(0));
  ASSERT_EQ(through(sent, decoded), "accepted");
  EXPECT_EQ(std::string(decoded.sample().name), std::string(64, 'n'));
}

}  // namespace
}  // namespace rave::lock_step::testing
