// SPDX-License-Identifier: Apache-2.0
// Robots as hosts describe them, through the bytes that others get.
#include "rave/protocol/roster.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

namespace rave::lock_step::testing {
namespace {

using bus::elements;
using bus::testing::Decoded;
using bus::testing::encode;

/// One robot of one type, with a disc and a box as its body and a laser on it.
sim::EngineSpec one_robot() {
  sim::EngineSpec spec;
  sim::RobotType& type = spec.types.emplace_back();
  sim::SensorSpec& laser = type.sensors.emplace_back();
  laser.name = "front";
  laser.driver = "virtual_laser";
  laser.X_RS = {0.1, -0.2, 0.3};
  laser.z_m = 0.4;
  sim::RobotSpec& robot = spec.robots.emplace_back();
  robot.name = "anna";
  robot.team = "blue";
  world::Body& body = spec.world.robots.emplace_back();
  body.shapes.push_back(world::make_disc({1, 2}, 0.5, 0, 0.2).value());
  const std::vector<Vec2> box = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto prisms = world::make_prisms(box, 0.1, 1e300);
  for (const world::Shape& shape : prisms.value()) body.shapes.push_back(shape);
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
  RobotDescription description;
  Decoded<bus::RosterEntry> decoded;
  const sim::EngineSpec spec = one_robot();
  ASSERT_EQ(through(description.fill(spec, RobotId(0), {{"program.speed_mps", "0.5"}}), decoded),
            "accepted");
  const bus::RosterEntry& entry = decoded.sample();
  EXPECT_STREQ(entry.name, "anna");
  EXPECT_STREQ(entry.team, "blue");
  EXPECT_EQ(entry.kind, rave_wire_ROBOT_SIMULATED);
  EXPECT_EQ(entry.leader, rave_wire_kNone);
  const auto sensors = elements(entry.sensors);
  ASSERT_EQ(sensors.size(), 1U);
  EXPECT_STREQ(sensors[0].name, "front");
  EXPECT_STREQ(sensors[0].type, "virtual_laser");
  EXPECT_EQ(sensors[0].y_m, -0.2);
  EXPECT_EQ(sensors[0].z_m, 0.4);
  EXPECT_EQ(sensors[0].yaw_rad, 0.3);
  const auto parameters = elements(entry.parameters);
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_STREQ(parameters[0].name, "program.speed_mps");
  EXPECT_STREQ(parameters[0].value, "0.5");
}

TEST(Roster, ADiscIsThePolygonAboutIt) {
  RobotDescription description;
  Decoded<bus::RosterEntry> decoded;
  ASSERT_EQ(through(description.fill(one_robot(), RobotId(0), {}), decoded), "accepted");
  const auto prisms = elements(decoded.sample().body);
  ASSERT_EQ(prisms.size(), 2U);
  const auto x_m = elements(prisms[0].x_m);
  const auto y_m = elements(prisms[0].y_m);
  ASSERT_EQ(x_m.size(), 16U);
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    const std::size_t next = (i + 1) % x_m.size();
    const double middle_m = std::hypot((x_m[i] + x_m[next]) / 2 - 1, (y_m[i] + y_m[next]) / 2 - 2);
    EXPECT_NEAR(middle_m, 0.5, 1e-12) << "each side touches the disc";
  }
  EXPECT_EQ(prisms[1].x_m._length, 4U);
  EXPECT_EQ(prisms[1].z_min_m, 0.1);
  EXPECT_EQ(prisms[1].z_max_m, bus::kMaxPosition_m);
}

TEST(Roster, AHandOverMakesItAnotherRobot) {
  sim::EngineSpec spec = one_robot();
  sim::RobotType& real = spec.types.emplace_back();
  real.simulated = false;
  spec.robots[0].type = 1;
  RobotDescription description;
  Decoded<bus::RosterEntry> decoded;
  ASSERT_EQ(through(description.fill(spec, RobotId(0), {}), decoded), "accepted");
  EXPECT_EQ(decoded.sample().kind, rave_wire_ROBOT_REAL);
  EXPECT_EQ(decoded.sample().sensors._length, 0U);
}

TEST(Roster, WhatTheBusHasNoRoomForIsLeftOut) {
  sim::EngineSpec spec = one_robot();
  spec.robots[0].name = std::string(100, 'n');
  spec.types[0].sensors.resize(100);
  for (sim::SensorSpec& sensor : spec.types[0].sensors) sensor.name = sensor.driver = "laser";
  spec.world.robots[0].shapes.assign(100, spec.world.robots[0].shapes[0]);
  const NamedValues values(500, {std::string(300, 'p'), "two\nlines" + std::string(300, 'v')});
  RobotDescription description;
  Decoded<bus::RosterEntry> decoded;
  ASSERT_EQ(through(description.fill(spec, RobotId(0), values), decoded), "accepted");
  const bus::RosterEntry& entry = decoded.sample();
  EXPECT_EQ(std::string(entry.name), std::string(64, 'n'));
  EXPECT_EQ(entry.sensors._length, 64U);
  EXPECT_EQ(entry.body._length, 64U);
  EXPECT_EQ(entry.parameters._length, 256U);
  EXPECT_TRUE(std::string(elements(entry.parameters)[0].value).starts_with("two linesvv"));
}

}  // namespace
}  // namespace rave::lock_step::testing
