// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/bus/sequence.hpp"
#include "rave/bus_testing/sample_messages.hpp"

namespace rave::bus {
namespace {

using testing::NewBox;
using testing::RobotArrays;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Message>
std::string reason(const Message& sample) {
  const Status status = validate(sample);
  return status ? "accepted" : status.error().message;
}

/// A message of a writer, otherwise empty.
template <class Message>
Message written() {
  Message message{};
  message.writer = 1;
  return message;
}

/// A world of three robots.
struct SampleWorld {
  RobotArrays robots{3, 1};
  World sample{};

  SampleWorld() { sample.writer = 9; }
  std::string judge() {
    robots.lend(sample.robots);
    return reason(sample);
  }
};

TEST(Validate, AcceptsAWorld) {
  EXPECT_EQ(SampleWorld().judge(), "accepted");
  auto empty = written<World>();
  EXPECT_EQ(reason(empty), "accepted");
}

TEST(Validate, RefusesNumbersThatAreNone) {
  SampleWorld world;
  world.robots.yaw[2] = kNaN;
  EXPECT_TRUE(world.judge().starts_with("robots.yaw_rad[2] is nan"));
  SampleWorld fast;
  fast.robots.vx[0] = -kInfinity;
  EXPECT_EQ(fast.judge(), "robots.vx_mps[0] is -inf, not within +-10000");
  SampleWorld far;
  far.robots.x[1] = 1.1e7;
  EXPECT_EQ(far.judge(), "robots.x_m[1] is 11000000, not within +-10000000");
}

TEST(Validate, RefusesListsThatDoNotFit) {
  SampleWorld world;
  world.robots.wz.pop_back();
  EXPECT_EQ(world.judge(), "robots.wz_radps has 2 entries for 3 robots");
  SampleWorld timeless;
  timeless.robots.stamp_ns.pop_back();
  EXPECT_EQ(timeless.judge(), "robots.stamp_ns has 2 entries for 3 robots");
  SampleWorld endless;
  endless.robots.stamp_ns[1] = INT64_MIN;
  EXPECT_TRUE(endless.judge().starts_with("robots.stamp_ns[1] is -9223372036854775808"));
  std::vector<std::uint32_t> stale = {2, 1};
  SampleWorld silent;
  borrow(silent.sample.stale, stale);
  EXPECT_EQ(silent.judge(), "stale[1] is 1 after 2; ids ascend");
  SampleWorld twice;
  twice.robots.id = {0, 4, 4};
  EXPECT_EQ(twice.judge(), "robots.id[2] is 4 after 4; ids ascend");
  SampleWorld none;
  none.robots.id = {0, 4, rave_wire_kNone};
  EXPECT_EQ(none.judge(), "robots.id: a robot without a number");
  SampleWorld many;
  many.robots = RobotArrays(rave_wire_kMaxRobots + 1, 0);
  EXPECT_EQ(many.judge(), "robots has 131073 robots, more than 131072");
}

TEST(Validate, NeedsAWriter) {
  SampleWorld world;
  world.sample.writer = 0;
  EXPECT_EQ(world.judge(), "writer is 0");
}

TEST(Validate, LooksAtTheRobotsOfAHost) {
  RobotArrays robots(2, 0);
  auto state = written<HostState>();
  robots.lend(state.resolved);
  EXPECT_EQ(reason(state), "accepted");
  robots.vy[1] = kNaN;
  EXPECT_TRUE(reason(state).starts_with("resolved.vy_mps[1] is nan"));
  robots.vy[1] = 0;
  state.host = rave_wire_kNone;
  EXPECT_EQ(reason(state), "host is none");
}

template <class Spoil>
std::string judge_obstacle(Spoil&& spoil) {
  NewBox box(3);
  spoil(box.sample, box.shapes[0]);
  return reason(box.sample);
}

TEST(Validate, ObstaclesAreWhatSomebodyCanBuild) {
  using Shape = rave_wire_BodyShape;
  EXPECT_EQ(judge_obstacle([](Obstacle&, Shape&) {}), "accepted");
  EXPECT_EQ(judge_obstacle([](Obstacle& o, Shape&) { o.revision = 0; }), "revision is 0");
  EXPECT_EQ(judge_obstacle([](Obstacle& o, Shape&) { o.stands.id = 4; }),
            "stands.id is 4, of obstacle 3");
  EXPECT_EQ(judge_obstacle([](Obstacle& o, Shape&) { o.stands.x_m = kNaN; }),
            "stands.x_m is nan, not within +-10000000");
  EXPECT_EQ(judge_obstacle([](Obstacle& o, Shape&) { o.stands.shapes._length = 0; }),
            "stands.shapes is empty");
  EXPECT_EQ(judge_obstacle([](Obstacle& o, Shape&) { o.stands.name[1] = '\x1b'; }),
            "stands.name has control characters");
  EXPECT_EQ(judge_obstacle([](Obstacle&, Shape& s) { s.x_m._length = 2; }),
            "stands.shapes[0] has 2 x and 4 y; a polygon has 3 corners or more");
  EXPECT_EQ(judge_obstacle([](Obstacle&, Shape& s) { s.kind = rave_wire_SHAPE_DISC; }),
            "stands.shapes[0] has 4 x and 4 y; a disc has one of each");
  EXPECT_EQ(judge_obstacle([](Obstacle&, Shape& s) { s.radius_m = 1; }),
            "stands.shapes[0].radius_m is 1");
  EXPECT_EQ(judge_obstacle([](Obstacle&, Shape& s) { s.z_min_m = 2; }),
            "stands.shapes[0]: z_min_m 2 is not below z_max_m 1");
  EXPECT_EQ(judge_obstacle([](Obstacle&, Shape& s) { s.x_m._buffer[2] = kInfinity; }),
            "stands.shapes[0].x_m is inf, not within +-10000000");
}

TEST(Validate, AnObstacleThatMovedHasNoBody) {
  NewBox box(3);
  box.sample.stands.kind = rave_wire_OBSTACLE_MOVE;
  EXPECT_EQ(reason(box.sample), "stands.shapes are of one that is not new");
  box.sample.stands.shapes._length = 0;
  EXPECT_EQ(reason(box.sample), "accepted");
  box.sample.removed = true;
  EXPECT_EQ(reason(box.sample), "removed is set for an obstacle that was not added");
}

TEST(Validate, RosterEntriesHaveNamesThatCanBeShown) {
  auto entry = written<RosterEntry>();
  EXPECT_EQ(reason(entry), "name is empty");
  put_text(entry.name, "ann\x1b[2J");
  EXPECT_EQ(reason(entry), "name has control characters");
  put_text(entry.name,
           "ann\xc2\x9b"
           "2J");
  EXPECT_EQ(reason(entry), "name has control characters") << "U+009B is ESC [ in one";
  put_text(entry.name, "anna");
  EXPECT_EQ(reason(entry), "accepted");
  entry.host = rave_wire_kNone;
  EXPECT_EQ(reason(entry), "host is none");
}

TEST(Validate, Commands) {
  auto command = written<Command>();
  EXPECT_EQ(reason(command), "number is 0");
  command.number = 1;
  EXPECT_EQ(reason(command), "author is empty");
  put_text(command.author, "bob");
  EXPECT_EQ(reason(command), "accepted") << "a drive";
  command.kind = rave_wire_COMMAND_GOAL;
  EXPECT_EQ(reason(command), "points has 0 entries, not 1");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<rave_wire_OrderPoint> points = {{0.5, kNan}};
  borrow(command.points, points);
  EXPECT_EQ(reason(command), "points.y_m is nan, not within +-10000000");
  points[0].y_m = 1;
  EXPECT_EQ(reason(command), "accepted");
  points.push_back({2, 2});
  borrow(command.points, points);
  EXPECT_EQ(reason(command), "points has 2 entries, not 1");
  command.kind = rave_wire_COMMAND_PATH;
  EXPECT_EQ(reason(command), "accepted");
  command.speed_mps = kNan;
  EXPECT_EQ(reason(command), "speed_mps is nan, not within +-10000");
  command.speed_mps = 0;
  command.points = {};
  command.kind = rave_wire_COMMAND_TEXT;
  EXPECT_EQ(reason(command), "text is empty");
  put_text(command.text, "\x1b[2J");
  EXPECT_EQ(reason(command), "text has control characters");
}

TEST(Validate, AnswersToCommands) {
  auto answer = written<CommandAnswer>();
  EXPECT_EQ(reason(answer), "target is 0");
  answer.target = 7;
  EXPECT_EQ(reason(answer), "number is 0");
  answer.number = 1;
  EXPECT_EQ(reason(answer), "text is empty");
  borrow_text(answer.text, "r1 is sent to 1.00, 2.00");
  EXPECT_EQ(reason(answer), "accepted");
  answer.robot = rave_wire_kNone;
  EXPECT_EQ(reason(answer), "robot is none");
}

TEST(Validate, Lines) {
  auto line = written<LineInfo>();
  EXPECT_EQ(reason(line), "host is empty");
  put_text(line.host, "left");
  EXPECT_EQ(reason(line), "url is empty");
  put_text(line.url, "http://left:8090/ws");
  EXPECT_EQ(reason(line), "url: expected ws:// or wss://");
  put_text(line.url, "ws://left; script-src *");
  EXPECT_EQ(reason(line), "url has an invalid character");
  put_text(line.url, "wss://left:8090/ws");
  EXPECT_EQ(reason(line), "accepted");
  auto withdrawal = written<LineWithdrawal>();
  EXPECT_EQ(reason(withdrawal), "user is empty");
  put_text(withdrawal.user, "anna");
  EXPECT_EQ(reason(withdrawal), "text is empty");
  put_text(withdrawal.text, "e30.e30");
  EXPECT_EQ(reason(withdrawal), "accepted");
}

TEST(Validate, HostsAndClocks) {
  auto host = written<HostInfo>();
  EXPECT_EQ(reason(host), "name is empty");
  put_text(host.name, "lab");
  EXPECT_EQ(reason(host), "accepted");
  auto process = written<ProcessState>();
  EXPECT_EQ(reason(process), "number is 0");
  process.number = 1;
  process.real_robots = 2;
  EXPECT_EQ(reason(process), "real_robots is 2, of 0 robots");
  process.robots = 3;
  EXPECT_EQ(reason(process), "accepted");
  process.missed_deadlines = 5;
  process.deadlines = 4;
  EXPECT_EQ(reason(process), "missed_deadlines is 5, of 4 deadlines");
  process.deadlines = 5;
  EXPECT_EQ(reason(process), "accepted");
  process.robots = rave_wire_kMaxRobots + 1;
  EXPECT_EQ(reason(process), "robots is 131073, more than 131072");
  auto ping = written<ClockPing>();
  EXPECT_EQ(reason(ping), "target is 0");
  auto pong = written<ClockPong>();
  pong.target = 2;
  pong.ping_received_ns = 5;
  EXPECT_EQ(reason(pong), "a pong was sent before its ping");
  auto packet = written<Packet>();
  packet.from_robot = rave_wire_kNone;
  EXPECT_EQ(reason(packet), "from_robot is none");
}

TEST(Validate, PacketsSayWhoTheyAreForAndFromWhere) {
  auto packet = written<Packet>();
  EXPECT_EQ(reason(packet), "accepted");
  packet.to_kind = rave_wire_TO_ROBOT;
  packet.to_robot = rave_wire_kNone;
  EXPECT_EQ(reason(packet), "to_robot is none");
  packet.to_robot = 3;
  for (double Packet::*const number :
       {&Packet::x_m, &Packet::y_m, &Packet::antenna_z_m, &Packet::range_m}) {
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
      packet.*number = bad;
      EXPECT_NE(reason(packet).find("_m is "), std::string::npos) << bad;
    }
    packet.*number = 0;
  }
  packet.range_m = -1;
  EXPECT_EQ(reason(packet), "range_m is -1, not within 0 and 10000000");
  packet.range_m = 0;
  packet.sent_ns = INT64_MAX;
  EXPECT_TRUE(reason(packet).starts_with("sent_ns is 9223372036854775807"));
}

TEST(PutText, CutsAtTheEndOfACharacter) {
  char field[4];
  EXPECT_TRUE(put_text(field, "abc"));
  EXPECT_FALSE(put_text(field, "abcd"));
  EXPECT_STREQ(field, "abc");
  EXPECT_FALSE(put_text(field, "ab\xc3\xa9"));
  EXPECT_STREQ(field, "ab");
}

/// A request, or its answer, with a line of text.
template <class Message>
Message request_with(std::string& text) {
  auto message = written<Message>();
  message.target = 2;
  message.number = 1;
  message.text._buffer = reinterpret_cast<std::uint8_t*>(text.data());
  message.text._length = static_cast<std::uint32_t>(text.size());
  return message;
}

TEST(Validate, RefusesRequestsThatAreForNobodyOrNoLine) {
  std::string text = R"({"rave":1,"do":"list"})";
  auto request = request_with<Request>(text);
  put_text(request.from, "anna@box");
  EXPECT_EQ(reason(request), "accepted");
  auto nobody = request;
  nobody.target = 0;
  EXPECT_EQ(reason(nobody), "target is 0");
  auto uncounted = request;
  uncounted.number = 0;
  EXPECT_EQ(reason(uncounted), "number is 0");
  auto unsigned_one = request;
  put_text(unsigned_one.from, "");
  EXPECT_EQ(reason(unsigned_one), "from is empty");
  put_text(unsigned_one.from, "\x1b[31m");
  EXPECT_EQ(reason(unsigned_one), "from has control characters");
  std::string lines = "a\nb";
  auto two = request_with<Request>(lines);
  put_text(two.from, "anna");
  EXPECT_EQ(reason(two), "text has control characters");
  two.text._length = 0;
  EXPECT_EQ(reason(two), "text is empty");
  std::string endless(rave_wire_kMaxRequestBytes + 1, 'x');
  auto much = request_with<Request>(endless);
  put_text(much.from, "anna");
  EXPECT_EQ(reason(much), "text has 65537 bytes, more than 65536");
  EXPECT_EQ(reason(request_with<RequestAnswer>(endless)), "accepted");
  std::string none;
  EXPECT_EQ(reason(request_with<RequestAnswer>(none)), "text is empty");
}

}  // namespace
}  // namespace rave::bus
