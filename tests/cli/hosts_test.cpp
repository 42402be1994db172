// SPDX-License-Identifier: Apache-2.0
// One world over several processes, started as users would start them.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "shared_world.hpp"
#include "wrong_host.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class Hosts : public SharedWorld {
 protected:
  /// Starts a manager and the two hosts of `crowd`, which would take longer than any test.
  void start_crowd(const Words& more) {
    Words words = more;
    words.insert(words.end(), {"--duration", "100000"});
    start("env", "env", scenario_, words);
    start_host("one", scenario_, words);
    start_host("two", scenario_, words);
    wait_for_steps();
  }
  /// Until the record of a host shows that the run goes.
  void wait_for_steps() {
    for (const char* const host : {"one", "two"}) {
      wait_until([&] { return record_size(host) > 100'000; }, std::string(host) + " runs");
    }
  }
  [[nodiscard]] std::uintmax_t record_size(const std::string& host) const {
    std::error_code error;
    const auto size = fs::file_size(folder(host) + "/run.mcap", error);
    return error ? 0 : size;
  }
  void wait_for_more(const std::string& host) {
    const auto before = record_size(host);
    wait_until([&] { return record_size(host) > before + 100'000; }, host + " goes on");
  }
  /// The crowd with checks of what nobody but the world as a whole can tell; its file.
  [[nodiscard]] std::string checked_crowd() const {
    std::string path = crowd_with_policy("wait", 5);
    std::ofstream(path, std::ios::app)
        << "checks:\n"
           "  capture: {predator: left, prey: right, within_m: 0.05, before_s: 40}\n"
           "  touches: [{robots: [left], most: 1000000, least: 1}]\n";
    return path;
  }
  /// result.json without what is of the processes.
  [[nodiscard]] nlohmann::json result_of(const std::string& name) const {
    nlohmann::json json = result(name);
    json.erase("wall_s");
    json.erase("hosts");
    return json;
  }
  void write_policy(const std::string& policy, double timeout_s) {
    scenario_ = crowd_with_policy(policy, timeout_s);
  }

  std::string scenario_ = "crowd.yaml";
};

TEST_F(Hosts, TwoHostsGiveTheHashOfOneProcess) {
  const std::string alone = hash_alone("crowd.yaml", {});
  ASSERT_EQ(alone.size(), 16U);
  start("run", "run", "crowd.yaml");
  EXPECT_EQ(end_of("run"), 0) << console("run");
  const auto result = this->result("run");
  EXPECT_EQ(result["hash"], alone);
  EXPECT_EQ(result["whole"], true);
  EXPECT_EQ(result["steps"], 300);
  EXPECT_GT(result["events"]["contact"], 0);
  for (const char* const host : {"one", "two"}) {
    EXPECT_EQ(this->result(std::string("run/hosts/") + host)["whole"], true) << host;
    EXPECT_TRUE(fs::exists(folder(std::string("run/hosts/") + host + "/run.mcap")));
  }
}

TEST_F(Hosts, AnySplitAndAnyOrderOfStartGiveTheSame) {
  const Words span = {"--duration", "4"};
  const std::string alone = hash_alone("flock", span);
  ASSERT_EQ(alone.size(), 16U);
  // Hosts first, the manager last; the other way round; in between.
  const std::vector<Words> orders = {{"host-3", "host-1", "host-2", "env"},
                                     {"env", "host-2", "host-3", "host-1"},
                                     {"host-2", "env", "host-1", "host-3"}};
  for (const Words& order : orders) {
    Words words = span;
    words.insert(words.end(), {"--processes", "3"});
    for (const std::string& who : order) {
      if (who == "env") {
        start("env", "env", "flock", words);
      } else {
        start_host(who, "flock", words);
      }
    }
    for (const std::string& who : order) EXPECT_EQ(end_of(who), 0) << who << console(who);
    EXPECT_EQ(result("env")["hash"], alone);
  }
}

TEST_F(Hosts, AFlockOfTwoProcessesIsThatOfOne) {
  const std::string alone = hash_alone("flock", {"--duration", "4"});
  start("run", "run", "flock", {"--duration", "4", "--processes", "2"});
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_EQ(result("run")["hash"], alone);
}

TEST_F(Hosts, RecordedRealRobotsAndSimulatedOnesOnDifferentHosts) {
  const Words span = {"--duration", "4"};
  const std::string alone = hash_alone("mixed-reality", span);
  ASSERT_EQ(alone.size(), 16U);
  Words words = span;
  words.insert(words.end(), {"--processes", "4"});
  start("run", "run", "mixed-reality", words);
  EXPECT_EQ(end_of("run"), 1) << "as in one process, the check needs more sightings";
  EXPECT_EQ(result("run")["hash"], alone);
}

TEST_F(Hosts, AHostLoadsItsOwnPluginsAndTheManagerNone) {
  Words words = {"--duration", "100000", "--processes", "2", "--no-record"};
  start("env", "env", "mixed-reality", words);
  start_host("host-1", "mixed-reality", words);
  start_host("host-2", "mixed-reality", words);
  const auto maps = [this](const std::string& who) {
    return content_of("/proc/" + std::to_string(id_of(who)) + "/maps");
  };
  wait_for_line("env", "host `host-2` is here");
  wait_until([&] { return maps("host-1").find("utias_mocap.so") != std::string::npos; },
             "the first host has the recorded robots");
  EXPECT_EQ(maps("env").find("/plugins/"), std::string::npos);
  // Robots 9 to 16 are simulated.
  EXPECT_NE(maps("host-2").find("wander.so"), std::string::npos);
  EXPECT_EQ(maps("host-2").find("utias_mocap.so"), std::string::npos);
}

TEST_F(Hosts, AManagerThatIsKilledIsReplacedAndNothingIsLost) {
  const std::string scenario = checked_crowd();
  const Words span = {"--duration", "40", "--no-picture"};
  const Ended one_process =
      run_rave({"run", scenario, "--output", folder("alone"), "--processes", "1", "--pace", "max",
                "--no-record", "--no-picture", "--duration", "40"});
  ASSERT_EQ(one_process.exit_code, 0) << one_process.out << one_process.err;
  start("env", "env", scenario, span);
  start_host("one", scenario, span);
  start_host("two", scenario, span);
  wait_for_steps();
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  start("second", "env", scenario, {"--duration", "40", "--no-picture", "--resume"});
  EXPECT_EQ(end_of("second"), 0) << console("second");
  EXPECT_NE(console("second").find("takes over from a lost manager"), std::string::npos);
  EXPECT_EQ(end_of("one"), 0) << console("one");
  EXPECT_EQ(end_of("two"), 0) << console("two");
  // Contacts and captures of before it are known as well.
  const auto json = result("second");
  EXPECT_EQ(json["hash"], result("alone")["hash"]);
  EXPECT_GT(json["events"]["contact"], 0);
  EXPECT_GT(json["capture"]["captures"].size(), 0U);
  EXPECT_EQ(result_of("second").dump(1), result_of("alone").dump(1));
  EXPECT_EQ(content_of(folder("second") + "/events.log"),
            content_of(folder("alone") + "/events.log"));
  for (const auto& host : json["hosts"]) EXPECT_EQ(host["found"], true) << host;
}

TEST_F(Hosts, AManagerOfAnotherScenarioIsNotBelieved) {
  start_crowd({"--run", "crowd"});
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  for (const char* const host : {"one", "two"}) {
    wait_for_line(host, "the environment manager is lost");
  }
  start("stranger", "env", scenario_,
        {"--run", "crowd", "--duration", "100000", "--seed", "3", "--no-record"});
  for (const char* const host : {"one", "two"}) {
    wait_for_line(host, "refused: `environment manager` has another scenario");
  }
  // It says that the run has failed when it goes.
  signal("stranger", SIGINT);
  EXPECT_EQ(end_of("stranger"), 1);
  start("second", "env", scenario_, {"--run", "crowd", "--duration", "100000", "--resume"});
  wait_for_line("second", "takes over from a lost manager");
  wait_for_more("one");
  wait_for_more("two");
  signal("second", SIGINT);
  EXPECT_EQ(end_of("second"), 1);
  EXPECT_EQ(end_of("one"), 0) << console("one");
  EXPECT_EQ(end_of("two"), 0) << console("two");
}

TEST_F(Hosts, AHostGivesUpWithoutAManagerIfItWasToldTo) {
  const Words span = {"--duration", "100000"};
  start("env", "env", scenario_, span);
  start_host("two", scenario_, span);
  wait_for_line("env", "host `two` is here");
  Words words = span;
  words.insert(words.end(), {"--wait-for-manager", "5"});
  start_host("one", scenario_, words);
  wait_for_steps();
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  EXPECT_EQ(end_of("one"), 1);
  EXPECT_NE(console("one").find("gives up: there was no environment manager for 5 s"),
            std::string::npos)
      << console("one");
  EXPECT_EQ(result("one")["ending"], "there was no environment manager for 5 s");
  const Ended info = run_rave({"info", folder("one") + "/run.mcap"});
  EXPECT_EQ(info.exit_code, 0) << "its record is whole: " << info.err;
  // The other one goes on waiting.
  wait_for_line("two", "the environment manager is lost");
  EXPECT_EQ(console("two").find("gives up"), std::string::npos);
  signal("two", SIGINT);
  EXPECT_EQ(end_of("two"), 1);
}

TEST_F(Hosts, HostsOfARunThatIsKilledWaitForAnotherManagerForAMinute) {
  start("run", "run", scenario_, {"--duration", "100000", "--run", "crowd", "--no-picture"});
  for (const char* const host : {"run/hosts/one", "run/hosts/two"}) {
    wait_until([&] { return record_size(host) > 100'000; }, std::string(host) + " runs");
  }
  const std::string task = "/proc/" + std::to_string(id_of("run")) + "/task/";
  std::istringstream children(content_of(task + std::to_string(id_of("run")) + "/children"));
  std::vector<std::string> hosts;
  for (std::string child; children >> child;) hosts.push_back("/proc/" + child + "/cmdline");
  ASSERT_EQ(hosts.size(), 2U);
  using namespace std::string_literals;
  for (const std::string& host : hosts) {
    EXPECT_NE(content_of(host).find("--wait-for-manager\0"s + "60\0"s), std::string::npos) << host;
  }
  signal("run", SIGKILL);
  EXPECT_EQ(end_of("run"), -1);
  wait_for_line("run/hosts/one", "the environment manager is lost");
  start("second", "env", scenario_,
        {"--duration", "100000", "--run", "crowd", "--no-picture", "--resume"});
  wait_for_line("second", "takes over from a lost manager");
  signal("second", SIGINT);
  EXPECT_EQ(end_of("second"), 1);
  // Of a process that has ended nothing is left but its number.
  for (const std::string& host : hosts) {
    wait_until([&] { return content_of(host).empty(); }, host + " ends");
  }
  EXPECT_EQ(result("run/hosts/one")["whole"], true);
}

TEST_F(Hosts, AllWaitForAHostThatIsKilledUntilItIsBack) {
  start_crowd({});
  signal("one", SIGKILL);
  EXPECT_EQ(end_of("one"), -1);
  wait_for_line("env", "host `one` is gone");
  wait_for_line("two", "waiting for one");
  start("again", "robot", "crowd.yaml", {"--host", "one", "--duration", "100000"});
  wait_for_line("env", "host `one` is back");
  wait_for_more("two");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
  EXPECT_EQ(result("env")["hash"], nullptr);
  const std::string why = result("env")["no_hash_because"].dump();
  EXPECT_NE(why.find("the run did not complete: host `one` is gone in step "), std::string::npos)
      << why;
  const std::string summary = content_of(folder("env") + "/summary.txt");
  EXPECT_NE(summary.find("none: the run did not complete"), std::string::npos) << summary;
  EXPECT_EQ(end_of("two"), 0);
}

TEST_F(Hosts, TheOthersGoOnWithoutAHostThatIsDropped) {
  write_policy("drop", 5);
  start_crowd({});
  signal("one", SIGKILL);
  EXPECT_EQ(end_of("one"), -1);
  wait_for_line("env", "host `one` is gone");
  wait_for_line("env", "its robots stop from this step on");
  wait_for_more("two");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
  // What the other one knows is here; what the first knew has died with it, and that is said.
  const auto json = result("env");
  EXPECT_EQ(json["hosts"][0]["found"], false) << json["hosts"];
  EXPECT_EQ(json["hosts"][1]["found"], true) << json["hosts"];
  EXPECT_NE(json["problems"].dump().find("host `one` did not send its results"), std::string::npos)
      << json["problems"];
}

TEST_F(Hosts, AHostThatHangsIsDroppedAfterItsTime) {
  write_policy("drop", 0.3);
  start_crowd({});
  signal("one", SIGSTOP);
  wait_for_line("env", "host `one`");
  wait_for_more("two");
  signal("one", SIGCONT);
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
}

TEST_F(Hosts, ALostHostMayComeBackWhileTheOthersGoOn) {
  write_policy("restart", 5);
  start_crowd({});
  signal("one", SIGKILL);
  EXPECT_EQ(end_of("one"), -1);
  wait_for_line("env", "its robots stop until it is back");
  wait_for_more("two");
  start("again", "robot", scenario_, {"--host", "one", "--duration", "100000"});
  wait_for_line("env", "host `one` is back");
  wait_until([&] { return record_size("again") > 100'000; }, "it takes part again");
  wait_for_more("two");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
  EXPECT_NE(console("again").find("was not there from step 0"), std::string::npos);
}

TEST_F(Hosts, RunStartsAHostAgainThatDies) {
  write_policy("restart", 5);
  start("run", "run", scenario_, {"--duration", "100000"});
  wait_until([&] { return record_size("run/hosts/one") > 100'000; }, "it runs");
  // The child whose folder it is.
  const auto children = content_of("/proc/" + std::to_string(id_of("run")) + "/task/" +
                                   std::to_string(id_of("run")) + "/children");
  const auto first = static_cast<pid_t>(std::stol(children));
  ASSERT_EQ(::kill(first, SIGKILL), 0);
  wait_until([&] { return record_size("run/hosts/one-2") > 100'000; }, "it is back");
  signal("run", SIGINT);
  EXPECT_EQ(end_of("run"), 1);
  EXPECT_TRUE(fs::exists(folder("run/result.json")));
}

TEST_F(Hosts, TwoRunsAtOnceDoNotSeeEachOther) {
  const std::string first = hash_alone("crowd.yaml", {"--seed", "1"});
  const std::string second = hash_alone("crowd.yaml", {"--seed", "2"});
  ASSERT_NE(first, second);
  start("a", "run", "crowd.yaml", {"--seed", "1"});
  start("b", "run", "crowd.yaml", {"--seed", "2"});
  EXPECT_EQ(end_of("a"), 0) << console("a");
  EXPECT_EQ(end_of("b"), 0) << console("b");
  EXPECT_EQ(result("a")["hash"], first);
  EXPECT_EQ(result("b")["hash"], second);
}

TEST_F(Hosts, WhoDoesNotFitIsToldSo) {
  start("env", "env", "crowd.yaml", {"--run", "lab"});
  Words words = {"robot", "crowd.yaml", "--host", "one", "--run", "lab", "--seed", "3"};
  for (const std::string& word : apart()) words.push_back(word);
  words.insert(words.end(), {"--output", folder("other")});
  const Ended other = run_rave(words);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("`environment manager` has another scenario"), std::string::npos)
      << other.err;

  words = {"env", "crowd.yaml", "--run", "lab", "--output", folder("second")};
  for (const std::string& word : apart()) words.push_back(word);
  const Ended second = run_rave(words);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("has an environment manager already"), std::string::npos) << second.err;
}

TEST_F(Hosts, WhatNobodyCanUseIsRefusedAndTheRunDoesNotEnd) {
  const std::string alone = hash_alone("crowd.yaml", {});
  const bus::RunId run = bus::RunId::random();
  const Words words = {"--run", run.text()};
  start("env", "env", "crowd.yaml", words);
  auto wrong = WrongHost::open(run, apart(), 1);
  ASSERT_TRUE(wrong) << wrong.error().text();
  wait_until([&] { return (*wrong)->introduce(); }, "the manager is there");
  sim::HostReport report;
  report.host = 1;
  report.poses.push_back({RobotId(0), {}});
  const auto say_until = [&](const std::string& answer) {
    wait_until(
        [&] {
          EXPECT_TRUE((*wrong)->say(report));
          return console("env").find(answer) != std::string::npos;
        },
        answer);
  };
  say_until("robot `left-1`: a reported pose, but it runs on host 0");
  report.poses.clear();
  report.step = 1;
  report.proposals = {{20}, {std::numeric_limits<double>::quiet_NaN()}, {0}, {0}};
  say_until("vx_mps[0] is nan");
  start_host("one", "crowd.yaml", words);
  wait_for_line("env", "host `one` is here");
  wrong->reset();
  wait_for_line("env", "host `two` was lost before the run began");
  start_host("two", "crowd.yaml", words);
  EXPECT_EQ(end_of("env"), 0) << console("env");
  EXPECT_EQ(result("env")["hash"], alone);
}

TEST_F(Hosts, ASecondManagerEndsAndTheRunGoesOn) {
  start_crowd({"--run", "crowd"});
  for (const char* const seed : {"1", "3"}) {
    Words words = {"env",    "crowd.yaml", "--duration", "100000",
                   "--seed", seed,         "--output",   folder(std::string("second-") + seed)};
    words.insert(words.end(), {"--run", "crowd"});
    for (const std::string& word : apart()) words.push_back(word);
    const Ended second = run_rave(words);
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_NE(second.err.find("has an environment manager already"), std::string::npos)
        << second.err;
  }
  wait_for_more("one");
  wait_for_more("two");
  EXPECT_EQ(console("one").find("is gone"), std::string::npos) << console("one");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
  EXPECT_EQ(end_of("one"), 0) << console("one");
}

TEST_F(Hosts, ASecondProcessForAHostIsRefusedAndTheFirstGoesOn) {
  start_crowd({});
  Words words = {"robot",      "crowd.yaml", "--host",   "one",
                 "--duration", "100000",     "--output", folder("second")};
  for (const std::string& word : apart()) words.push_back(word);
  const Ended second = run_rave(words);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("host `one` of this run is served already"), std::string::npos)
      << second.err;
  wait_for_more("one");
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1);
  EXPECT_EQ(end_of("one"), 0);
}

TEST_F(Hosts, BadInput) {
  const Ended nobody = run_rave({"robot", "crowd.yaml", "--host", "on"});
  EXPECT_EQ(nobody.exit_code, 2);
  EXPECT_NE(nobody.err.find("the scenario `crowd` has no host `on`; did you mean `one`?"),
            std::string::npos)
      << nobody.err;
  const Ended alone = run_rave({"env", "good_scenario.yaml"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("has no hosts"), std::string::npos) << alone.err;
  const Ended many = run_rave({"run", "good_scenario.yaml", "--processes", "4"});
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_NE(many.err.find("expected at most one per robot, of which there are 3"),
            std::string::npos)
      << many.err;
  const Ended multicast =
      run_rave({"run", "good_scenario.yaml", "--processes", "2", "--multicast", "of"});
  EXPECT_EQ(multicast.exit_code, 2);
  EXPECT_NE(multicast.err.find("did you mean `off`"), std::string::npos) << multicast.err;
}

}  // namespace
}  // namespace rave::cli_test
