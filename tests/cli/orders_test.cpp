// SPDX-License-Identifier: Apache-2.0
// People give orders to robots of a run from another terminal.
#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "paced_run.hpp"

namespace rave::cli_test {
namespace {

class Orders : public PacedRun {
 protected:
  void start(const std::vector<std::string>& more = {}) { PacedRun::start("orders.yaml", more); }
  void refused(const std::vector<std::string>& words, const std::string& why) const {
    const Ended ended = rave(words);
    EXPECT_EQ(ended.exit_code, 1) << ended.out;
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  }
  [[nodiscard]] bool happened(const std::string& text) const {
    return events().find(text) != std::string::npos;
  }
};

TEST_F(Orders, AreDoneAndDoneAgainByVerify) {
  start();
  const Ended sent = rave({"goal", "bert", "-2.5", "-3"});
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_NE(sent.out.find("bert is sent to -2.50, -3.00"), std::string::npos) << sent.out;
  EXPECT_EQ(rave({"goal", "carl", "3", "-2.8", "3.2", "-2.8", "--speed", "0.3"}).exit_code, 0);
  EXPECT_EQ(rave({"goal", "anna", "0.3", "-0.5"}).exit_code, 0);
  const Ended said = rave({"say", "carl", "hello"});
  EXPECT_EQ(said.exit_code, 0) << said.err;
  EXPECT_EQ(rave({"goal", "anna", "--cancel"}).exit_code, 0);
  const Ended driven = rave({"drive", "anna", "-0.1", "0.5", "--for", "0.5"});
  EXPECT_EQ(driven.exit_code, 0) << driven.err;
  EXPECT_NE(driven.out.find("the orders of people are cancelled"), std::string::npos) << driven.out;
  EXPECT_EQ(rave({"place", "anna", "2.5", "0.5", "90"}).exit_code, 0);
  std::this_thread::sleep_for(std::chrono::seconds(3));
  EXPECT_EQ(rave({"stop", "--robot", "bert"}).exit_code, 0);
  refused({"goal", "bert", "0", "0"}, "it is stopped");
  end();
  EXPECT_TRUE(happened("goal -2.50, -3.00 (by hand)")) << events();
  EXPECT_TRUE(happened("goal -2.50, -3.00: reached")) << events();
  EXPECT_TRUE(happened("I obey goals and paths, not texts.")) << events();
  EXPECT_TRUE(happened("I am at the end of the path.")) << events();
  EXPECT_TRUE(happened("drive -0.10 m/s, 0.50 rad/s (by hand)")) << events();
  EXPECT_TRUE(happened("place 2.50, 0.50, yaw 90 deg (by hand)")) << events();
  EXPECT_TRUE(happened("`terminal` drives")) << events();
  const Ended verified = rave({"verify", output()});
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_NE(verified.out.find("equal: "), std::string::npos) << verified.out;
  EXPECT_EQ(verified.out.find("is refused here"), std::string::npos) << verified.out;
}

TEST_F(Orders, AreRefusedWithASentence) {
  start({"--no-record"});
  refused({"goal", "ana", "0", "0"}, "did you mean `anna`");
  refused({"goal", "anna", "0", "2"}, "is inside the obstacle `wall`");
  refused({"goal", "anna", "1e6", "0"}, "is outside the world");
  refused({"place", "anna", "1", "1"}, "it would overlap `post`");
  refused({"goal", "bert", "0", "0", "1", "0"}, "its program takes no paths");
  refused({"say", "bert", "hello"}, "its program takes no texts");
  refused({"drive", "anna", "1000", "0"},
          "`v`: found the number 1000, expected a number (from -100 to 100)");
  EXPECT_EQ(rave({"goal", "anna"}).exit_code, 2);
  EXPECT_EQ(rave({"goal", "anna", "1"}).exit_code, 2);
  EXPECT_EQ(rave({"drive", "anna", "1"}).exit_code, 2);
  end();
  EXPECT_FALSE(happened("ordered"));
}

TEST_F(Orders, ADriverThatIsKilledLeavesARobotThatStandsAndThenItsProgram) {
  start({"--no-record"});
  const pid_t driver = start_rave({"drive", "bert", "0.3", "0", "--for", "3000"}, {setting_});
  ASSERT_GT(driver, 0);
  wait_until([&] {
    return rave({"ps", "--robots"}).out.find("`terminal` drives it") != std::string::npos;
  });
  ::kill(driver, SIGKILL);
  static_cast<void>(wait_for(driver));
  // The lease ends by itself.
  wait_until([&] {
    return rave({"ps", "--robots"}).out.find("`terminal` drives it") == std::string::npos;
  });
  end();
  EXPECT_TRUE(happened("cancel (by hand)")) << events();
  EXPECT_TRUE(happened("`terminal` no longer drives: no message came from them")) << events();
}

TEST_F(Orders, TwoTerminalsDoNotDriveOneRobot) {
  start({"--no-record"});
  const pid_t driver = start_rave({"drive", "bert", "0.3", "0", "--for", "3000"}, {setting_});
  ASSERT_GT(driver, 0);
  wait_until([&] {
    return rave({"ps", "--robots"}).out.find("`terminal` drives it") != std::string::npos;
  });
  refused({"drive", "bert", "-0.3", "0"}, "another terminal drives bert; `--force` takes it");
  refused({"goal", "bert", "0", "0"}, "another terminal drives bert; `--force` takes it");
  const Ended taken = rave({"drive", "bert", "-0.3", "0", "--for", "0.2", "--force"});
  EXPECT_EQ(taken.exit_code, 0) << taken.err;
  EXPECT_NE(taken.out.find("it was taken from another terminal"), std::string::npos) << taken.out;
  EXPECT_EQ(wait_for(driver), 1) << "it does not drive on when the other one has ended";
  end();
}

/// A person suspends the command, and somebody else goes on with the robot.
TEST_F(Orders, ADriveThatWasSuspendedEndsWhenItIsResumed) {
  start({"--no-record"});
  const pid_t driver = start_rave({"drive", "bert", "0.3", "0", "--for", "3000"}, {setting_});
  ASSERT_GT(driver, 0);
  const auto says = [&](const char* text) {
    return rave({"ps", "--robots"}).out.find(text) != std::string::npos;
  };
  wait_until([&] { return says("`terminal` drives it"); });
  ::kill(driver, SIGSTOP);
  EXPECT_EQ(rave({"stop", "--robot", "bert"}).exit_code, 0);
  EXPECT_EQ(rave({"arm", "--release"}).exit_code, 0);
  wait_until([&] { return !says("`terminal` drives it"); });
  ::kill(driver, SIGCONT);
  EXPECT_EQ(wait_for(driver), 1);
  EXPECT_FALSE(says("drive")) << rave({"ps", "--robots"}).out;
  end();
  const std::string told = events();
  const std::size_t drive = told.find("drive 0.30 m/s");
  ASSERT_NE(drive, std::string::npos);
  EXPECT_EQ(told.find("drive 0.30 m/s", drive + 1), std::string::npos) << told;
}

}  // namespace
}  // namespace rave::cli_test
