// SPDX-License-Identifier: Apache-2.0
// One `rave` controls another, as from another terminal.
#include <gtest/gtest.h>

#include <csignal>

#include "paced_run.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

class Control : public PacedRun {};

TEST_F(Control, WithoutARun) {
  EXPECT_EQ(rave({"ps"}).out, "no run is in progress\n");
  // Nobody else is on a bus of this name.
  const Ended ended = rave({"stop", "--bus-tag", folder_.path().filename().string()});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_TRUE(ended.err.starts_with("rave: no run is in progress on this machine; on the bus in "))
      << ended.err;
  EXPECT_EQ(rave({"stop", "--all"}).exit_code, 2);
  EXPECT_EQ(rave({"set", "anna", "body.scale"}).exit_code, 2);
}

TEST_F(Control, StopsArmsAndSets) {
  start("good_scenario.yaml");
  const Ended listed = rave({"ps", "--robots"});
  EXPECT_NE(listed.out.find("herd-2"), std::string::npos) << listed.out;
  const Ended typo = rave({"stop", "--robot", "ana"});
  EXPECT_EQ(typo.exit_code, 1);
  EXPECT_NE(typo.err.find("did you mean `anna`"), std::string::npos) << typo.err;
  // What is here is said though there is no bus to look at.
  const Ended nowhere = rave({"stop", "smell", "--interface", "nowhere0", "--multicast", "data"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_NE(nowhere.err.find("there is no run `smell`"), std::string::npos) << nowhere.err;
  EXPECT_NE(nowhere.err.find("cannot search on the bus"), std::string::npos) << nowhere.err;

  const Ended stopped = rave({"stop", "--robot", "anna"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_NE(stopped.out.find("stopped anna"), std::string::npos) << stopped.out;
  EXPECT_NE(rave({"ps"}).out.find("1 stopped"), std::string::npos);
  const Ended armed = rave({"arm", "--robot", "anna"});
  EXPECT_EQ(armed.exit_code, 1);
  EXPECT_NE(armed.err.find("--release"), std::string::npos) << armed.err;
  EXPECT_EQ(rave({"arm", "small", "--robot", "anna", "--release"}).exit_code, 0);
  EXPECT_EQ(rave({"ps"}).out.find("stopped"), std::string::npos);

  const Ended set = rave({"set", "anna", "program.cruise_mps", "0.1"});
  EXPECT_EQ(set.exit_code, 0) << set.err;
  EXPECT_NE(set.out.find("anna: program.cruise_mps: 0.3 -> 0.1"), std::string::npos) << set.out;
  const Ended wrong = rave({"set", "anna", "program.cruise_mps", "fast"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find("a number"), std::string::npos) << wrong.err;
  const Ended key = rave({"set", "anna", "program.crise_mps", "0.1", "--run", "small"});
  EXPECT_NE(key.err.find("did you mean `program.cruise_mps`"), std::string::npos) << key.err;
  EXPECT_EQ(rave({"set", "anna", "body.scale", "1.2"}).exit_code, 0);
  end();
  EXPECT_NE(events().find("program.cruise_mps: 0.3 -> 0.1 (by hand)"), std::string::npos);
  EXPECT_NE(content_of(output() + "/summary.txt").find("changed by people"), std::string::npos);
  EXPECT_EQ(rave({"ps"}).out, "no run is in progress\n");
}

TEST_F(Control, AStoppedRobotStandsFromTheNextStepOn) {
  start("good_scenario.yaml");
  EXPECT_EQ(rave({"stop", "--all"}).exit_code, 0);
  EXPECT_EQ(rave({"pause"}).exit_code, 0);
  EXPECT_NE(rave({"ps"}).out.find("paused, 3 stopped"), std::string::npos);
  EXPECT_EQ(rave({"step", "--count", "50"}).exit_code, 0);
  EXPECT_EQ(rave({"resume"}).exit_code, 0);
  end();
  EXPECT_NE(events().find("herd-1"), std::string::npos);
}

TEST_F(Control, ARunThatStartsPausedWaitsBeforeItsFirstStep) {
  start("good_scenario.yaml", {"--paused"});
  EXPECT_NE(rave({"ps"}).out.find(" 0.00 of "), std::string::npos) << rave({"ps"}).out;
  EXPECT_EQ(rave({"set", "anna", "body.scale", "1.2"}).exit_code, 0);
  EXPECT_EQ(rave({"step", "--count", "3"}).exit_code, 0);
  wait_until([&] { return rave({"ps"}).out.find(" 0.02 of ") != std::string::npos; });
  EXPECT_EQ(rave({"resume"}).exit_code, 0);
  wait_until([&] { return rave({"ps"}).out.find("running") != std::string::npos; });
  end();
  EXPECT_NE(content_of(output() + "/console.log").find("paused before the first step"),
            std::string::npos);
}

TEST_F(Control, ARunInRealTimeCannotStartPaused) {
  for (const char* const processes : {"1", "2"}) {
    const Ended ended = rave({"run", "live.yaml", "--processes", processes, "--paused", "--output",
                              output(), "--bus-tag", folder_.path().filename().string()});
    EXPECT_EQ(ended.exit_code, 2) << ended.out;
    EXPECT_NE(ended.err.find("the run cannot start paused: it is in real time: "),
              std::string::npos)
        << ended.err;
  }
}

TEST_F(Control, WhatWasDoneByHandIsDoneAgainByVerify) {
  start("good_scenario.yaml");
  EXPECT_EQ(rave({"pause"}).exit_code, 0);
  EXPECT_EQ(rave({"set", "anna", "program.cruise_mps", "0.1"}).exit_code, 0);
  EXPECT_EQ(rave({"set", "anna", "body.scale", "1.2"}).exit_code, 0);
  EXPECT_EQ(rave({"stop", "--robot", "herd-1"}).exit_code, 0);
  EXPECT_EQ(rave({"step", "--count", "50"}).exit_code, 0);
  EXPECT_EQ(rave({"arm", "--robot", "herd-1", "--release"}).exit_code, 0);
  EXPECT_EQ(rave({"resume"}).exit_code, 0);
  end();
  const Ended ended = rave({"verify", output()});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("equal: "), std::string::npos) << ended.out;
}

TEST_F(Control, EditsTheWorldAndVerifyDoesItAgain) {
  start("good_scenario.yaml");
  const Ended added = rave({"edit", "add", "box", "--name", "bale", "--at", "40,2,30", "--size",
                            "0.5x0.3", "--height", "0,0.8"});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("added `bale` at (40, 2)"), std::string::npos) << added.out;
  EXPECT_NE(added.out.find("counts from step "), std::string::npos) << added.out;
  EXPECT_NE(added.out.find(" ms after the request)"), std::string::npos) << added.out;
  const Ended listed = rave({"edit", "list"});
  EXPECT_NE(listed.out.find("bale"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("(40.000, 2.000) m, 30.0 deg"), std::string::npos) << listed.out;
  EXPECT_EQ(rave({"edit", "small", "move", "bale", "--at", "-40,1"}).exit_code, 0);
  EXPECT_EQ(rave({"edit", "add", "disc", "--name", "tube", "--at", "30,0", "--size", "0.25",
                  "--layer", "mapped_real", "--barcode", "8"})
                .exit_code,
            0);
  EXPECT_EQ(rave({"edit", "add", "polygon", "--name", "wedge", "--at", "30,9", "--corners",
                  "0,0 1,0 0.5,1"})
                .exit_code,
            0);
  EXPECT_EQ(rave({"edit", "remove", "tube"}).exit_code, 0);
  const Ended again = rave({"edit", "list"});
  EXPECT_EQ(again.out.find("tube"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("(-40.000, 1.000) m"), std::string::npos) << again.out;
  end();
  EXPECT_NE(events().find("obstacle added `bale`"), std::string::npos) << events();
  EXPECT_NE(events().find("obstacle removed `tube` (by hand)"), std::string::npos) << events();
  const Ended ended = rave({"verify", output()});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("equal: "), std::string::npos) << ended.out;
  // Who plays the record has the same world.
  const std::string played = folder_.path() / "played";
  ASSERT_EQ(rave({"play", output(), "--write", played}).exit_code, 0);
  EXPECT_NE(content_of(played + "/scenario.yaml").find("move_obstacle"), std::string::npos);
  const std::string again_in = folder_.path() / "again";
  const Ended run_again = rave({"run", played + "/scenario.yaml", "--output", again_in, "--quiet",
                                "--no-picture", "--pace", "max"});
  EXPECT_EQ(run_again.exit_code, 0) << run_again.err;
  EXPECT_NE(content_of(again_in + "/events.log").find("obstacle removed `tube`"),
            std::string::npos);
}

TEST_F(Control, EditsThatCannotBeDoneSayWhy) {
  start("good_scenario.yaml");
  const auto refused = [&](std::vector<std::string> words, int exit_code, const std::string& why) {
    words.insert(words.begin(), "edit");
    const Ended ended = rave(words);
    EXPECT_EQ(ended.exit_code, exit_code) << why;
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  };
  ASSERT_EQ(rave({"pause"}).exit_code, 0);
  ASSERT_EQ(
      rave({"edit", "add", "disc", "--name", "tube", "--at", "30,0", "--size", "1"}).exit_code, 0);
  refused({"remove", "tub"}, 1, "there is no obstacle `tub`; did you mean `tube`?");
  refused({"add", "disc", "--name", "tube", "--at", "30,9", "--size", "1"}, 1,
          "there already is an obstacle `tube`");
  refused({"add", "disc", "--name", "lid", "--at", "0,0", "--size", "90"}, 1,
          "would overlap the robot `anna`");
  refused({"add", "box", "--name", "flat", "--at", "30,9", "--size", "0x1"}, 1, "box_m");
  refused({"add", "box", "--name", "a b", "--at", "30,9", "--size", "1x1"}, 1, "name");
  refused({"add", "box", "--name", "far", "--at", "1e9,9", "--size", "1x1"}, 1, "x_m");
  refused({"add", "box", "--name", "crate", "--at", "30,9", "--size", "1"}, 2, "such as 0.5x0.3");
  refused({"add", "disc", "--name", "crate", "--at", "30", "--size", "1"}, 2, "X,Y or X,Y,DEG");
  refused({"add", "cone", "--name", "crate", "--at", "30,9"}, 2, "cone");
  refused({"move", "tube"}, 2, "--at");
  refused({"other-run", "list"}, 2, "other-run");
  end();
}

/// Another one, killed with the test.
struct OtherRun {
  pid_t process = -1;
  explicit OtherRun(pid_t started) : process(started) {}
  OtherRun(const OtherRun&) = delete;
  OtherRun& operator=(const OtherRun&) = delete;
  ~OtherRun() {
    if (process <= 0) return;
    ::kill(process, SIGKILL);
    static_cast<void>(wait_for(process));
  }
};

TEST_F(Control, OfTwoRunsOfOneScenarioOneIsChosenByItsProcess) {
  start("twins.yaml");
  const OtherRun other(start_rave({"run", "twins.yaml", "--output", output() + "-2", "--pace",
                                   "realtime", "--duration", "100000"},
                                  {setting_}));
  ASSERT_GT(other.process, 0);
  const std::string name = "twins-" + std::to_string(other.process);
  wait_until([&] {
    const std::string out = rave({"ps"}).out;
    const std::size_t running = out.find("running");
    return out.find(name) != std::string::npos && running != std::string::npos &&
           out.find("running", running + 1) != std::string::npos;
  });
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, std::vector<std::string>{"--run", "twins"}}) {
    std::vector<std::string> words = {"hand-over", "left", "twin"};
    words.insert(words.end(), how.begin(), how.end());
    const Ended asked = rave(words);
    EXPECT_NE(asked.exit_code, 0);
    for (const pid_t process : {process_, other.process}) {
      EXPECT_NE(asked.err.find("twins-" + std::to_string(process)), std::string::npos) << asked.err;
    }
    EXPECT_NE(asked.err.find("by its name or process id, such as `--run "), std::string::npos)
        << asked.err;
  }
  const Ended chosen = rave({"hand-over", "left", "twin", "--run", std::to_string(other.process)});
  EXPECT_EQ(chosen.exit_code, 0) << chosen.err;
  EXPECT_NE(chosen.out.find(name), std::string::npos) << chosen.out;
  end();
}

TEST_F(Control, AKilledRunLeavesNothingBehind) {
  start("good_scenario.yaml");
  ASSERT_EQ(::kill(process_, SIGKILL), 0);
  EXPECT_EQ(wait_for(process_), -1);
  process_ = -1;
  EXPECT_EQ(rave({"ps"}).out, "no run is in progress\n");
  EXPECT_TRUE(fs::is_empty(folder_.path() / "rave"));
}

TEST_F(Control, AnOpenFolderIsNotTrustedAndTheRunGoesOn) {
  fs::create_directory(folder_.path() / "rave");
  fs::permissions(folder_.path() / "rave", fs::perms::all);
  const Ended ended = rave({"run", "good_scenario.yaml", "--output", output()});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.err.find("this run cannot be controlled from other terminals"), std::string::npos)
      << ended.err;
}

}  // namespace
}  // namespace rave::cli_test
