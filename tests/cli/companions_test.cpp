// SPDX-License-Identifier: Apache-2.0
// The other programs of a run: how they begin, and that nothing of them stays, however it ends.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Writes down its id, and those of a child in its group and of one that left the group; takes its
/// time to end, and ignores Ctrl-C.
constexpr const char* kFamily = R"(#!/bin/sh
trap '' INT
sleep 1000 & echo $! > "$1/near"
setsid sh -c 'echo $$ > "$0/far"; exec sleep 1000' "$1" &
echo $$ > "$1/self"
echo $$ > "$(dirname "$0")/self"
until [ -s "$1/far" ]; do sleep 0.02; done
echo "oops" >&2
echo "family ready with $COLOUR"
wait
)";

class CompanionsTest : public ::testing::Test {
 protected:
  CompanionsTest() {
    write("family.sh", kFamily);
    fs::permissions(folder_.path() / "family.sh", fs::perms(0755));
    output_ = folder_.path() / "out";
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  /// `more`: keys of the companion and of the scenario, each line on its own.
  std::string scenario(const std::string& companion, const std::string& more = "") const {
    write("scenario.yaml",
          fmt::format("name: crew\nduration_s: 1000\npace: realtime\n{}\nrobots:\n  - {{name: r, "
                      "file: {}/tests/cli/data/good_robot.yaml, poses: [[0, 0, 0], [5, 0, "
                      "0]]}}\ncompanions:\n  - {}\n",
                      more, RAVE_SOURCE_DIR, companion));
    return folder_.path() / "scenario.yaml";
  }
  [[nodiscard]] std::string family(const std::string& more = "") const {
    return "{name: family, command: [./family.sh, \"{work}\"], environment: {COLOUR: blue}, ready: "
           "family ready" +
           more + "}";
  }
  [[nodiscard]] Words words(const std::string& file, const Words& more = {}) const {
    Words all = {"run", file, "--output", output_, "--no-picture", "--no-record"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] Words variables() const { return {"XDG_RUNTIME_DIR=" + folder_.path().string()}; }

  template <class Holds>
  static void wait_until(Holds&& holds, const std::string& what) {
    for (int i = 0; i < 3000; ++i) {
      if (holds()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    FAIL() << "never: " << what;
  }
  /// The processes that the family wrote down.
  [[nodiscard]] std::vector<pid_t> ids() const {
    std::vector<pid_t> found;
    for (const char* const name : {"self", "near", "far"}) {
      const std::string text = content_of(output_ + "/companions/" + name);
      if (!text.empty()) found.push_back(std::stoi(text));
    }
    return found;
  }
  static bool runs(pid_t process) {
    const std::string stat = content_of(fmt::format("/proc/{}/stat", process));
    return !stat.empty() && stat[stat.find(')') + 2] != 'Z';
  }
  void expect_all_gone() const {
    ASSERT_EQ(ids().size(), 3U);
    for (const pid_t process : ids()) {
      wait_until([process] { return !runs(process); }, fmt::format("the end of {}", process));
    }
  }
  pid_t start(const Words& arguments) const {
    const pid_t process = start_rave(arguments, variables(), output_ + ".log");
    wait_until(
        [this] { return run_rave({"ps"}, variables()).out.find("crew") != std::string::npos; },
        "the run");
    return process;
  }

  TemporaryFolder folder_;
  std::string output_;
};

TEST_F(CompanionsTest, StartBeforeTheRunAndEndWithIt) {
  const Ended ended = run_rave(words(scenario(family()), {"--duration", "0.2"}), variables());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  expect_all_gone();
  // Both streams in one file, in their order.
  EXPECT_EQ(content_of(output_ + "/companions/family.log"), "oops\nfamily ready with blue\n");
  EXPECT_NE(ended.out.find("companions"), std::string::npos) << ended.out;
  // A second run needs a folder without the first, or replaces it.
  EXPECT_EQ(run_rave(words(scenario(family()), {"--duration", "0.2"}), variables()).exit_code, 2);
  EXPECT_EQ(run_rave(words(scenario(family()), {"--duration", "0.2", "--replace"}), variables())
                .exit_code,
            0);
  expect_all_gone();
}

TEST_F(CompanionsTest, EndAfterCtrlCInOneProcessAndInThree) {
  for (const Words& more :
       {Words{}, Words{"--processes", "2", "--bus-tag", folder_.path().filename().string()}}) {
    fs::remove_all(output_);
    const pid_t process = start(words(scenario(family()), more));
    for (const pid_t id : ids()) EXPECT_TRUE(runs(id)) << id;
    // A run whose hosts have not come yet is not complete.
    for (const char* const host : {"host-1", "host-2"}) {
      const std::string here = fmt::format("host `{}` is here", host);
      wait_until(
          [&] {
            return more.empty() || content_of(output_ + ".log").find(here) != std::string::npos ||
                   content_of(output_ + "/console.log").find(here) != std::string::npos;
          },
          here);
    }
    ::kill(process, SIGINT);
    EXPECT_EQ(wait_for(process), 0) << content_of(output_ + ".log");
    expect_all_gone();
  }
}

TEST_F(CompanionsTest, EndWhenRaveIsKilled) {
  const pid_t process = start(words(scenario(family())));
  ::kill(process, SIGKILL);
  EXPECT_EQ(wait_for(process), -1);
  expect_all_gone();
}

TEST_F(CompanionsTest, EndWhenTheRunCannotStart) {
  // A driver that does not exist is found after the companions have begun.
  const std::string file = scenario(family());
  std::string text = content_of(file);
  text.replace(text.find("{name: r, file"), 0,
               "{name: s, robot: {body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 1]}]}, sensors: "
               "[{name: x, driver: no_such}]}}\n  - ");
  write("scenario.yaml", text);
  const Ended ended = run_rave(words(file, {"--replace"}), variables());
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_NE(ended.err.find("no_such"), std::string::npos) << ended.err;
  // The shared folder is discarded with the run, the note of the family is not.
  const std::string note = content_of(folder_.path() / "self");
  ASSERT_FALSE(note.empty());
  wait_until([&] { return !runs(std::stoi(note)); }, "the end of the family");
}

TEST_F(CompanionsTest, OneThatDiesIsReportedAndTheRunGoesOn) {
  const std::string file =
      scenario("{name: brief, command: [sh, -c, \"echo up; exit 3\"], ready: up}");
  const Ended ended = run_rave(words(file, {"--duration", "1"}), variables());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(content_of(output_ + "/console.log").find("companion `brief` exited with code 3"),
            std::string::npos)
      << content_of(output_ + "/console.log");
}

TEST_F(CompanionsTest, OneThatDiesCanEndTheRun) {
  const pid_t process = start(words(scenario(family(", on_end: end_run"))));
  ::kill(ids().front(), SIGKILL);
  EXPECT_EQ(wait_for(process), 1);
  EXPECT_NE(content_of(output_ + "/console.log")
                .find("companion `family` was ended by signal 9; its output is in " + output_ +
                      "/companions/family.log; the run ends with it"),
            std::string::npos)
      << content_of(output_ + "/console.log");
  EXPECT_TRUE(fs::exists(output_ + "/result.json"));
  expect_all_gone();
}

TEST_F(CompanionsTest, TheRunFailsIfOneIsNotReady) {
  std::string file = scenario(
      "{name: slow, command: [sh, -c, \"echo waiting for light; exec sleep 1000\"], ready: now, "
      "ready_within_s: 0.3}");
  Ended ended = run_rave(words(file), variables());
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_NE(ended.err.find("scenario.yaml:8:12: companion `slow` did not say `now` within 0.3 s"),
            std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("is `waiting for light`"), std::string::npos) << ended.err;
  fs::remove_all(output_);
  file = scenario("{name: dead, command: [sh, -c, \"exit 4\"], ready: now, ready_within_s: 1000}");
  ended = run_rave(words(file), variables());
  EXPECT_NE(ended.err.find("companion `dead` exited with code 4 before it said `now`"),
            std::string::npos)
      << ended.err;
}

TEST_F(CompanionsTest, CheckFindsAProgramThatDoesNotExistAndStartsNone) {
  Ended ended = run_rave({"check", scenario("{name: m, command: [no-such-bridge]}")});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(
      ended.err.find("scenario.yaml:8:24: `command`: the program `no-such-bridge` of companion "
                     "`m` is neither beside rave nor in a folder of PATH"),
      std::string::npos)
      << ended.err;
  ended = run_rave({"check", scenario("{name: m, command: [./missing.sh]}")});
  EXPECT_NE(ended.err.find("/missing.sh` of companion `m` is not a file that can be executed"),
            std::string::npos)
      << ended.err;
  ended = run_rave({"check", scenario("{name: m, command: [touch, \"{scenario}/started\"]}")});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_FALSE(fs::exists(folder_.path() / "started"));
}

}  // namespace
}  // namespace rave::cli_test
