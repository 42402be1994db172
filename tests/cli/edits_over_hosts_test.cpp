// SPDX-License-Identifier: Apache-2.0
// Obstacles that come, move and go in a world of several processes, started as users would start
// them.
#include "edits_over_hosts.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <random>

namespace rave::cli_test {
namespace {

TEST_F(EditsOverHosts, AScenarioThatChangesObstaclesHasTheHashOfOneProcess) {
  const std::string alone = hash_alone("edited.yaml", {});
  ASSERT_EQ(alone.size(), 16U);
  start("run", "run", "edited.yaml");
  // As in one process: a change that cannot be made makes the run one that is not whole.
  EXPECT_EQ(end_of("run"), 1) << console("run");
  EXPECT_EQ(result("run")["hash"], alone);
  ASSERT_EQ(result("run")["problems"].size(), 1U);
  EXPECT_NE(result("run")["problems"][0].get<std::string>().find("obstacle `lid` would overlap"),
            std::string::npos);
  std::mt19937 chance(static_cast<unsigned>(::getpid()));
  for (const int processes : {2, 3}) {
    Words order = {"env"};
    for (int i = 1; i <= processes; ++i) order.push_back(fmt::format("host-{}", i));
    std::shuffle(order.begin(), order.end(), chance);
    const Words split = {"--processes", std::to_string(processes)};
    for (const std::string& who : order) {
      if (who == "env") {
        start("env", "env", "edited.yaml", split);
      } else {
        start_host(who, "edited.yaml", split);
      }
    }
    for (const std::string& who : order) {
      EXPECT_EQ(end_of(who), who == "env" ? 1 : 0) << who << console(who);
    }
    EXPECT_EQ(result("env")["hash"], alone) << processes;
  }
}

TEST_F(EditsOverHosts, WhatIsAskedInMidRunIsInTheRecordOfEveryHostAtTheSameStep) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  const Ended added = add_box("bale", "40,2,30");
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("added `bale` at (40, 2), yaw "), std::string::npos) << added.out;
  EXPECT_NE(added.out.find("counts from step "), std::string::npos) << added.out;
  EXPECT_EQ(rave({"edit", "move", "bale", "--at", "-40,1"}).exit_code, 0);
  EXPECT_EQ(rave({"edit", "add", "polygon", "--name", "wedge", "--at", "34,-32", "--corners",
                  "0,0 1,0 0.5,1"})
                .exit_code,
            0);
  EXPECT_EQ(rave({"edit", "remove", "wedge"}).exit_code, 0);
  EXPECT_EQ(rave({"edit", "remove", "pillar"}).exit_code, 0);
  const Ended stopped = rave({"stop", "--robot", "left-1"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_NE(stopped.out.find("stopped left-1; counts from step "), std::string::npos)
      << stopped.out;
  EXPECT_EQ(rave({"set", "right-2", "body.scale", "0.8"}).exit_code, 0);
  const Ended listed = rave({"edit", "list"});
  EXPECT_NE(listed.out.find("bale"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("(-40.000, 1.000) m"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("wedge"), std::string::npos) << listed.out;
  end_by_hand("env");
  EXPECT_EQ(end_of("one"), 0);
  EXPECT_EQ(end_of("two"), 0);
  const std::vector<std::string> inputs = inputs_of("one");
  EXPECT_EQ(inputs.size(), 7U);
  EXPECT_EQ(inputs, inputs_of("two"));
  EXPECT_NE(content_of(folder("two") + "/events.log").find("obstacle added `bale` at (40, 2)"),
            std::string::npos);
  expect_verified("one");
  expect_verified("two");
}

TEST_F(EditsOverHosts, WhatCannotBeDoneIsRefusedWithASentence) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  const auto refused = [&](const Words& words, const std::string& why) {
    const Ended ended = rave(words);
    EXPECT_EQ(ended.exit_code, 1) << why;
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  };
  refused({"edit", "remove", "piller"}, "there is no obstacle `piller`; did you mean `pillar`?");
  refused({"edit", "add", "box", "--name", "lid", "--at", "0,0", "--size", "90000x90000"},
          "would overlap the robot `");
  refused({"set", "left-1", "program.cruise_mps", "0.1"}, "are set at its host");
  refused({"stop", "--robot", "left-99"}, "there is no robot `left-99`");
  // Where they are known, they can be set.
  const Ended there = rave({"set", "left-1", "program.cruise_mps", "0.1", "--run", "crowd@one"});
  EXPECT_EQ(there.exit_code, 0) << there.err;
  EXPECT_NE(console("env").find("refused: obstacle `lid` would overlap"), std::string::npos);
  end_by_hand("env");
}

TEST_F(EditsOverHosts, ARunIsHeldAndGoesOnStepByStep) {
  start("run", "run", "crowd.yaml", {"--duration", "100000", "--no-record"});
  wait_until_it_runs();
  EXPECT_EQ(rave({"pause"}).exit_code, 0);
  wait_until([&] { return rave({"ps"}).out.find("paused") != std::string::npos; }, "it is paused");
  const Ended added = add_box("bale", "40,2,30");
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("requested; the run is paused"), std::string::npos) << added.out;
  EXPECT_EQ(rave({"edit", "list"}).out.find("bale"), std::string::npos);
  EXPECT_EQ(rave({"step"}).exit_code, 0);
  wait_for_line("run", "added `bale` at (40, 2)");
  EXPECT_NE(rave({"edit", "list"}).out.find("bale"), std::string::npos);
  EXPECT_NE(rave({"ps"}).out.find("paused"), std::string::npos);
  EXPECT_EQ(rave({"resume"}).exit_code, 0);
  EXPECT_EQ(rave({"edit", "remove", "bale"}).exit_code, 0);
  end_by_hand("run");
}

TEST_F(EditsOverHosts, AManagerThatIsKilledIsReplacedByOneThatKnowsTheObstacles) {
  const Words span = {"--duration", "40"};
  const Ended one_process =
      run_rave({"run", "edited.yaml", "--output", folder("alone"), "--processes", "1", "--pace",
                "max", "--no-record", "--no-picture", "--duration", "40"});
  EXPECT_EQ(one_process.exit_code, 1) << "a change is refused: " << one_process.err;
  start_all("edited.yaml", span);
  // In the step in which a change is refused.
  for (const char* const host : {"one", "two"}) wait_for_line(host, "obstacle moved: `east`");
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  Words goes_on = span;
  goes_on.emplace_back("--resume");
  start("second", "env", "edited.yaml", goes_on);
  EXPECT_EQ(end_of("second"), 1) << "of the change that was refused before";
  EXPECT_NE(result("second")["problems"].dump().find("obstacle `lid` would overlap"),
            std::string::npos)
      << result("second")["problems"];
  EXPECT_EQ(end_of("one"), 0) << console("one");
  EXPECT_EQ(end_of("two"), 0) << console("two");
  // What changed, who touched whom, and what was refused, also of before.
  for (const char* const part : {"hash", "events", "changes", "problems", "inputs_by_hand"}) {
    EXPECT_EQ(result("second")[part].dump(1), result("alone")[part].dump(1)) << part;
  }
  EXPECT_EQ(content_of(folder("second") + "/events.log"),
            content_of(folder("alone") + "/events.log"));
}

TEST_F(EditsOverHosts, ASuccessorGoesOnWithWhatWasEditedByHand) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  const Ended added = add_box("bale", "33,0,90");
  ASSERT_EQ(added.exit_code, 0) << added.err;
  ASSERT_EQ(rave({"edit", "remove", "pillar"}).exit_code, 0);
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  start("second", "env", "crowd.yaml", {"--duration", "100000", "--resume"});
  wait_for_line("second", "takes over from a lost manager");
  wait_until_it_runs();
  const Ended listed = rave({"edit", "list"});
  EXPECT_NE(listed.out.find("bale"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("pillar"), std::string::npos) << listed.out;
  EXPECT_EQ(rave({"edit", "move", "bale", "--at", "35,0,90"}).exit_code, 0);
  end_by_hand("second");
  EXPECT_EQ(result("second")["inputs_by_hand"], 3) << "two of them before it was there";
  EXPECT_EQ(end_of("one"), 0);
  EXPECT_EQ(end_of("two"), 0);
  EXPECT_EQ(inputs_of("one").size(), 3U);
  expect_verified("one");
}

TEST_F(EditsOverHosts, AHostThatIsKilledAndComesBackHasWhatWasEdited) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  ASSERT_EQ(add_box("bale", "33,0,90").exit_code, 0);
  ASSERT_EQ(rave({"edit", "move", "bale", "--at", "36,0.5"}).exit_code, 0);
  signal("one", SIGKILL);
  EXPECT_EQ(end_of("one"), -1);
  wait_for_line("env", "host `one` is gone");
  // Nothing is made while all wait, and who asks is told.
  const Ended later = add_box("crate", "40,3");
  EXPECT_EQ(later.exit_code, 0) << later.err;
  EXPECT_NE(later.out.find("requested; the run waits for one"), std::string::npos) << later.out;
  start("again", "robot", "crowd.yaml", {"--host", "one", "--duration", "100000"});
  wait_for_line("env", "host `one` is back");
  wait_for_size("again");
  wait_for_line("env", "added `crate`");
  const Ended listed = rave({"edit", "crowd@one", "list"});
  EXPECT_NE(listed.out.find("(36.000, 0.500) m"), std::string::npos) << listed.out;
  wait_until(
      [&] {
        return rave({"edit", "crowd@one", "list"}).out.find("crate") != std::string::npos;
      },
      "the edit that waited is there, too");
  end_by_hand("env", 1);
}

TEST_F(Garbage, NonsenseOfAStrangerIsRefusedAndTheRunGoesOn) {
  const Words words = {"--duration", "100000", "--run", run_.text()};
  start("env", "env", "crowd.yaml", words);
  Nonsense nonsense;
  bus::LastWorld last{};
  last.epoch = 7;
  bus::borrow(last.authority.obstacles, nonsense.changes);
  send_until(last, "env", "authority.obstacles[0].shapes[0].x_m is nan");
  start_host("one", "crowd.yaml", words);
  start_host("two", "crowd.yaml", words);
  wait_until_it_runs();
  bus::WorldStep world{};
  world.epoch = 7;
  bus::borrow(world.obstacles, nonsense.changes);
  send_until(world, "one", "obstacles[0].shapes[0].x_m is nan");
  EXPECT_EQ(add_box("bale", "40,2").exit_code, 0);
  EXPECT_EQ(rave({"edit", "list"}).out.find("nonsense"), std::string::npos);
  end_by_hand("env");
  EXPECT_EQ(end_of("one"), 0) << console("one");
}

}  // namespace
}  // namespace rave::cli_test
