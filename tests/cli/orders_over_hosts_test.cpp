// SPDX-License-Identifier: Apache-2.0
// The same orders at the same steps, to robots in one process and in several.
#include <algorithm>
#include <cstdlib>

#include "held_run.hpp"
#include "rave/control/client.hpp"
#include "rave/control/folder.hpp"

namespace rave::cli_test {
namespace {

/// A path of so many points around the place of `carl`.
Words path_of(std::size_t points) {
  Words words = {"goal", "carl"};
  for (std::size_t i = 0; i < points; ++i) {
    const double angle_rad = 0.01 * static_cast<double>(i);
    // As many digits as numbers have that somebody computed.
    words.push_back(fmt::format("{}", 3 + 0.31 * std::cos(angle_rad)));
    words.push_back(fmt::format("{}", -3 + 0.31 * std::sin(angle_rad)));
  }
  return words;
}

class OrdersOverHosts : public HeldRun {
 protected:
  /// The hash of a run in which people ask all kinds of things.
  std::string hash_of_orders(const std::string& name, const Words& more) {
    start(name, more);
    go_to(450);
    drive_and_let_go();
    go_to(500);
    give({"goal", "bert", "-2.5", "-3"});
    give({"goal", "carl", "3.05", "-3", "3.1", "-3", "--speed", "0.3"});
    give({"say", "carl", "hello"});
    give({"place", "anna", "2.5", "0.5", "90"});
    go_to(600);
    give({"goal", "anna", "2.2", "-0.5"});
    give({"stop", "--robot", "bert"});
    give(path_of(1000));
    go_to(700);
    give({"goal", "anna", "--cancel"});
    // While the run is paused, both wait for its next step.
    give({"arm", "--robot", "bert", "--release"});
    return end();
  }
  /// The process that has a robot: its host, or the run of one process.
  [[nodiscard]] std::string host_of(const std::string& robot) const {
    EXPECT_EQ(::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1), 0);
    std::string alone;
    const auto runs = control::running_runs();
    for (const std::string& run : runs.value()) {
      const auto answer = control::ask(run, control::Request{});
      const bool has = answer && std::ranges::any_of(answer->status.robots, [&](const auto& one) {
                         return one.name == robot;
                       });
      if (has && run.find('@') != std::string::npos) return run;
      if (has) alone = run;
    }
    return alone;
  }
  /// `good: ` or `refused: `, and what a process says.
  static std::string said_by(const std::string& process, const control::Request& request) {
    const auto answer = control::ask(process, request);
    if (!answer) return "error: " + answer.error().text();
    return (answer->good ? "good: " : "refused: ") + answer->text;
  }
  /// Somebody drives and is silent from then on: the drive, its end and that of the lease are three
  /// inputs, all of the step for which the run waits.
  void drive_and_let_go() {
    const std::string drives = "`terminal` drives it";
    const control::Request drive = control::request_of({request::Drive{0.3, 0.1}, "bert"});
    EXPECT_EQ(said_by(host_of("bert"), drive).substr(0, 5), "good:");
    const auto robots = [this] { return rave({"ps", "--robots"}).out; };
    EXPECT_NE(robots().find(drives), std::string::npos) << robots();
    wait_until([&] { return robots().find(drives) == std::string::npos; });
  }
};

TEST_F(OrdersOverHosts, TheHashIsThatOfOneProcessAndVerifyDoesThemAgain) {
  const std::string alone = hash_of_orders("alone", {});
  ASSERT_EQ(alone.size(), 16U) << alone;
  expect_verified(false);
  const std::string events = content_of(output_ + "/events.log");
  for (const std::string order : {"drive 0.30 m/s, 0.10 rad/s", "cancel", "goal",
                                  "path of 1000 points", "text: hello", "place"}) {
    EXPECT_NE(events.find(order), std::string::npos) << order << "\n" << events;
  }
  EXPECT_EQ(hash_of_orders("split", split()), alone);
  expect_verified(true);
}

TEST_F(OrdersOverHosts, AProgramOfItsOwnProcessDoesTheSame) {
  const std::string beside = hash_of_orders("beside", {});
  ASSERT_EQ(beside.size(), 16U) << beside;
  scenario_ = "orders_isolated.yaml";
  EXPECT_EQ(hash_of_orders("isolated", {}), beside);
  expect_verified(false);
  const std::string events = content_of(output_ + "/events.log");
  for (const std::string said : {"I obey goals and paths, not texts.", "path of 1000 points",
                                 "I am at the end of the path."}) {
    EXPECT_NE(events.find(said), std::string::npos) << said << "\n" << events;
  }
  EXPECT_EQ(hash_of_orders("isolated-split", split()), beside);
  expect_verified(true);
}

TEST_F(OrdersOverHosts, APathThatIsTooLongIsRefusedAtOnce) {
  start("split", [this] {
    Words words = split();
    words.emplace_back("--no-record");
    return words;
  }());
  const Ended path = rave(path_of(10'000));
  EXPECT_EQ(path.exit_code, 2) << path.out;
  EXPECT_NE(path.err.find("a path has 10000 points; expected 2 to 1000"), std::string::npos)
      << path.err;
}

TEST_F(OrdersOverHosts, WhatAHostRefusesIsSaid) {
  pace_ = "0.5x";
  start("split",
        {"--processes", "3", "--no-record", "--bus-tag", folder_.path().filename().string()});
  give({"resume"});
  const Ended deaf = rave({"say", "bert", "hello"});
  EXPECT_EQ(deaf.exit_code, 1) << deaf.out;
  EXPECT_NE(deaf.err.find("its program takes no texts"), std::string::npos) << deaf.err;
  const Ended wall = rave({"goal", "anna", "0", "2"});
  EXPECT_EQ(wall.exit_code, 1) << wall.out;
  EXPECT_NE(wall.err.find("is inside the obstacle `wall`"), std::string::npos) << wall.err;
  const Ended post = rave({"place", "anna", "1", "1"});
  EXPECT_EQ(post.exit_code, 1) << post.out;
  EXPECT_NE(post.err.find("it would overlap `post`"), std::string::npos) << post.err;
  const Ended listed = rave({"ps", "--robots"});
  EXPECT_NE(listed.out.find("anna"), std::string::npos) << listed.out;
  EXPECT_EQ(deaf.err.find("another process"), std::string::npos) << "only its host is asked";
}

/// What a person asks, as a page would.
control::Request of_person(request::Action action, const std::string& robot,
                           const std::string& by) {
  return control::request_of({std::move(action), robot, by});
}

TEST_F(OrdersOverHosts, TheHostOfTheRobotKeepsItsLeaseAndTheManagerIsNotAsked) {
  start("split", [this] {
    Words words = split();
    words.emplace_back("--no-record");
    return words;
  }());
  go_to(100);
  const std::string host = host_of("bert");
  ASSERT_NE(host.find('@'), std::string::npos) << host;
  const auto manager = control::find_run("orders");
  ASSERT_TRUE(manager) << manager.error().text();
  EXPECT_EQ(said_by(host, of_person(request::Take(), "bert", "anna")), "good: bert is yours");
  const control::Request drive = of_person(request::Drive{0.1, 0}, "bert", "mona");
  EXPECT_EQ(said_by(host, drive), "refused: `anna` drives bert");
  EXPECT_EQ(said_by(host, of_person(request::Release(), "bert", "mona")),
            "refused: `anna` drives bert");
  EXPECT_EQ(said_by(host, of_person(request::Take(), "bert", "mona")),
            "refused: `anna` drives bert");
  EXPECT_EQ(said_by(host, of_person(request::Take(), "carl", "mona")),
            "refused: robot `carl` runs in another process of this run");
  EXPECT_NE(
      said_by(*manager, of_person(request::Take(), "bert", "anna")).find("which keeps its lease"),
      std::string::npos);
  // All who ask how the run stands hear of it, also from the manager.
  const auto told = [&](const std::string& process) {
    const auto answer = control::ask(process, control::Request{});
    if (!answer) return std::string();
    for (const auto& robot : answer->status.robots) {
      if (robot.name == "bert") return robot.lease;
    }
    return std::string();
  };
  EXPECT_EQ(told(host), "anna");
  wait_until([&] { return told(*manager) == "anna"; });
  // A stop needs no lease.
  EXPECT_EQ(said_by(host, of_person(request::Stop(), "bert", "mona")).substr(0, 5), "good:");
  EXPECT_EQ(said_by(host, of_person(request::Give(), "bert", "anna")),
            "good: no person drives bert now");
  wait_until([&] { return told(*manager).empty(); });
}

}  // namespace
}  // namespace rave::cli_test
