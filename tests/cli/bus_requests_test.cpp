// SPDX-License-Identifier: Apache-2.0
// Runs are asked from a machine that has none of their processes: all that it shares with them is
// the bus.
#include "bus_requests.hpp"

#include <dds/dds.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <future>
#include <memory>
#include <sstream>

#include "rave/bus/reader.hpp"
#include "rave/bus/request_box.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "stranger.hpp"

namespace rave::cli_test {
namespace {

TEST_F(BusRequests, WithoutARunItSaysWhereItHasLooked) {
  const Ended ended = far({"edit", "list"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("no run is in progress on this machine"), std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("--interface and --peer"), std::string::npos) << ended.err;
}

TEST_F(BusRequests, ARunInLockStepDoesWhatIsAskedFromElsewhere) {
  start_all("crowd.yaml", {"--duration", "100000", "--no-record"});
  const Ended added =
      far({"edit", "crowd", "add", "box", "--name", "bale", "--at", "40,2", "--size", "0.5x0.3"});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("crowd: added `bale` at (40, 2)"), std::string::npos) << added.out;
  EXPECT_NE(added.out.find("counts from step "), std::string::npos) << added.out;
  EXPECT_EQ(far({"edit", "move", "bale", "--at", "-40,1"}).exit_code, 0);
  EXPECT_EQ(far({"edit", "remove", "pillar"}).exit_code, 0);
  for (const Ended& listed : {far({"edit", "list"}), near({"edit", "list"})}) {
    EXPECT_NE(listed.out.find("(-40.000, 1.000) m"), std::string::npos) << listed.out;
    EXPECT_EQ(listed.out.find("pillar"), std::string::npos) << listed.out;
  }
  const Ended stopped = far({"stop", "--robot", "left-1"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_NE(stopped.out.find("stopped left-1; counts from step "), std::string::npos);
  EXPECT_EQ(far({"set", "right-2", "body.scale", "0.8"}).exit_code, 0);
  // Who asked, and what, is in the log of whoever was asked.
  EXPECT_TRUE(logged("env", R"({"rave": 2, "do": "stop", "robot": "left-1"})")) << console("env");
  EXPECT_TRUE(logged("env", R"({"rave": 2, "do": "edit", "edit": {"remove_obstacle": "pillar"}})"))
      << console("env");
  EXPECT_FALSE(logged("env", R"({"rave": 2, "do": "list"})"));

  refused({"edit", "remove", "pillar"}, "there is no obstacle `pillar`");
  refused({"stop", "--robot", "left-99"}, "there is no robot `left-99`");
  refused({"set", "left-1", "program.cruise_mps", "0.1"}, "are set at its host");
  const Ended there = far({"set", "left-1", "program.cruise_mps", "0.1", "--run", "crowd@one"});
  EXPECT_EQ(there.exit_code, 0) << there.err;
  EXPECT_TRUE(logged("one", R"({"rave": 2, "do": "set", "robot": "left-1")")) << console("one");
  const Ended nobody = far({"stop", "crowd@three"});
  EXPECT_EQ(nobody.exit_code, 2);
  EXPECT_NE(nobody.err.find("host `three` of the run was not found"), std::string::npos)
      << nobody.err;

  EXPECT_EQ(far({"pause"}).exit_code, 0);
  wait_until([&] { return near({"ps"}).out.find("paused") != std::string::npos; }, "it is paused");
  EXPECT_EQ(far({"step", "--count", "2"}).exit_code, 0);
  EXPECT_EQ(far({"resume"}).exit_code, 0);
  end_by_hand("env");
  EXPECT_EQ(end_of("one"), 0) << console("one");
  EXPECT_EQ(end_of("two"), 0) << console("two");
}

TEST_F(BusRequests, ARunInRealTimeDoesWhatIsAskedFromElsewhere) {
  start_all("live_twins.yaml", {"--no-record"});
  wait_for_line("env", "all hosts have joined");
  const Ended added =
      far({"edit", "add", "box", "--name", "bale", "--at", "0,5", "--size", "0.5x0.3"});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("in effect at all 2 hosts "), std::string::npos) << added.out;
  EXPECT_NE(near({"edit", "live_twins@two", "list"}).out.find("bale"), std::string::npos);
  EXPECT_NE(console("env").find(R"(over the bus: {"rave": 2, "do": "edit")"), std::string::npos);
  refused({"pause", "live_twins"}, "a live run cannot be paused");
  const Ended stopped = far({"stop", "live_twins@one"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_TRUE(logged("one", R"({"rave": 2, "do": "stop"})")) << console("one");
  end_by_hand("env", 1);
}

TEST_F(BusRequests, ARobotIsHandedOverByItsHostWhoeverAsks) {
  start_all("live_twins.yaml", {"--no-record"});
  wait_for_line("two", "handed over: simulated -> simulated");
  const Ended made = far({"hand-over", "left", "twin"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("@one: left: "), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("simulated -> simulated"), std::string::npos) << made.out;
  EXPECT_NE(console("one").find("handed over"), std::string::npos);
  refused({"hand-over", "left", "twin"}, "already has its");
  refused({"shadow", "--robot", "left"}, "has no shadow");
  end_by_hand("env", 1);
}

TEST_F(BusRequests, RunsOfOtherMachinesAreListedWhenTheyAreAskedFor) {
  start_all("crowd.yaml", {"--duration", "100000", "--no-record"});
  const std::string alone = "XDG_RUNTIME_DIR=" + elsewhere_.path().string();
  EXPECT_EQ(run_rave({"ps"}, {alone}).out, "no run is in progress\n");
  std::string name;
  std::string line;
  wait_until(
      [&] {
        std::istringstream lines(far({"ps", "--network"}).out);
        while (std::getline(lines, line) && line.find(" crowd ") == std::string::npos) {
        }
        // Behind the rule at its left.
        const std::size_t at = line.find(' ') + 1;
        name = line.substr(at, line.find(' ', at) - at);
        return line.find("running") != std::string::npos;
      },
      "it is listed");
  EXPECT_NE(line.find(" 30 "), std::string::npos) << line;
  std::array<char, 256> machine{};
  ASSERT_EQ(::gethostname(machine.data(), machine.size() - 1), 0);
  EXPECT_NE(line.find(machine.data()), std::string::npos) << line;
  EXPECT_EQ(far({"edit", name, "list"}).exit_code, 0) << name;
  Words words = {"ps", "--network", "--robots"};
  for (const std::string& word : apart()) words.push_back(word);
  const Ended listed = near(words);
  EXPECT_NE(listed.out.find("this one"), std::string::npos) << listed.out;

  // All means those of this machine.
  for (const Ended& stopped : {far({"stop", "--all"}), run_rave({"stop", "--all"}, {alone})}) {
    EXPECT_EQ(stopped.exit_code, 2) << stopped.out;
    EXPECT_NE(stopped.err.find("on this machine"), std::string::npos) << stopped.err;
    EXPECT_NE(stopped.err.find("rave ps --network"), std::string::npos) << stopped.err;
  }
  EXPECT_FALSE(logged("env", R"({"rave": 2, "do": "stop"})")) << console("env");
  end_by_hand("env");
}

TEST_F(BusRequests, OfSeveralRunsOneHasToBeNamed) {
  for (const char* const name : {"morning", "evening"}) {
    start(name, "env", "crowd.yaml", {"--run", name});
  }
  wait_until([this] { return logged_foreign("morning") && logged_foreign("evening"); },
             "both know of each other");
  const Ended unnamed = far_until({"edit", "list"}, "2 runs are in progress; name one");
  EXPECT_EQ(unnamed.exit_code, 2) << unnamed.err;
  // That of which there are two is done to neither; but a stop harms nobody.
  const Ended either = far_until({"pause", "crowd"}, "several runs of `crowd`: ");
  EXPECT_EQ(either.exit_code, 2) << either.err;
  EXPECT_NE(either.err.find("several runs of `crowd`: "), std::string::npos) << either.err;
  EXPECT_NE(either.err.find("name one by its number"), std::string::npos) << either.err;
  for (const Words& stop : {Words{"stop", "crowd"}, Words{"stop", "--robot", "left-1"}}) {
    const std::string asked =
        stop.size() == 2 ? R"({"rave": 2, "do": "stop"})" : R"("robot": "left-1")";
    wait_until(
        [&] {
          static_cast<void>(far(stop));
          return console("morning").find(asked) != std::string::npos &&
                 console("evening").find(asked) != std::string::npos;
        },
        "both are asked to stop");
  }
  // It waits for its hosts still, and says what it would say to those beside it.
  refused({"edit", "morning", "list"}, "morning: the run has not begun yet");
  const Ended third = far_until({"edit", "night", "list"}, "there is no run `night`");
  EXPECT_EQ(third.exit_code, 2);
  EXPECT_NE(third.err.find("there is no run `night`"), std::string::npos) << third.err;
}

/// A run whose processes are members of a set of keys.
class SecretRequests : public BusRequests {
 protected:
  SecretRequests() {
    EXPECT_EQ(run_rave({"keys", "new", folder("keys"), "env", "one", "two", "anna"}).exit_code, 0);
    EXPECT_EQ(run_rave({"keys", "new", folder("others"), "anna"}).exit_code, 0);
  }
  [[nodiscard]] Words with_keys(Words words, const std::string& member) const {
    words.insert(words.end(), {"--security", folder(member)});
    return words;
  }
  [[nodiscard]] Ended as_member(const Words& words) const {
    return far(with_keys(words, "keys/anna"));
  }
  void start_secretly(const std::string& scenario, const Words& more) {
    start("env", "env", scenario, with_keys(more, "keys/env"));
    start_host("one", scenario, with_keys(more, "keys/one"));
    start_host("two", scenario, with_keys(more, "keys/two"));
    wait_until([this] { return as_member({"edit", "list"}).exit_code == 0; }, "it runs");
  }
  /// It finds no run, or one of which it hears nothing, and says what may be wrong.
  void not_found(const Words& words) const {
    const Ended ended = far(words);
    EXPECT_EQ(ended.exit_code, 2) << ended.out;
    EXPECT_TRUE(ended.out.empty()) << ended.out;
    EXPECT_NE(ended.err.find("--security"), std::string::npos) << ended.err;
    EXPECT_TRUE(ended.err.find("no run of several processes is in progress") != std::string::npos ||
                ended.err.find("talk only to members of their set") != std::string::npos)
        << ended.err;
  }
};

TEST_F(SecretRequests, AMemberOfTheSetAloneReachesTheRun) {
  start_secretly("crowd.yaml", {"--duration", "100000", "--no-record"});
  not_found({"pause"});
  not_found({"hand-over", "left-1", "twin"});
  not_found(with_keys({"stop", "--robot", "left-1"}, "others/anna"));
  not_found(with_keys({"set", "right-2", "body.scale", "0.5"}, "others/anna"));
  EXPECT_FALSE(logged("env", "")) << console("env");
  EXPECT_EQ(near({"ps"}).out.find("paused"), std::string::npos);

  EXPECT_EQ(as_member({"pause"}).exit_code, 0);
  wait_until([&] { return near({"ps"}).out.find("paused") != std::string::npos; }, "it is paused");
  EXPECT_EQ(as_member({"resume"}).exit_code, 0);
  const Ended stopped = as_member({"stop", "--robot", "left-1"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_NE(stopped.out.find("stopped left-1; counts from step "), std::string::npos)
      << stopped.out;
  const Ended set = as_member({"set", "right-2", "body.scale", "0.8"});
  EXPECT_EQ(set.exit_code, 0) << set.err;
  EXPECT_TRUE(logged("env", R"({"rave": 2, "do": "stop", "robot": "left-1"})")) << console("env");
  end_by_hand("env");
}

TEST_F(SecretRequests, AHostInRealTimeHearsAMemberToo) {
  start_secretly("live_twins.yaml", {"--no-record"});
  wait_for_line("env", "all hosts have joined");
  const Ended stopped = as_member({"stop", "live_twins@one"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_TRUE(logged("one", R"({"rave": 2, "do": "stop"})")) << console("one");
  not_found({"stop"});
  end_by_hand("env", 1);
}

TEST_F(SecretRequests, WithKeysARunWithoutIsNotHeard) {
  start("env", "env", "crowd.yaml", {"--no-record", "--run", "open"});
  wait_until([this] { return far({"edit", "open", "list"}).exit_code == 1; }, "it answers");
  not_found(with_keys({"edit", "open", "list"}, "keys/anna"));
}

}  // namespace
}  // namespace rave::cli_test
