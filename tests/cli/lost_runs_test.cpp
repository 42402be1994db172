// SPDX-License-Identifier: Apache-2.0
// Runs that have lost their manager, hosts, or both: what goes on, what is said of it, and how it
// ends.
#include <unistd.h>

#include <csignal>
#include <sstream>

#include "onlooker.hpp"
#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;

class LostRuns : public SharedWorld {
 protected:
  void begin(const std::string& scenario = "crowd.yaml") {
    scenario_ = scenario;
    start("env", "env", scenario_, of_run({"--pace", pace_}));
    start_host("one", scenario_, of_run());
    start_host("two", scenario_, of_run());
    wait_for_steps(50);
  }
  [[nodiscard]] Words of_run(Words more = {}) const {
    more.insert(more.end(),
                {"--run", run_.text(), "--duration", duration_s_, "--no-record", "--no-picture"});
    return more;
  }
  /// A run that a second manager brings to its end; under the first one it goes so slowly that it
  /// does not end before that one is killed.
  void begin_to_be_ended(const std::string& scenario = "crowd.yaml") {
    duration_s_ = "100";
    pace_ = "realtime";
    begin(scenario);
  }
  /// So many more.
  void wait_for_steps(std::uint64_t count) {
    auto steps = StepListener::open(run_, apart());
    ASSERT_TRUE(steps) << steps.error().text();
    std::uint64_t first = 0;
    wait_until(
        [&] {
          (*steps)->listen();
          if (first == 0) first = (*steps)->step();
          return first > 0 && (*steps)->step() >= first + count;
        },
        std::to_string(count) + " steps");
  }
  void kill_process(const std::string& name) {
    signal(name, SIGKILL);
    EXPECT_EQ(end_of(name), -1) << name << " had ended before";
  }
  /// Runs `rave` to its end as somebody at this machine.
  [[nodiscard]] Ended rave(Words words, bool with_bus = true) const {
    if (with_bus) {
      for (const std::string& word : apart()) words.push_back(word);
    }
    return run_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()});
  }
  /// It ends as it was told to, which is no failure.
  void wait_for_end(const std::string& name) {
    wait_until([&] { return !runs(name); }, name + " ends");
    EXPECT_EQ(end_of(name), 0) << console(name);
  }

  std::string scenario_;
  std::string duration_s_ = "100000";
  std::string pace_ = "max";
  bus::RunId run_ = bus::RunId::random();
};

TEST_F(LostRuns, AManagerAndAHostKilledTogetherLeaveARunWithoutAHash) {
  begin_to_be_ended();
  kill_process("env");
  kill_process("one");
  wait_for_line("two", "the environment manager is lost");
  start("second", "env", scenario_, of_run({"--resume"}));
  start("again", "robot", scenario_, of_run({"--host", "one"}));
  EXPECT_EQ(end_of("second"), 1) << console("second");
  const auto json = result("second");
  EXPECT_EQ(json["hash"], nullptr);
  EXPECT_EQ(json["whole"], false);
  EXPECT_NE(json["problems"].dump().find("host `one` was absent from step 0 to step"),
            std::string::npos)
      << json["problems"];
  EXPECT_EQ(end_of("again"), 1);
  EXPECT_EQ(end_of("two"), 0) << console("two");
}

TEST_F(LostRuns, AManagerThatTakesOverHearsOfALossBeforeIt) {
  begin_to_be_ended(crowd_with_policy("restart", 5));
  kill_process("one");
  wait_for_line("env", "its robots stop until it is back");
  start("again", "robot", scenario_, of_run({"--host", "one"}));
  wait_for_line("env", "host `one` is back");
  wait_for_steps(50);
  kill_process("env");
  wait_for_line("two", "the environment manager is lost");
  // The policy lets it go on without --resume.
  start("second", "env", scenario_, of_run());
  EXPECT_EQ(end_of("second"), 1) << console("second");
  const auto json = result("second");
  EXPECT_EQ(json["hash"], nullptr);
  EXPECT_NE(json["problems"].dump().find("host `one`: was absent from step 0 to step"),
            std::string::npos)
      << json["problems"];
}

TEST_F(LostRuns, AForgottenHostIsNotTakenIntoANewRun) {
  begin();
  kill_process("env");
  kill_process("one");
  wait_for_line("two", "the environment manager is lost");
  Words words = of_run({"env", scenario_, "--output", folder("refused")});
  const Ended refused = rave(words);
  EXPECT_EQ(refused.exit_code, 2) << refused.out;
  EXPECT_NE(refused.err.find("of a run that lost its environment manager: --resume continues"),
            std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("`rave end crowd` ends it"), std::string::npos) << refused.err;
  // It was left alone.
  start("second", "env", scenario_, of_run({"--resume"}));
  start("again", "robot", scenario_, of_run({"--host", "one"}));
  wait_for_steps(50);
  EXPECT_TRUE(runs("two")) << console("two");
}

TEST_F(LostRuns, AForgottenHostInRealTimeIsNotTakenIntoANewRun) {
  start("env", "env", "live.yaml", of_run());
  for (const char* const host : {"one", "two"}) start_host(host, "live.yaml", of_run());
  wait_for_line("env", "all hosts have joined");
  wait_for_line("one", "the clock of the environment manager differs");
  kill_process("env");
  wait_for_line("one", "the environment manager is lost");
  const Ended refused = rave(of_run({"env", "live.yaml", "--output", folder("refused")}));
  EXPECT_EQ(refused.exit_code, 2) << refused.out;
  EXPECT_NE(refused.err.find("of a run that lost its environment manager: --resume continues"),
            std::string::npos)
      << refused.err;
  EXPECT_TRUE(runs("one")) << console("one");
  // Those of a run that goes end with its manager, too, and not by its signal.
  start("second", "env", "live.yaml", of_run({"--resume"}));
  wait_for_line("second", "takes over at");
  const Ended ended = rave({"end", "live"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  // By themselves, whether or not the host that was in no run yet counts as a part that is missing.
  for (const char* const who : {"second", "one", "two"}) EXPECT_NE(end_of(who), -1) << console(who);
}

TEST_F(LostRuns, AHostWhoseStarterWasKilledEndsUnlessThereIsAManager) {
  start("env", "env", "live.yaml", of_run());
  start_host("two", "live.yaml", of_run());
  const pid_t starter = ::fork();
  if (starter == 0) {
    Words words = of_run({"robot", "live.yaml", "--host", "one", "--with-parent",
                          "--wait-for-manager", "2", "--output", folder("one")});
    for (const std::string& word : apart()) words.push_back(word);
    static_cast<void>(start_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()}));
    for (;;) ::pause();
  }
  wait_for_line("env", "all hosts have joined");
  ::kill(starter, SIGKILL);
  EXPECT_EQ(wait_for(starter), -1);
  wait_for_line("one", "the process that started this host has ended");
  kill_process("env");
  wait_for_line("one", "no environment manager has taken its place");
  EXPECT_TRUE(runs("two")) << "it was started by hand, and waits without limit";
}

TEST_F(LostRuns, EndEndsARunWithItsHosts) {
  begin();
  const Ended ended = rave({"end", "crowd"}, false);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find(": ends"), std::string::npos) << ended.out;
  wait_for_end("env");
  for (const char* const host : {"one", "two"}) EXPECT_EQ(end_of(host), 0) << console(host);
  EXPECT_EQ(rave({"end", "crowd"}).exit_code, 2) << "there is none any more";
}

TEST_F(LostRuns, EndEndsForgottenHostsByTheirRunAndByTheirScenario) {
  begin();
  kill_process("env");
  wait_for_line("one", "the environment manager is lost");
  wait_for_line("two", "the environment manager is lost");
  const Ended by_run = rave({"end", run_.text()});
  EXPECT_EQ(by_run.exit_code, 0) << by_run.err;
  wait_for_end("one");
  wait_for_end("two");

  run_ = bus::RunId::random();
  begin();
  kill_process("env");
  wait_for_line("two", "the environment manager is lost");
  const Ended by_scenario = rave({"end", "crowd"});
  EXPECT_EQ(by_scenario.exit_code, 0) << by_scenario.err;
  wait_for_end("one");
  wait_for_end("two");
}

TEST_F(LostRuns, TheLogGivesTheCommandThatStartsALostHostAgain) {
  begin();
  kill_process("one");
  const std::string mark = "start it again with: rave ";
  wait_for_line("env", mark);
  const std::string log = console("env");
  const std::size_t from = log.find(mark) + mark.size();
  std::istringstream line(log.substr(from, log.find('\n', from) - from));
  Words words;
  for (std::string word; line >> word;) words.push_back(word);
  start_as_told("again", words);
  wait_for_line("env", "host `one` is back");
  wait_for_steps(50);
}

TEST_F(LostRuns, AStepOfAPausedRunWithADeadHostIsNotSaidToBeDone) {
  begin();
  ASSERT_EQ(rave({"pause", "crowd"}).out.substr(0, 6), "crowd-");
  kill_process("one");
  wait_for_line("env", "all hosts wait until it is back");
  wait_until(
      [this] { return rave({"ps"}).out.find("paused, waiting for one") != std::string::npos; },
      "the status says for whom it waits");
  const Ended step = rave({"step", "crowd", "--count", "5"});
  EXPECT_NE(step.out.find("5 steps requested; the run waits for one, which is late or lost"),
            std::string::npos)
      << step.out << step.err;
  // A host alone cannot be held, and does not say so.
  const Ended host = rave({"pause", "crowd@two"});
  EXPECT_EQ(host.exit_code, 1);
  EXPECT_NE(host.err.find("follows its environment manager"), std::string::npos) << host.err;
}

}  // namespace
}  // namespace rave::cli_test
