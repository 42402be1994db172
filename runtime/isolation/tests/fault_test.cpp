// SPDX-License-Identifier: Apache-2.0
// What the host is told when an isolated program goes wrong.

#include <sys/wait.h>

#include <thread>

#include "support.hpp"

namespace rave::isolation {
namespace {

/// The error of the first decision of `program`, which must come again on every later call.
Error decision_error(const std::string& program, double timeout_s = 60) {
  TestRobot robot;
  IsolationOptions options = options_for("faults", program);
  options.decide_timeout_s = timeout_s;
  const auto isolated = IsolatedProgram::start(options, robot.setup());
  if (!isolated) return isolated.error();
  robot.commands[0] = velocity_command(1, 2);
  Status status = (*isolated)->begin_decide(robot.item(0));
  if (status) status = (*isolated)->end_decide(robot.item(0));
  if (status) return Error{ErrorCode::kState, "no error", {}};
  EXPECT_EQ(robot.commands[0], velocity_command(1, 2));
  EXPECT_EQ((*isolated)->begin_decide(robot.item(1)).error().text(), status.error().text());
  EXPECT_EQ((*isolated)->end_decide(robot.item(1)).error().text(), status.error().text());
  EXPECT_EQ((*isolated)->process_id(), 0);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a zombie is left";
  return status.error();
}

Error start_error(const IsolationOptions& options) {
  TestRobot robot;
  const auto isolated = IsolatedProgram::start(options, robot.setup());
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), isolated ? 0 : -1);
  return isolated ? Error{ErrorCode::kState, "no error", {}} : isolated.error();
}

std::string who(const std::string& program) { return "program `" + program + "` of robot `anna` "; }

struct Crash {
  const char* program;
  const char* signal;
  const char* function;
};

class CrashTest : public testing::TestWithParam<Crash> {};

TEST_P(CrashTest, NamesSignalAndLine) {
  const auto [program, signal, function] = GetParam();
  const Error error = decision_error(program);
  EXPECT_EQ(error.code, ErrorCode::kPlugin);
  EXPECT_EQ(error.text(),
            who(program) + "crashed: " + signal + " at " + place_of(program) + " in " + function);
}

INSTANTIATE_TEST_SUITE_P(
    All, CrashTest,
    testing::Values(Crash{"null_pointer", "segmentation fault", "NullPointer::decide"},
                    Crash{"null_call", "segmentation fault", "NullCall::decide"},
                    Crash{"division", "arithmetic fault", "Division::decide"},
                    Crash{"abort", "abort", "Abort::decide"},
                    Crash{"bad_vector", "segmentation fault", "BadVector::decide"}),
    [](const auto& test) { return std::string(test.param.program); });

TEST(Fault, StackOverflowNamesTheRecursion) {
  const Error error = decision_error("stack_overflow");
  // Which line of the function touches the end of the stack is the compiler's choice.
  const std::string text = error.text();
  const std::string before = who("stack_overflow") +
                             "crashed: stack overflow at "
                             "runtime/isolation/tests/plugins/faults.cpp:";
  ASSERT_TRUE(text.starts_with(before)) << text;
  const int line = std::stoi(text.substr(before.size()));
  EXPECT_GE(line, line_of("stack_overflow") - 1) << text;
  EXPECT_LE(line, line_of("stack_overflow_end")) << text;
  EXPECT_TRUE(text.ends_with(" in StackOverflow::recurse")) << text;
}

TEST(Fault, ExceptionIsReportedAsItIsInTheHost) {
  const Error error = decision_error("throws");
  EXPECT_EQ(error.code, ErrorCode::kPlugin);
  EXPECT_EQ(error.text(), who("throws") + "threw an exception: no map");
}

TEST(Fault, EndlessLoopNamesItsLine) {
  const Error error = decision_error("endless", 0.75);
  EXPECT_EQ(error.code, ErrorCode::kTimeout);
  EXPECT_EQ(error.text(), who("endless") + "has not decided for 0.75 s; it was at " +
                              place_of("endless") + " in Endless::decide");
}

TEST(Fault, SleepNamesTheLineThatCalls) {
  const Error error = decision_error("sleeps", 0.75);
  EXPECT_EQ(error.code, ErrorCode::kTimeout);
  EXPECT_EQ(error.text(), who("sleeps") + "has not decided for 0.75 s; it was at " +
                              place_of("sleeps") + " in Sleeps::decide");
}

TEST(Fault, OtherWaysToGo) {
  EXPECT_EQ(decision_error("exits").text(), who("exits") + "exited with code 3");
  EXPECT_EQ(decision_error("killed").text(), who("killed") + "was killed by signal 9 (kill)");
  EXPECT_EQ(decision_error("closes_files").text(),
            who("closes_files") + "closed its connection to the host");
  EXPECT_EQ(decision_error("garbage").text(),
            who("garbage") + "sent a malformed message to its host");
}

TEST(Fault, WhatWasLoggedBeforeACrashIsNotLost) {
  TestRobot robot;
  const auto program = IsolatedProgram::start(options_for("faults", "last_words"), robot.setup());
  ASSERT_TRUE(program) << program.error().text();
  ASSERT_TRUE((*program)->begin_decide(robot.item(0)));
  EXPECT_FALSE((*program)->end_decide(robot.item(0)));
  EXPECT_EQ(robot.log, std::vector<std::string>{"this will not end well"});
}

TEST(Fault, ACrashedProgramCostsOnlyItsRobot) {
  TestRobot anna;
  TestRobot berta("berta");
  const auto bad = IsolatedProgram::start(options_for("faults", "null_pointer"), anna.setup());
  const auto good = IsolatedProgram::start(options_for("echo", "echo"), berta.setup());
  ASSERT_TRUE(bad && good);
  ASSERT_TRUE((*bad)->begin_decide(anna.item(0)));
  ASSERT_TRUE((*good)->begin_decide(berta.item(0)));
  EXPECT_FALSE((*bad)->end_decide(anna.item(0)));
  EXPECT_TRUE((*good)->end_decide(berta.item(0)));
}

TEST(Fault, ProgramDiedBetweenDecisions) {
  TestRobot robot;
  const auto program = IsolatedProgram::start(options_for("echo", "echo"), robot.setup());
  ASSERT_TRUE(program) << program.error().text();
  const int id = (*program)->process_id();
  ::kill(id, SIGKILL);
  siginfo_t info{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(id), &info, WEXITED | WNOWAIT), 0);
  const Status status = (*program)->begin_decide(robot.item(0));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().text(), who("echo") + "was killed by signal 9 (kill)");
}

/// The kernel tells a child when the thread that started it ends; that is not the host's end.
TEST(Fault, TheThreadThatStartedMayEnd) {
  TestRobot robot;
  Result<std::unique_ptr<IsolatedProgram>> program = fail(ErrorCode::kState, "not started");
  std::thread([&] {
    program = IsolatedProgram::start(options_for("echo", "echo"), robot.setup());
  }).join();
  ASSERT_TRUE(program) << program.error().text();
  for (std::uint32_t k = 0; k < 100; ++k) {
    ASSERT_TRUE((*program)->begin_decide(robot.item(k)));
    ASSERT_TRUE((*program)->end_decide(robot.item(k)));
  }
}

TEST(StartFault, ErrorOfTheProgram) {
  const Error error = start_error(options_for("faults", "start_error"));
  EXPECT_EQ(error.code, ErrorCode::kPlugin);
  EXPECT_EQ(error.text(), who("start_error") + "did not start: none");
}

TEST(StartFault, Crash) {
  EXPECT_EQ(start_error(options_for("faults", "start_crashes")).text(),
            who("start_crashes") + "crashed: segmentation fault at " + place_of("start_crashes") +
                " in StartCrashes::start");
}

TEST(StartFault, Hang) {
  IsolationOptions options = options_for("faults", "start_hangs");
  options.start_timeout_s = 2;
  const Error error = start_error(options);
  EXPECT_EQ(error.code, ErrorCode::kTimeout);
  EXPECT_EQ(error.text(), who("start_hangs") + "has not started for 2.0 s; it was at " +
                              place_of("start_hangs") + " in StartHangs::start");
}

TEST(StartFault, MissingFiles) {
  IsolationOptions options = options_for("echo", "echo");
  options.runner = "/nonexistent/runner";
  const Error runner = start_error(options);
  EXPECT_EQ(runner.code, ErrorCode::kNotFound);
  EXPECT_NE(runner.text().find("cannot start `/nonexistent/runner`: No such file"),
            std::string::npos)
      << runner.text();
  const Error plugin = start_error(options_for("missing", "echo"));
  EXPECT_EQ(plugin.code, ErrorCode::kNotFound);
  EXPECT_NE(plugin.text().find("missing.so"), std::string::npos) << plugin.text();
  const Error program = start_error(options_for("echo", "ecko"));
  EXPECT_EQ(program.code, ErrorCode::kNotFound);
  EXPECT_NE(program.text().find("ecko"), std::string::npos) << program.text();
}

TEST(StartFault, Timeouts) {
  IsolationOptions options = options_for("echo", "echo");
  options.decide_timeout_s = 0;
  EXPECT_EQ(
      start_error(options).text(),
      "program `echo` of robot `anna`: timeout of 0 s; expected more than 0 and at most 1e6 s");
}

}  // namespace
}  // namespace rave::isolation
