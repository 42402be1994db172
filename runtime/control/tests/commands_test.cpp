// SPDX-License-Identifier: Apache-2.0
// Orders that come over the bus: whose they are, which robots they are for, and their answers.
#include "rave/control/commands.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/control/host_leases.hpp"

namespace rave::control {
namespace {

request::Request order(request::Action action) { return {std::move(action), {}, "lisa", false, 7}; }

/// A run of three robots, each with a host of its own.
class CommandsTest : public ::testing::Test {
 public:
  CommandsTest() {
    for (const char* const name : {"anna", "bert", "carl"}) {
      scenario_.robots.emplace_back().name = name;
    }
    scenario_.scenario.processes = 3;
    control_.begin({});
  }
  ~CommandsTest() override { control_.end(); }

 protected:
  bus::BegunCommand begin(const request::Request& request, std::uint32_t robot,
                          std::string_view host = "") {
    auto commands = commands_of(control_, scenario_, host);
    EXPECT_TRUE(commands) << commands.error().text();
    bus::Command command;
    std::vector<rave_wire_OrderPoint> points;
    const Status made = to_command(request, command, points);
    EXPECT_TRUE(made) << made.error().text();
    command.robot = robot;
    return (*commands)(command);
  }
  /// What the run is asked now, each of which it answers with `answer`.
  std::vector<request::Request> asked(const Result<std::string>& answer = "done") {
    std::vector<request::Request> asked;
    control_.serve(
        [&](const request::Request& request) {
          asked.push_back(request);
          return answer;
        },
        [](runtime::RunStatus&) {});
    return asked;
  }

  runtime::RunControl control_;
  config::ExpandedScenario scenario_;
};

TEST_F(CommandsTest, EveryKindComesBackAsItWasSent) {
  std::vector<request::Request> sent;
  sent.push_back(order(request::Drive{0.25, -0.5}));
  sent.push_back(order(request::Drive{0, 0, -0.5}));
  sent.push_back(order(request::Drive{0.5, 0, 0, request::Pedals{-0.25, 0.5, 0, -1}}));
  sent.push_back(order(request::Goal{{1.5, -2.25}, 0.1, 0.3}));
  sent.push_back(order(request::Path{{{1, 2}, {3, 4}, {5, 6}}, 0}));
  sent.push_back(order(request::Cancel()));
  sent.push_back(order(request::Text{"look out"}));
  sent.push_back(order(request::Place{{1, 0}, {}}));
  const request::Action holds[] = {request::Stop(), request::Release(), request::Arm()};
  for (const request::Action& hold : holds) {
    sent.push_back(order(hold));
    sent.back().overrides = true;
  }
  for (request::Request& request : sent) {
    static_cast<void>(begin(request, 1));
    request.robot = "bert";
  }
  EXPECT_EQ(asked(), sent);
}

TEST_F(CommandsTest, AnOrderDoesNotOverrideALease) {
  request::Request goal = order(request::Cancel());
  goal.overrides = true;
  static_cast<void>(begin(goal, 1));
  EXPECT_FALSE(asked().at(0).overrides);
}

TEST_F(CommandsTest, AnOrderIsAnsweredWithWhatTheRunSays) {
  const bus::BegunCommand goal = begin(order(request::Cancel()), 0);
  ASSERT_TRUE(goal);
  EXPECT_FALSE(goal()) << "the run has not answered yet";
  static_cast<void>(asked(fail(ErrorCode::kState, "`anna` drives\nbert")));
  const auto result = goal();
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->accepted);
  EXPECT_EQ(result->text, "`anna` drives bert") << "one line";
}

TEST_F(CommandsTest, ALongAnswerEndsWithAWholeCharacter) {
  const bus::BegunCommand cancel = begin(order(request::Cancel()), 0);
  ASSERT_TRUE(cancel);
  std::string text = "x";
  while (text.size() <= rave_wire_kMaxCommandAnswerBytes) text += "ü";
  static_cast<void>(asked(fail(ErrorCode::kState, "{}", text)));
  const auto result = cancel();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->text, text.substr(0, rave_wire_kMaxCommandAnswerBytes - 1));
}

TEST_F(CommandsTest, ADriveHasNoAnswer) {
  EXPECT_FALSE(begin(order(request::Drive()), 0));
  EXPECT_EQ(asked().size(), 1U);
}

TEST_F(CommandsTest, RobotsOfOtherHostsAreLeftToThem) {
  const auto hosts = config::plan_hosts(scenario_);
  ASSERT_TRUE(hosts);
  EXPECT_FALSE(begin(order(request::Cancel()), 2, hosts->front().name));
  EXPECT_FALSE(begin(order(request::Cancel()), 3)) << "there is no such robot";
  EXPECT_TRUE(begin(order(request::Cancel()), 2, hosts->back().name));
  EXPECT_EQ(asked().size(), 1U);
}

TEST_F(CommandsTest, WhatIsNoOrderIsRefused) {
  bus::Command command;
  std::vector<rave_wire_OrderPoint> points;
  EXPECT_FALSE(to_command(order(request::Take()), command, points));
  const auto path = order(request::Path{std::vector<Vec2>(10'000), 0});
  const Status made = to_command(path, command, points);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "a path has 10000 points; expected 2 to 1000");
  request::Request nobody = order(request::Cancel());
  nobody.by.clear();
  EXPECT_FALSE(to_command(nobody, command, points));
  const auto novel = order(request::Text{std::string(1001, 'x')});
  EXPECT_FALSE(to_command(novel, command, points));
}

TEST_F(CommandsTest, NobodyOnTheBusIsTheTerminalAndAPathHasTwoPoints) {
  request::Request request = order(request::Cancel());
  request.by = runtime::HostLeases::kTerminal;
  const bus::BegunCommand terminal = begin(request, 0);
  ASSERT_TRUE(terminal && terminal());
  EXPECT_FALSE(terminal()->accepted);
  bus::Command command{};
  command.kind = rave_wire_COMMAND_PATH;
  bus::put_text(command.author, "lisa");
  std::vector<rave_wire_OrderPoint> points(1);
  bus::borrow(command.points, points);
  const auto path = request_of(command, "anna");
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().message, "a path has 1 point; expected 2 to 1000");
  EXPECT_TRUE(asked().empty());
}

}  // namespace
}  // namespace rave::control
