// SPDX-License-Identifier: Apache-2.0
// Obstacles that come, move and go in a run in real time over several processes.
#include <algorithm>

#include "edits_over_hosts.hpp"

namespace rave::cli_test {
namespace {

class LiveEdits : public Garbage {
 protected:
  void begin(const std::string& who, const std::string& name) {
    Words words = {"--run", run_.text()};
    if (who != "env") words.insert(words.end(), {"--host", who});
    if (who == "env" && name != who) words.emplace_back("--resume");
    start(name, who == "env" ? "env" : "robot", "live.yaml", words);
  }
  void begin_all() {
    for (const char* const who : {"env", "one", "two"}) begin(who, who);
    wait_for_line("env", "all hosts have joined");
    wait_until_it_runs();
  }
  [[nodiscard]] bool host_has(const std::string& host, const std::string& text) const {
    return rave({"edit", "live@" + host, "list"}).out.find(text) != std::string::npos;
  }
};

TEST_F(LiveEdits, AnEditIsAroundAllRobotsWithinAMeasuredTime) {
  begin_all();
  const Ended added = add_box("bale", "0,5");
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("added `bale` at (0, 5)"), std::string::npos) << added.out;
  EXPECT_NE(added.out.find("in effect at all 2 hosts "), std::string::npos) << added.out;
  EXPECT_EQ(rave({"edit", "move", "bale", "--at", "0.2,5"}).exit_code, 0);
  for (const char* const host : {"one", "two"}) {
    EXPECT_TRUE(host_has(host, "(0.200, 5.000) m")) << host;
  }
  EXPECT_EQ(rave({"edit", "remove", "bale"}).exit_code, 0);
  EXPECT_FALSE(host_has("one", "bale"));
  const Ended unknown = rave({"edit", "remove", "bal"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("there is no obstacle `bal`"), std::string::npos) << unknown.err;
  // What is no edit is done by the hosts.
  const Ended stop = rave({"stop", "live"});
  EXPECT_EQ(stop.exit_code, 0) << stop.err;
  for (const char* const host : {"@one", "@two"}) {
    EXPECT_NE(stop.out.find(host), std::string::npos) << stop.out;
  }
  // All of them are told, so what the hosts have measured comes to the manager.
  EXPECT_EQ(rave({"end", "live"}).exit_code, 0);
  for (const char* const who : {"env", "one", "two"}) EXPECT_EQ(end_of(who), 0) << console(who);
  const auto result = this->result("env");
  EXPECT_EQ(result["edits"], 3) << result.dump();
  EXPECT_EQ(result["edits_confirmed_by_all"], 3) << result.dump();
  EXPECT_TRUE(result["edit_slowest_s"].is_number()) << result.dump();
  const std::string summary = content_of(folder("env") + "/summary.txt");
  EXPECT_NE(summary.find("edits to other hosts"), std::string::npos) << summary;
  // The same of poses, which the hosts measure.
  EXPECT_GT(result["poses_of_others"], 0) << result.dump();
  EXPECT_GT(result["pose_mean_s"], 0) << result.dump();
  EXPECT_GE(result["pose_slowest_s"], result["pose_mean_s"]) << result.dump();
  EXPECT_NE(summary.find("poses to other hosts"), std::string::npos) << summary;
}

TEST_F(LiveEdits, WhoComesLateHasAllObstaclesBeforeItsFirstStep) {
  begin_all();
  ASSERT_EQ(add_box("bale", "0,5").exit_code, 0);
  ASSERT_EQ(add_box("gone", "0,-5").exit_code, 0);
  ASSERT_EQ(rave({"edit", "remove", "gone"}).exit_code, 0);
  ASSERT_EQ(rave({"edit", "move", "south", "--at", "0,-2.2"}).exit_code, 0);
  signal("two", SIGKILL);
  EXPECT_EQ(end_of("two"), -1);
  wait_for_line("env", "host `two` is gone");
  begin("two", "late");
  wait_for_line("late", "obstacle added: `bale`");
  wait_for_line("late", "obstacle removed: `gone`");
  wait_for_line("late", "obstacle moved: `south`");
  // All in the first step that this process made.
  signal("late", SIGINT);
  EXPECT_EQ(end_of("late"), 1);
  const std::string events = content_of(folder("late") + "/events.log");
  const auto time_of = [&](const std::string& text) {
    const std::size_t at = events.find(text);
    if (at == std::string::npos) return std::string("never: " + text);
    const std::size_t line = events.rfind('\n', at);
    return events.substr(line == std::string::npos ? 0 : line + 1, 12);
  };
  const auto late = result("late");
  EXPECT_EQ(time_of("obstacle added `bale`"), time_of("obstacle moved `south`")) << events;
  EXPECT_NEAR(std::stod(time_of("obstacle added `bale`")), late["first_step"].get<double>() * 0.01,
              0.0051)
      << events;
  end_by_hand("env", 1);
}

TEST_F(LiveEdits, AManagerThatTakesOverKnowsTheObstacles) {
  begin_all();
  ASSERT_EQ(add_box("bale", "0,5").exit_code, 0);
  ASSERT_EQ(rave({"edit", "remove", "north"}).exit_code, 0);
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  begin("env", "second");
  wait_for_line("second", "takes over at");
  wait_until(
      [&] {
        return rave({"edit", "live", "move", "bale", "--at", "0.1,5"}).exit_code == 0;
      },
      "it knows the bale");
  const Ended listed = rave({"edit", "list"});
  EXPECT_EQ(listed.out.find("north"), std::string::npos) << listed.out;
  for (const char* const host : {"one", "two"}) {
    EXPECT_TRUE(host_has(host, "(0.100, 5.000) m")) << host;
  }
  end_by_hand("second", 1);
}

TEST_F(LiveEdits, WhatTheScenarioCannotChangeIsAProblemOfTheRun) {
  start("run", "run", "live_edited.yaml");
  EXPECT_EQ(end_of("run"), 1) << console("run");
  const auto result = this->result("run");
  EXPECT_EQ(result["whole"], false);
  ASSERT_EQ(result["problems"].size(), 1U) << result.dump();
  const auto problem = result["problems"][0].get<std::string>();
  EXPECT_NE(problem.find("the change at "), std::string::npos) << problem;
  EXPECT_NE(problem.find("was refused: obstacle `lid` would overlap"), std::string::npos)
      << problem;
  // What all hosts had came once, whenever each of them had it.
  const std::string events = content_of(folder("run") + "/events.log");
  const std::size_t added = events.find("obstacle added `bale`");
  ASSERT_NE(added, std::string::npos) << events;
  EXPECT_EQ(events.find("obstacle added `bale`", added + 1), std::string::npos) << events;
}

TEST_F(LiveEdits, ARobotIsHandedOverByTheHostThatRunsIt) {
  const Words words = {"--run", run_.text()};
  start("env", "env", "live_twins.yaml", words);
  start_host("one", "live_twins.yaml", words);
  start_host("two", "live_twins.yaml", words);
  wait_for_line("env", "all hosts have joined");
  wait_until_it_runs();
  wait_for_line("two", "handed over: simulated -> simulated");
  // The run has three processes here; nobody needs to know which of them it is.
  const Ended made = rave({"hand-over", "left", "twin"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("live_twins@one"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("simulated -> simulated"), std::string::npos) << made.out;
  EXPECT_NE(console("one").find("handed over"), std::string::npos);
  const Ended again = rave({"hand-over", "left", "twin"});
  EXPECT_EQ(again.exit_code, 1) << again.out;
  EXPECT_NE(again.err.find("already has its"), std::string::npos) << again.err;
  end_by_hand("env", 1);
}

TEST_F(LiveEdits, NonsenseIsRefusedWithALogLine) {
  begin_all();
  Nonsense nonsense;
  bus::Obstacle obstacle{};
  obstacle.id = 31;
  obstacle.revision = 9;
  obstacle.stands = nonsense.changes[0];
  send_until(obstacle, "one", "stands.shapes[0].x_m is nan");
  EXPECT_EQ(add_box("bale", "0,5").exit_code, 0);
  EXPECT_TRUE(host_has("one", "bale"));
  EXPECT_FALSE(host_has("one", "nonsense"));
  end_by_hand("env", 1);
}

}  // namespace
}  // namespace rave::cli_test
