// SPDX-License-Identifier: Apache-2.0
// `kill -9` at random moments of a run in real time. RAVE_TEST_SEED and RAVE_KILL_ROUNDS say which
// moments, and how many.
#include <cmath>
#include <csignal>
#include <iostream>
#include <thread>

#include "kill_rounds.hpp"
#include "live_listener.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;
using std::chrono::milliseconds;

class LiveKill : public KillRound {
 protected:
  void SetUp() override {
    auto opened = LiveListener::open(run_, apart());
    ASSERT_TRUE(opened) << opened.error().text();
    listener_ = *std::move(opened);
  }
  /// A process of the run, under a name of its own.
  void begin(const std::string& who, const std::string& name) {
    Words words = of_run({});
    if (who != "env") words.insert(words.end(), {"--host", who});
    if (who == "env" && name != who) words.emplace_back("--resume");
    start(name, who == "env" ? "env" : "robot", "live.yaml", words);
  }
  void begin_all() {
    for (const char* const who : {"env", "one", "two"}) begin(who, who);
  }
  /// Kills it while the processes look for one another, or in the first seconds of the run.
  void kill_at_random(const std::string& name) {
    const auto after = chance_.up_to(milliseconds(2500));
    std::cout << "kill -9 " << name << " after " << after.count() << " us\n";
    std::this_thread::sleep_for(after);
    kill_process(name);
    listener_->listen();
  }
  [[nodiscard]] bool says(const std::string& name, const std::string& text) const {
    return console(name).find(text) != std::string::npos;
  }
  void hear_until(const std::function<bool()>& holds, const std::string& what) {
    wait_until(
        [&] {
          listener_->listen();
          return holds();
        },
        what);
  }
  void wait_until_it_moves(std::uint32_t robot) {
    const std::string name = "robot " + std::to_string(robot);
    hear_until([&] { return listener_->places.contains(robot); }, name + " is in the world");
    const LiveListener::Place from = listener_->places[robot];
    hear_until(
        [&] {
          const LiveListener::Place& now = listener_->places[robot];
          return std::hypot(now.x_m - from.x_m, now.y_m - from.y_m) > 0.05;
        },
        name + " moves");
  }
  void end_all(const Words& whom) {
    for (const std::string& who : whom) {
      signal(who, SIGINT);
      // A manager that is ended leaves the run to its hosts; a host that is ended has ended.
      const bool manages = who == "env" || who == "second";
      const int code = end_of(who);
      // One that came back may have noticed the end of the host before it, which is a loss.
      EXPECT_TRUE(who == "again" ? code == 0 || code == 1 : code == (manages ? 1 : 0))
          << code << who << console(who);
    }
  }

  std::unique_ptr<LiveListener> listener_;
};

class ALiveHostIsKilled : public LiveKill {};

TEST_P(ALiveHostIsKilled, TheOthersGoOnAndItComesBack) {
  const std::uint32_t robot = chance_.one_in(2) ? 0 : 1;
  const std::string victim = robot == 0 ? "one" : "two";
  const std::string other = robot == 0 ? "two" : "one";
  begin_all();
  kill_at_random(victim);
  const bool goes = says("env", "all hosts have joined");
  const bool known = listener_->places.contains(robot);
  std::cout << (goes ? "the run goes\n" : "the run has not begun\n");
  if (goes) wait_for_line("env", "host `" + victim + "` is gone");
  if (known) hear_until([&] { return listener_->stale.contains(robot); }, "it is stale");
  if (goes) wait_until_it_moves(1 - robot);
  begin(victim, "again");
  if (known) hear_until([&] { return !listener_->stale.contains(robot); }, "it is heard of again");
  wait_until_it_moves(robot);
  wait_until_it_moves(1 - robot);
  end_all({other, "again", "env"});
  expect_whole_record(other);
  expect_whole_record("again");
  expect_readable_record(victim, 0);
}
INSTANTIATE_TEST_SUITE_P(Round, ALiveHostIsKilled, ::testing::Range(0, kill_rounds()));

class ALiveManagerIsKilled : public LiveKill {};

TEST_P(ALiveManagerIsKilled, TheHostsGoOnAndTheNextOneKnowsTheTime) {
  begin_all();
  kill_at_random("env");
  const LiveListener::WorldTime before =
      listener_->worlds.empty() ? LiveListener::WorldTime{} : listener_->worlds.back();
  const bool goes = before.time_ns > 0;
  std::cout << (goes ? "the run goes\n" : "the run has not begun\n");
  const bool noticed = goes && chance_.one_in(2);
  if (noticed) {
    for (const char* const host : {"one", "two"}) {
      wait_for_line(host, "the environment manager is lost");
      wait_for_line(host, "no world has arrived for");
    }
  }
  begin("env", "second");
  if (goes) wait_for_line("second", "takes over at");
  hear_until(
      [&] {
        return !listener_->worlds.empty() && listener_->worlds.back().manager != before.manager;
      },
      "a new world");
  if (goes) {
    EXPECT_GT(listener_->worlds.back().time_ns, before.time_ns) << "the time of the run goes on";
  }
  for (const std::uint32_t robot : {0U, 1U}) {
    hear_until(
        [&] {
          const auto place = listener_->places.find(robot);
          return place != listener_->places.end() && place->second.stamp_ns > before.time_ns;
        },
        "it is heard of");
    wait_until_it_moves(robot);
  }
  end_all({"one", "two", "second"});
  for (const char* const host : {"one", "two"}) {
    expect_whole_record(host);
    if (noticed) {
      EXPECT_GE(result(host)["world_losses"], 1) << host;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Round, ALiveManagerIsKilled, ::testing::Range(0, kill_rounds()));

}  // namespace
}  // namespace rave::cli_test
