// SPDX-License-Identifier: Apache-2.0
// Reports and worlds through the bytes that other processes get.
#include "rave/bus_testing/messages.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "example_messages.hpp"
#include "rave/bus/validate.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::lock_step::testing {
namespace {

using bus::testing::Decoded;
using bus::testing::encode;

/// Messages as text, so that a difference can be read; every bit of a double counts.
std::string bits(double value) {
  return fmt::format("{}({:x}) ", value, std::bit_cast<std::uint64_t>(value));
}

void put(std::string& text, const std::vector<sim::PoseReport>& poses) {
  for (const sim::PoseReport& pose : poses) {
    const sim::ReportedPose& r = pose.reported;
    text += fmt::format("pose {} {} {} {} ", pose.robot.value(), r.stamp.ns, r.known, r.stale);
    for (const double value :
         {r.pose.x_m, r.pose.y_m, r.pose.yaw_rad, r.pose.variance_xy_m2, r.pose.variance_yaw_rad2,
          r.velocity.vx, r.velocity.vy, r.velocity.wz}) {
      text += bits(value);
    }
  }
}

void put(std::string& text, const std::vector<sim::PoseSample>& samples) {
  for (const sim::PoseSample& sample : samples) {
    text += fmt::format("sample {} {} ", sample.robot.value(), sample.stamp.ns) +
            bits(sample.X_WR.x) + bits(sample.X_WR.y) + bits(sample.X_WR.yaw);
  }
}

void put(std::string& text, const sim::SentPackets& sent) {
  for (const sim::SentPacket& p : sent.packets) {
    text += fmt::format("packet {} {} {} {} {} {} {} {} {} {} {} ", p.robot.value(), p.communicator,
                        p.sequence, static_cast<int>(p.to.kind), p.to.robot, p.stamp_ns,
                        p.complete_ns, p.located, p.line_of_sight, p.first_byte, p.size);
    for (const double value : {p.x_m, p.y_m, p.range_m, p.antenna_z_m}) text += bits(value);
    for (const std::byte byte : sent.bytes_of(p))
      text += fmt::format("{:x}", std::to_integer<int>(byte));
  }
}

void put(std::string& text, const std::vector<double>& column) {
  for (const double value : column) text += bits(value);
  text += "| ";
}

void put(std::string& text, const std::vector<sim::ObstacleChange>& changes) {
  for (const sim::ObstacleChange& c : changes) {
    text += fmt::format("obstacle {} {} {} {} {} {} ", static_cast<int>(c.kind), c.id.value(),
                        c.name, c.asked, c.body.colour, c.body.shapes.size()) +
            bits(c.X_WB.x) + bits(c.X_WB.y) + bits(c.X_WB.yaw);
  }
}

void put(std::string& text, const std::vector<sim::InputRefusal>& refusals) {
  for (const sim::InputRefusal& refusal : refusals) {
    text += fmt::format("refusal {} {} ", refusal.sequence, refusal.text);
  }
}

void put(std::string& text, const std::vector<sim::WorldInput>& inputs) {
  for (const sim::WorldInput& input : inputs) {
    text += fmt::format("input {} {} {} {} {} ", input.sequence, input.action.index(),
                        input.author.by_hand, input.author.name, input.robot.value());
    if (const auto* const given = input.as<request::Order>()) {
      const request::OrderParts order = request::parts_of(*given);
      text += fmt::format("order {} ", given->index());
      for (const Vec2 p_W : order.points_W) text += bits(p_W.x) + bits(p_W.y);
      text += order.yaw_rad ? bits(*order.yaw_rad) : "none ";
      text += bits(order.v_mps) + bits(order.w_radps) + bits(order.speed_mps);
      text += order.text;
    }
    const auto* const changed = input.as<sim::Change>();
    if (changed == nullptr) continue;
    for (const sim::ParameterChange& change : changed->changes) {
      text += fmt::format("{} {} {} {} ", static_cast<int>(change.part), change.index, change.name,
                          sim::to_string(change.value));
    }
  }
}

std::string text_of(const sim::HostReport& report) {
  std::string text = fmt::format("{} {} {} {} ", report.host, report.step,
                                 static_cast<int>(report.state), report.text);
  for (const std::uint32_t robot : report.proposals.robots) text += fmt::format("{} ", robot);
  put(text, report.proposals.vx_mps);
  put(text, report.proposals.vy_mps);
  put(text, report.proposals.wz_radps);
  put(text, report.sent);
  put(text, report.poses);
  put(text, report.samples);
  put(text, report.refusals);
  put(text, report.inputs);
  return text;
}

std::string text_of(const sim::WorldStep& world) {
  std::string text = fmt::format("{} {} ", world.step, world.last);
  for (const auto* const column :
       {&world.x_m, &world.y_m, &world.yaw_rad, &world.vx_mps, &world.vy_mps, &world.wz_radps}) {
    put(text, *column);
  }
  for (const std::uint8_t flags : world.flags) text += fmt::format("{} ", flags);
  for (const sim::PushedRobot& robot : world.pushed) {
    text += fmt::format("pushed {} ", robot.robot.value()) + bits(robot.X_WR.x) +
            bits(robot.X_WR.y) + bits(robot.X_WR.yaw);
  }
  for (const sim::TouchPoint& point : world.touches) {
    text += fmt::format("touch {} ", point.robot.value()) + bits(point.direction_W.x) +
            bits(point.direction_W.y);
  }
  for (const sim::ResizedRobot& robot : world.resized) {
    text += fmt::format("resized {} {} ", robot.robot.value(), robot.by) + bits(robot.scale);
  }
  put(text, world.poses);
  put(text, world.samples);
  put(text, world.sent);
  put(text, world.obstacles);
  put(text, world.inputs);
  for (const sim::InputAnswer& answer : world.answers) {
    text += fmt::format("answer {} {} {} ", answer.host, answer.asked, answer.sequence);
  }
  put(text, world.refusals);
  return text;
}

std::string text_of(const sim::AuthorityState& state) {
  std::string text = fmt::format("{:x} {} {} {} ", state.hash.value(), state.inputs,
                                 state.obstacle_changes, state.refused_count);
  for (const sim::Event& event : state.refused) {
    text += fmt::format("{} {} {} ", event.step, event.robot.value(), event.text);
  }
  put(text, state.obstacles);
  for (const sim::Event& event : state.events) {
    text += fmt::format("event {} {} {} {} ", event.step, event.robot.value(),
                        static_cast<int>(event.kind), event.other.value());
  }
  for (const sim::Event& event : state.done) {
    text += fmt::format("done {} {} {} {} {} ", event.step, event.robot.value(),
                        static_cast<int>(event.kind), event.other.value(), event.text);
  }
  for (const RobotId robot : state.pinned) text += fmt::format("pinned {} ", robot.value());
  for (const sim::ResizedRobot& robot : state.scales) {
    text += fmt::format("scale {} ", robot.robot.value()) + bits(robot.scale);
  }
  return text;
}

TEST(Messages, AReportComesThroughToTheBit) {
  const sim::HostReport report = example_report();
  ReportMessage message;
  Decoded<bus::HostReport> decoded;
  bus::HostReport& wire = message.fill(report, 6, 77);
  wire.writer = 1;
  ASSERT_TRUE(decoded.decode(encode(wire)));
  const Status valid = bus::validate(decoded.sample());
  ASSERT_TRUE(valid) << valid.error().message;
  EXPECT_EQ(decoded.sample().epoch, 6U);
  EXPECT_EQ(decoded.sample().hash, 77U);
  sim::HostReport again = example_report();  // what was there before leaves no trace
  const Status was_read = read(decoded.sample(), again);
  ASSERT_TRUE(was_read) << was_read.error().message;
  EXPECT_EQ(text_of(again), text_of(report));
}

TEST(Messages, AWorldComesThroughToTheBit) {
  const sim::WorldStep world = example_world();
  WorldMessage message;
  auto wire = message.fill(world, example_authority(), 9);
  ASSERT_TRUE(wire) << wire.error().message;
  (*wire)->writer = 1;
  Decoded<bus::WorldStep> decoded;
  ASSERT_TRUE(decoded.decode(encode(static_cast<const bus::WorldStep&>(**wire))));
  const Status valid = bus::validate(decoded.sample());
  ASSERT_TRUE(valid) << valid.error().message;
  EXPECT_EQ(decoded.sample().epoch, 9U);
  sim::WorldStep again = example_world();
  sim::AuthorityState authority = example_authority();
  const Status was_read = read(decoded.sample(), again, authority);
  ASSERT_TRUE(was_read) << was_read.error().message;
  EXPECT_EQ(text_of(again), text_of(world));
  EXPECT_EQ(text_of(authority), text_of(example_authority()));
}

TEST(Messages, TheSecondFillLeavesNothingOfTheFirst) {
  WorldMessage message;
  ASSERT_TRUE(message.fill(example_world(), example_authority(), 9));
  sim::WorldStep small;
  small.begin(2, 1);
  auto wire = message.fill(small, {}, 9);
  ASSERT_TRUE(wire);
  (*wire)->writer = 1;
  Decoded<bus::WorldStep> decoded;
  ASSERT_TRUE(decoded.decode(encode(static_cast<const bus::WorldStep&>(**wire))));
  sim::WorldStep again;
  sim::AuthorityState authority;
  ASSERT_TRUE(read(decoded.sample(), again, authority));
  EXPECT_EQ(text_of(again), text_of(small));
  EXPECT_EQ(text_of(authority), text_of(sim::AuthorityState{}));
}

TEST(Messages, WhatTheBusCannotCarryIsRefusedBeforeItIsAsked) {
  sim::WorldInput input;
  auto& changes = std::get<sim::Change>(input.action = sim::Change()).changes;
  changes = {{sim::ParameterChange::Part::kProgram, 0, "route", std::string(2000, 'x')}};
  const Status text = check_fits(input);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().message,
            "the text of parameter `route` is too long to be sent to another process");
  changes[0].value = std::vector<double>(1025);
  EXPECT_FALSE(check_fits(input));
  changes[0].value = std::vector<double>(1024);
  EXPECT_TRUE(check_fits(input));
  changes[0].name = std::string(129, 'n');
  EXPECT_FALSE(check_fits(input));
  input.author.name = std::string(200, 'n');
  changes.clear();
  EXPECT_FALSE(check_fits(input)) << "nor a name";
  input.author.name.clear();
  changes.assign(65, {sim::ParameterChange::Part::kProgram, 0, "a", 1.0});
  EXPECT_FALSE(check_fits(input));
}

TEST(Messages, AReportThatNobodyCouldUseIsRefused) {
  const auto refusal = [](auto&& spoil) {
    const sim::HostReport report = example_report();
    ReportMessage message;
    bus::HostReport sample = message.fill(report, 6, 77);
    sample.writer = 1;
    spoil(sample);
    if (const Status valid = bus::validate(sample); !valid) return valid.error().message;
    sim::HostReport again;
    const Status was_read = read(sample, again);
    return was_read ? std::string() : was_read.error().message;
  };
  EXPECT_EQ(refusal([](bus::HostReport&) {}), "");
  EXPECT_NE(refusal([](bus::HostReport& r) { r.inputs._buffer[2].v_mps = std::nan(""); }), "");
  EXPECT_EQ(refusal([](bus::HostReport& r) { r.inputs._buffer[0].kind = 99; }),
            "an order of an unknown kind");
}

constexpr auto kUnknownChange = static_cast<rave_wire_ObstacleChangeKind>(3);

/// A world that is right but for one thing.
template <class Spoil>
std::string refusal_of(Spoil spoil) {
  sim::WorldStep world = example_world();
  WorldMessage message;
  auto wire = message.fill(world, example_authority(), 9);
  bus::WorldStep sample = **wire;
  sample.writer = 1;
  spoil(sample);
  if (const Status valid = bus::validate(sample); !valid) return valid.error().message;
  sim::WorldStep again;
  sim::AuthorityState authority;
  const Status was_read = read(sample, again, authority);
  return was_read ? "" : was_read.error().message;
}

TEST(Messages, AWorldThatNobodyCouldUseIsRefusedWithItsField) {
  EXPECT_EQ(refusal_of([](bus::WorldStep&) {}), "");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.epoch = 0; }), "epoch is 0");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.x_m._buffer[1] = std::nan(""); }),
            "world.x_m[1] is nan, not within +-10000000");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.y_m._length = 2; }),
            "world.y_m has 2 entries for 3 robots");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.pushed._buffer[0].robot = 3; }),
            "pushed[0] is of robot 3, but there are 3");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.sent.packets._buffer[1].size = 99; }),
            "sent.packets[1] has 99 bytes from 3 on, of 7");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.poses._buffer[0].variance_xy_m2 = -1; }),
            "poses[0] has an invalid variance");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[0].kind = 17; }),
            "an order of an unknown kind");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[1].changes._buffer[0].part = 9; }),
            "a parameter of an unknown part of a robot");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[0].kind = 4; }),
            "an input of an unknown kind")
      << "obstacles come otherwise";
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[0].author = 2; }),
            "an input of an unknown author");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) {
              w.inputs._buffer[2].points._buffer[1].x_m = std::nan("");
            }),
            "inputs.points.x_m is nan, not within +-10000000");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[5].yaw_rad = 1e9; }),
            "inputs.yaw_rad is 1000000000, not within +-6283185.307179586");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[3].text[1] = '\x1b'; }),
            "inputs.text has control characters");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[2].by[0] = '\n'; }),
            "inputs.by has control characters");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.inputs._buffer[4].v_mps = std::nan(""); }),
            "inputs.v_mps is nan, not within +-10000");
}

TEST(Messages, AWorldWithANumberThatIsNoneIsRefused) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), inf, -inf}) {
    for (double rave_wire_SentPacket::*const number :
         {&rave_wire_SentPacket::x_m, &rave_wire_SentPacket::y_m,
          &rave_wire_SentPacket::antenna_z_m, &rave_wire_SentPacket::range_m}) {
      EXPECT_NE(refusal_of([&](bus::WorldStep& w) { w.sent.packets._buffer[0].*number = bad; }), "")
          << bad;
    }
    EXPECT_NE(refusal_of([&](bus::WorldStep& w) { w.pushed._buffer[0].y_m = bad; }), "");
    EXPECT_NE(refusal_of([&](bus::WorldStep& w) { w.touches._buffer[0].x = bad; }), "");
    EXPECT_NE(refusal_of([&](bus::WorldStep& w) { w.resized._buffer[0].scale = bad; }), "");
    EXPECT_NE(refusal_of([&](bus::WorldStep& w) { w.authority.scales._buffer[0].scale = bad; }),
              "");
    EXPECT_NE(
        refusal_of([&](bus::WorldStep& w) { w.inputs._buffer[1].changes._buffer[0].number = bad; }),
        "");
  }
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.sent.packets._buffer[0].to_kind = 3; }),
            "sent.packets[0].to_kind is unknown");
}

TEST(Messages, AWorldWithObstaclesOrEventsThatCannotBeIsRefusedWithItsField) {
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.obstacles._buffer[1].kind = kUnknownChange; }),
            "obstacles[1].kind is unknown");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) {
              w.obstacles._buffer[0].shapes._buffer[1].x_m._buffer[2] = std::nan("");
            }),
            "obstacles[0].shapes[1].x_m is nan, not within +-10000000");
  EXPECT_EQ(
      refusal_of([](bus::WorldStep& w) { bus::put_text(w.obstacles._buffer[0].asked, "{}"); }),
      "obstacle `crate`, asked: an edit has 0 of `add_obstacle`, `move_obstacle` and "
      "`remove_obstacle`; expected one");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.authority.obstacles._buffer[0].x_m = 1e9; }),
            "authority.obstacles[0].x_m is 1000000000, not within +-10000000");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) {
              std::swap(w.obstacles._buffer[0].shapes._buffer[1].x_m._buffer[0],
                        w.obstacles._buffer[0].shapes._buffer[1].x_m._buffer[1]);
              std::swap(w.obstacles._buffer[0].shapes._buffer[1].y_m._buffer[0],
                        w.obstacles._buffer[0].shapes._buffer[1].y_m._buffer[1]);
            }),
            "obstacle `crate`, shapes[1]: its corners are not those of a polygon that is strictly "
            "convex and counterclockwise");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.authority.events._buffer[0].robot = 3; }),
            "authority.events[0] is of robot 3, but there are 3");
  EXPECT_EQ(
      refusal_of([](bus::WorldStep& w) { w.authority.events._buffer[0].robot = rave_wire_kNone; }),
      "an event of kind 1 with no robot");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.authority.events._buffer[1].robot = 0; }),
            "an event of kind 29 with a robot");
  EXPECT_EQ(refusal_of([](bus::WorldStep& w) { w.authority.events._buffer[2].kind ^= 0x10; }),
            "an event of kind 17 of the step before 41; expected a contact or pin of a robot");
  EXPECT_EQ(
      refusal_of([](bus::WorldStep& w) { w.authority.events._buffer[3].robot = rave_wire_kNone; }),
      "an event of kind 2 of the step before 41; expected a contact or pin of a robot");
}

TEST(Introduction, ProcessesThatDifferAreTold) {
  const Identity self{0, "left", 3, 11, 22};
  EXPECT_TRUE(check_fits(self, introduction({1, "right", 4, 11, 22})));
  const Status scenario = check_fits(self, introduction({1, "right", 4, 12, 22}));
  ASSERT_FALSE(scenario);
  EXPECT_NE(scenario.error().message.find("`right` has another scenario"), std::string::npos);
  const Status build = check_fits(self, introduction({1, "right", 4, 11, 23}));
  ASSERT_FALSE(build);
  EXPECT_NE(build.error().message.find("another build of RAVE"), std::string::npos);
  const Status clock = check_fits(self, introduction({1, "right", 4, 11, 22, true}));
  ASSERT_FALSE(clock);
  EXPECT_NE(clock.error().message.find("`right` runs in real time, and this process in lock-step"),
            std::string::npos)
      << clock.error().message;
}

}  // namespace
}  // namespace rave::lock_step::testing
