// SPDX-License-Identifier: Apache-2.0
// Robots of several processes are stopped and released: what a terminal says is so at the hosts.
#include <sys/wait.h>

#include "bus_requests.hpp"

namespace rave::cli_test {
namespace {

class Stops : public BusRequests {
 protected:
  /// Whether `rave ps` says so of all processes here; `count` of them.
  [[nodiscard]] std::size_t lines_with(const std::string& text) const {
    const std::string out = near({"ps", "--robots"}).out;
    std::size_t count = 0;
    for (std::size_t at = 0; (at = out.find(text, at)) != std::string::npos; at += text.size()) {
      ++count;
    }
    return count;
  }
  /// Until no process says that a robot stands.
  void expect_released() {
    wait_until([this] { return lines_with("stopped") == 0; }, "nobody says stopped");
    EXPECT_NE(near({"ps"}).out.find("running"), std::string::npos);
  }
};

TEST_F(Stops, AReleaseReachesRobotsThatTheirHostsHaveStopped) {
  start_all("crowd.yaml", {"--duration", "100000", "--no-record", "--pace", "5x"});
  const Ended stopped = near({"stop", "--all"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  // Each robot in its host and in the manager, and a line for each process.
  wait_until([this] { return lines_with("stopped") == 30 + 30 + 3; }, "all say stopped");
  const Ended run = near({"arm"});
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_NE(run.err.find("stopped: 30 robots; a stop holds"), std::string::npos) << run.err;
  const Ended released = near({"arm", "--release"});
  EXPECT_EQ(released.exit_code, 0) << released.err;
  EXPECT_NE(released.out.find("released all robots; counts from step "), std::string::npos);
  expect_released();
  end_by_hand("env");
}

TEST_F(Stops, ALiveRunIsStoppedAndReleasedAtAllItsHosts) {
  start_all("live_twins.yaml", {"--no-record"});
  wait_for_line("env", "all hosts have joined");
  for (const bool from_far : {false, true}) {
    const auto rave = [&](const Words& words) { return from_far ? far(words) : near(words); };
    for (const Words& stop : from_far ? std::vector<Words>{{"stop", "live_twins"}}
                                      : std::vector<Words>{{"stop"}, {"stop", "--all"}}) {
      const Ended stopped = rave(stop);
      EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
      EXPECT_NE(stopped.out.find("@one"), std::string::npos) << stopped.out;
      EXPECT_NE(stopped.out.find("@two"), std::string::npos) << stopped.out;
      EXPECT_GE(lines_with("stopped"), 4U);
    }
    const Ended released = rave({"arm", "--release"});
    EXPECT_EQ(released.exit_code, 0) << released.err;
    EXPECT_NE(released.out.find("@one"), std::string::npos) << released.out;
    EXPECT_NE(released.out.find("@two"), std::string::npos) << released.out;
    expect_released();
    const Ended one = rave({"stop", "--robot", "left"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_NE(one.out.find("stopped left"), std::string::npos) << one.out;
    EXPECT_EQ(rave({"arm", "--release", "--robot", "left"}).exit_code, 0);
    expect_released();
  }
  end_by_hand("env", 1);
}

/// A host of the run that is not heard from here keeps its robots, and that is said.
TEST_F(Stops, AHostThatIsNotHereIsNotSaidToBeStopped) {
  start("env", "env", "live_twins.yaml", {"--no-record"});
  start_host("one", "live_twins.yaml", {"--no-record"});
  start_elsewhere("two", "live_twins.yaml");
  wait_for_line("env", "all hosts have joined");
  wait_until([this] { return near({"arm", "live_twins@one"}).exit_code == 0; }, "it serves");
  const Ended stopped = near({"stop"});
  EXPECT_EQ(stopped.exit_code, 1) << stopped.out;
  EXPECT_NE(stopped.out.find("@one"), std::string::npos) << stopped.out;
  EXPECT_NE(stopped.err.find("each host controls its own robots"), std::string::npos)
      << stopped.err;
  end_by_hand("env", 1);
}

TEST_F(Stops, AStopIsDoneWhileItIsStillLookedForOthersThatAreMeant) {
  start_all("crowd.yaml", {"--duration", "100000", "--no-record"});
  const auto times_asked = [this] {
    const std::string log = console("one");
    std::size_t times = 0;
    for (std::size_t at = 0; (at = log.find(R"("do": "stop")", at)) != std::string::npos; ++at) {
      ++times;
    }
    return times;
  };
  Words words = {"stop", "crowd"};
  for (const std::string& word : apart()) words.push_back(word);
  bool before_its_end = false;
  // On a busy machine a run may be found when the time for it is nearly over.
  for (int attempt = 0; attempt < 10 && !before_its_end; ++attempt) {
    const std::size_t before = times_asked();
    const pid_t asker = start_rave(words, {"XDG_RUNTIME_DIR=" + elsewhere_.path().string()});
    const auto goes_on = [asker] {
      siginfo_t ended{};
      return ::waitid(P_PID, static_cast<id_t>(asker), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
             ended.si_pid == 0;
    };
    wait_until([&] { return times_asked() > before || !goes_on(); }, "it is asked to stop");
    // Another run could still be found.
    before_its_end = goes_on();
    EXPECT_EQ(wait_for(asker), 0);
  }
  EXPECT_TRUE(before_its_end);
  end_by_hand("env");
}

}  // namespace
}  // namespace rave::cli_test
