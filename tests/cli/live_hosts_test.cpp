// SPDX-License-Identifier: Apache-2.0
// One world over several processes in real time, started as users would start them.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>

#include "live_listener.hpp"
#include "onlooker.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "rave/run_testing/recorded_run.hpp"
#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;
constexpr std::uint32_t kLeft = 0;   // on host `one`
constexpr std::uint32_t kRight = 1;  // on host `two`

class LiveHosts : public SharedWorld {
 protected:
  void SetUp() override {
    auto opened = LiveListener::open(run_, apart());
    ASSERT_TRUE(opened) << opened.error().text();
    listener_ = *std::move(opened);
  }
  void begin(const std::string& who) { begin(who, who); }
  /// A process of the run, under a name of its own.
  void begin(const std::string& who, const std::string& name) {
    Words words = {"--run", run_.text()};
    if (who != "env") words.insert(words.end(), {"--host", who});
    if (who == "env" && name != who) words.emplace_back("--resume");
    start(name, who == "env" ? "env" : "robot", "live.yaml", words);
  }
  void begin_all() {
    for (const char* const who : {"env", "one", "two"}) begin(who);
    hear_until([this] { return listener_->places.size() == 2; }, "both robots are in the world");
  }
  void hear_until(const std::function<bool()>& holds, const std::string& what) {
    wait_until(
        [&] {
          listener_->listen();
          return holds();
        },
        what);
  }
  [[nodiscard]] double way_from(std::uint32_t robot, const LiveListener::Place& from) const {
    const LiveListener::Place& now = listener_->places.at(robot);
    return std::hypot(now.x_m - from.x_m, now.y_m - from.y_m);
  }
  void wait_until_it_moves(std::uint32_t robot) {
    const LiveListener::Place from = listener_->places.at(robot);
    hear_until([&] { return way_from(robot, from) > 0.1; },
               "robot " + std::to_string(robot) + " moves");
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
  /// What a robot's laser read straight ahead, as its host recorded it.
  [[nodiscard]] std::vector<float> ahead(const std::string& host, const std::string& robot) {
    std::vector<float> all;
    auto readings = readings_of(folder(host) + "/run.mcap");
    for (const Reading& reading : readings[robot + "/laser"]) {
      const std::string& bytes = std::get<3>(reading);
      std::vector<float> ranges(bytes.size() / sizeof(float));
      std::memcpy(ranges.data(), bytes.data(), ranges.size() * sizeof(float));
      if (!ranges.empty()) all.push_back(ranges[ranges.size() / 2]);
    }
    return all;
  }

  bus::RunId run_ = bus::RunId::random();
  std::unique_ptr<LiveListener> listener_;
};

TEST_F(LiveHosts, EachSeesTheRobotsOfTheOther) {
  begin_all();
  wait_until_it_moves(kLeft);
  wait_until_it_moves(kRight);
  hear_until(
      [this] { return listener_->hosts.contains("two") && listener_->hosts["two"].bound_s > 0; },
      "the offset of a clock is known");
  EXPECT_LT(std::abs(listener_->hosts["two"].offset_s), 0.1) << "on one machine there is one clock";
  end_all({"one", "two", "env"});
  // At the start they face one another, 3 m apart; the walls behind are 4.5 m off.
  for (const auto& [host, robot] : {std::pair("one", "left"), std::pair("two", "right")}) {
    const auto result = this->result(host);
    EXPECT_EQ(result["hash"], nullptr);
    EXPECT_EQ(result["no_hash_because"], "the scenario says `clock: real_time`");
    EXPECT_GT(result["worlds"], 0);
    EXPECT_TRUE(result["clock_bound_s"].is_number()) << result.dump();
    std::vector<float> first = ahead(host, robot);
    ASSERT_GT(first.size(), 10U);
    first.resize(std::min<std::size_t>(first.size(), 100));
    EXPECT_LT(*std::min_element(first.begin(), first.end()), 2.9F);
  }
  const auto managed = result("env");
  ASSERT_EQ(managed["hosts"].size(), 2U);
  for (const auto& host : managed["hosts"]) {
    EXPECT_EQ(host["found"], true) << "they were interrupted while it was there: " << host;
  }
  ASSERT_EQ(managed["robots"].size(), 2U) << managed.dump(1);
  EXPECT_NE(console("one").find("clock of the environment manager"), std::string::npos);
}

/// Nanoseconds from one to the next in the mean of the last `count`; 0 if there are fewer.
double mean_ns(const std::vector<std::int64_t>& stamps_ns, std::size_t count) {
  if (stamps_ns.size() < count) return 0;
  const std::int64_t span_ns = stamps_ns.back() - stamps_ns[stamps_ns.size() - count];
  return static_cast<double>(span_ns) / static_cast<double>(count - 1);
}

bool within_a_twentieth(double found, double wanted) {
  return std::abs(found - wanted) <= 0.05 * wanted;
}

TEST_F(LiveHosts, RobotsReportAndWorldsComeAtTheRatesOfTheirFiles) {
  begin_all();
  constexpr std::size_t kCount = 40;
  const auto world_ns = [this] {
    // Some that were sent in a hurry may have been overwritten by the next before they were read.
    const auto& worlds = listener_->worlds;
    if (worlds.size() < kCount) return 0.0;
    const auto& first = worlds[worlds.size() - kCount];
    const auto& last = worlds.back();
    return static_cast<double>(last.time_ns - first.time_ns) /
           static_cast<double>(last.number - first.number);
  };
  // On a machine that does other things at the same time, not in each span.
  hear_until([&] { return within_a_twentieth(world_ns(), 50e6); }, "20 worlds a second");
  hear_until(
      [&] { return within_a_twentieth(mean_ns(listener_->stamps_ns[kLeft], kCount), 100e6); },
      "10 reports of `left` a second");
  hear_until(
      [&] { return within_a_twentieth(mean_ns(listener_->stamps_ns[kRight], kCount), 40e6); },
      "25 reports of `right` a second");
}

TEST_F(LiveHosts, RobotsOfAKilledHostAreStaleUntilItIsBackWhereTheyWere) {
  begin_all();
  wait_until_it_moves(kLeft);
  signal("one", SIGKILL);
  EXPECT_EQ(end_of("one"), -1);
  wait_for_line("env", "robot `left` is stale");
  wait_for_line("two", "robot left");
  wait_for_line("two", "pose stale");
  hear_until([this] { return listener_->stale == std::set<std::uint32_t>{kLeft}; },
             "`left` is stale");
  wait_for_line("env", "host `one` is gone");
  wait_until_it_moves(kRight);

  const LiveListener::Place last = listener_->places[kLeft];
  begin("one", "again");
  wait_for_line("env", "host `one` is back");
  wait_for_line("env", "robot `left` is back");
  wait_for_line("two", "pose back");
  hear_until([&] { return listener_->places[kLeft].stamp_ns > last.stamp_ns; }, "it is heard of");
  EXPECT_LT(way_from(kLeft, last), 0.3) << "it goes on where it was";
  hear_until([this] { return listener_->stale.empty(); }, "nobody is stale");
  wait_until_it_moves(kLeft);
  EXPECT_NE(console("again").find("joins at"), std::string::npos);
  end_all({"env", "again", "two"});
  EXPECT_EQ(result("env")["hosts"][0]["losses"], 1);
  EXPECT_EQ(result("env")["hosts"][1]["losses"], 0);
}

TEST_F(LiveHosts, AManagerThatIsKilledIsMissedAndReplaced) {
  begin_all();
  wait_until_it_moves(kLeft);
  const LiveListener::WorldTime before = listener_->worlds.back();
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "no world has arrived for");
  wait_for_line("one", "the environment manager is lost");
  // The guard of the robot does what its file says.
  wait_for_line("one", "world lost");

  begin("env", "second");
  wait_for_line("second", "takes over at");
  for (const char* const host : {"one", "two"}) wait_for_line(host, "worlds arrive again");
  hear_until([&] { return listener_->worlds.back().manager != before.manager; }, "a new world");
  EXPECT_GT(listener_->worlds.back().time_ns, before.time_ns) << "the time of the run goes on";
  hear_until([&] { return listener_->places[kLeft].stamp_ns > before.time_ns; }, "`left` is there");
  wait_until_it_moves(kLeft);
  wait_until_it_moves(kRight);
  end_all({"one", "two", "second"});
  EXPECT_GE(result("one")["world_losses"], 1);
}

TEST_F(LiveHosts, AHostThatIsInterruptedLeavesInOrder) {
  begin_all();
  end_all({"one"});
  EXPECT_TRUE(result("one")["problems"].empty()) << result("one")["problems"];
  EXPECT_EQ(result("one")["ending"].get<std::string>().rfind("ended by hand at ", 0), 0U)
      << result("one")["ending"];
  wait_for_line("env", "host `one` is gone");
  wait_until_it_moves(kRight);
  end_all({"two", "env"});
  const std::string problems = result("env")["problems"].dump();
  EXPECT_NE(problems.find("host `one` ended at "), std::string::npos) << problems;
}

TEST_F(LiveHosts, HostsWaitForTheManagerAndForEachOther) {
  begin("one");
  wait_for_line("one", "waits for the environment manager");
  begin("env");
  wait_for_line("one", "waiting for two");
  begin("two");
  wait_for_line("env", "all hosts have joined");
  hear_until([this] { return listener_->places.size() == 2; }, "both robots are in the world");
  EXPECT_EQ(console("one").find("begins at"), std::string::npos) << "both begin with the run";
  end_all({"one", "two", "env"});
}

TEST_F(LiveHosts, RunStartsAllAndEndsInTime) {
  start("run", "run", "live.yaml", {"--duration", "1.5"});
  EXPECT_EQ(end_of("run"), 0) << console("run");
  const auto result = this->result("run");
  EXPECT_EQ(result["whole"], true) << result.dump();
  EXPECT_EQ(result["hash"], nullptr);
  EXPECT_EQ(result["no_hash_because"], "the scenario says `clock: real_time`");
  EXPECT_GE(result["worlds"], 20);
  for (const char* const host : {"one", "two"}) {
    EXPECT_EQ(this->result(std::string("run/hosts/") + host)["whole"], true) << host;
  }
  ASSERT_EQ(result["robots"].size(), 2U) << result.dump();
  EXPECT_EQ(result["robots"][0]["name"], "left");
  EXPECT_GT(result["robots"][1]["commands"], 0);
  EXPECT_EQ(result["hosts"][1]["found"], true);
  const Ended info = run_rave({"info", folder("run"), "--json"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  const auto record = nlohmann::json::parse(info.out, nullptr, false);
  EXPECT_EQ(record["parts"].size(), 2U) << info.out;
  EXPECT_EQ(record["hash"], nullptr);
  for (const char* const robot : {"left", "right"}) {
    EXPECT_GT(readings_of(folder("run") + "/run.mcap")[std::string(robot) + "/laser"].size(), 10U);
  }
}

TEST_F(LiveHosts, ARunThatIsInterruptedEndsItsHosts) {
  start("run", "run", "live.yaml");
  wait_for_line("run", "all hosts have joined");
  signal("run", SIGINT);
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_TRUE(result("run")["ended_by_hand_s"].is_number()) << result("run");
  for (const char* const host : {"one", "two"}) {
    EXPECT_EQ(result(std::string("run/hosts/") + host)["whole"], true) << host;
  }
}

TEST_F(LiveHosts, InOneProcessItIsInRealTimeToo) {
  start("alone", "run", "live.yaml", {"--duration", "0.3", "--processes", "1", "--no-picture"});
  EXPECT_EQ(end_of("alone"), 0) << console("alone");
  EXPECT_EQ(result("alone")["no_hash_because"], "the scenario says `clock: real_time`");
}

TEST_F(LiveHosts, WhoLooksAtNobodyNeedsNoManager) {
  start("run", "run", "blind.yaml");
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_EQ(result("run")["worlds"], 0);
  for (const char* const host : {"one", "two"}) {
    const auto result = this->result(std::string("run/hosts/") + host);
    EXPECT_EQ(result["whole"], true) << result.dump();
    EXPECT_EQ(result["clock_offset_s"], nullptr);
  }
  const Ended env = run_rave({"env", "blind.yaml", "--output", folder("env")});
  EXPECT_EQ(env.exit_code, 2);
  EXPECT_NE(env.err.find("needs no environment manager"), std::string::npos) << env.err;
}

TEST_F(LiveHosts, WhoLooksAtNobodyIsNotSentTheWorld) {
  start("run", "run", "half.yaml");
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_EQ(result("run/hosts/one")["worlds"], 0);
  EXPECT_TRUE(result("run/hosts/one")["clock_bound_s"].is_number());
  EXPECT_GT(result("run/hosts/two")["worlds"], 5);
  const std::vector<float> seen = ahead("run/hosts/two", "eye");
  ASSERT_GT(seen.size(), 50U);
  // It drives towards the stone, of which it sees the near side.
  EXPECT_LT(*std::min_element(seen.begin(), seen.end()), 1.9F);
}

TEST_F(LiveHosts, ASecondProcessForAHostIsNotLetIn) {
  begin_all();
  begin("one", "second");
  // Of the two the one that is there stays, whichever process finds out.
  const auto has_ended = [this] {
    const std::string stat = content_of("/proc/" + std::to_string(id_of("second")) + "/stat");
    return stat.find(") Z ") != std::string::npos;
  };
  wait_until(
      [&] {
        return has_ended() ||
               console("env").find("host 0 is already served by process") != std::string::npos;
      },
      "the second one is refused");
  wait_until_it_moves(kLeft);
  ::kill(id_of("second"), SIGKILL);
  end_all({"one", "two", "env"});
}

TEST_F(LiveHosts, ARobotThatIsThereAlreadyIsRefusedWithOneLine) {
  begin_all();
  auto stranger = join_as_onlooker(run_, apart(), true);
  ASSERT_TRUE(stranger) << stranger.error().text();
  auto roster = bus::Writer<bus::RosterEntry>::create(**stranger);
  ASSERT_TRUE(roster) << roster.error().text();
  for (const std::uint32_t robot : {kLeft, kRight}) {
    bus::RosterEntry entry{};
    entry.robot = robot;
    entry.host = robot;
    bus::put_text(entry.name, robot == kLeft ? "left" : "right");
    ASSERT_TRUE(roster->write(entry));
  }
  wait_for_line("env", ": its host `");
  wait_until_it_moves(kLeft);
  end_all({"one", "two", "env"});
  const std::string said = console("env");
  const std::size_t first = said.find("a second robot `");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("a second robot `", first + 1), std::string::npos) << said;
}

}  // namespace
}  // namespace rave::cli_test
