// SPDX-License-Identifier: Apache-2.0
// One `rave` controls another, as from another terminal.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <thread>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

/// A run in a process of its own, ended with the test.
class Control : public ::testing::Test {
 protected:
  void SetUp() override { setting_ = "XDG_RUNTIME_DIR=" + folder_.path().string(); }
  void TearDown() override {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    static_cast<void>(wait_for(process_));
  }

  void start(const std::string& scenario, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"run",    scenario,   "--output",   output(),
                                      "--pace", "realtime", "--duration", "100000"};
    words.insert(words.end(), more.begin(), more.end());
    process_ = start_rave(words, {setting_});
    ASSERT_GT(process_, 0);
    wait_until([&] { return rave({"ps"}).out.find("running") != std::string::npos; });
  }
  /// Gives up only when something is broken.
  template <class Holds>
  void wait_until(Holds&& holds) {
    for (int i = 0; i < 3000; ++i) {
      if (holds()) return;
      ASSERT_EQ(::waitpid(process_, nullptr, WNOHANG), 0) << "the run has ended";
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    FAIL() << "never";
  }
  [[nodiscard]] Ended rave(const std::vector<std::string>& words) const {
    return run_rave(words, {setting_});
  }
  void end() {
    ASSERT_EQ(::kill(process_, SIGINT), 0);
    EXPECT_EQ(wait_for(process_), 1);
    process_ = -1;
  }
  [[nodiscard]] std::string output() const { return folder_.path() / "results"; }
  [[nodiscard]] std::string events() const { return content_of(output() + "/events.log"); }

  TemporaryFolder folder_;
  std::string setting_;
  pid_t process_ = -1;
};

TEST_F(Control, WithoutARun) {
  EXPECT_EQ(rave({"ps"}).out, "no run is under way\n");
  const Ended ended = rave({"stop"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "rave: no run is under way\n");
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
  const Ended key = rave({"set", "small", "anna", "program.crise_mps", "0.1"});
  EXPECT_NE(key.err.find("did you mean `program.cruise_mps`"), std::string::npos) << key.err;
  EXPECT_EQ(rave({"set", "anna", "body.scale", "1.2"}).exit_code, 0);
  end();
  EXPECT_NE(events().find("program.cruise_mps: 0.3 -> 0.1 (by hand)"), std::string::npos);
  EXPECT_NE(content_of(output() + "/summary.txt").find("changed by hand"), std::string::npos);
  EXPECT_EQ(rave({"ps"}).out, "no run is under way\n");
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
  EXPECT_NE(ended.out.find("the same: "), std::string::npos) << ended.out;
}

TEST_F(Control, AKilledRunLeavesNothingBehind) {
  start("good_scenario.yaml");
  ASSERT_EQ(::kill(process_, SIGKILL), 0);
  EXPECT_EQ(wait_for(process_), -1);
  process_ = -1;
  EXPECT_EQ(rave({"ps"}).out, "no run is under way\n");
  EXPECT_TRUE(fs::is_empty(folder_.path() / "rave"));
}

TEST_F(Control, AnOpenFolderIsNotTrustedAndTheRunGoesOn) {
  fs::create_directory(folder_.path() / "rave");
  fs::permissions(folder_.path() / "rave", fs::perms::all);
  const Ended ended = rave({"run", "good_scenario.yaml", "--output", output()});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.err.find("no other terminal can control this run"), std::string::npos)
      << ended.err;
}

}  // namespace
}  // namespace rave::cli_test
