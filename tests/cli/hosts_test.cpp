// SPDX-License-Identifier: Apache-2.0
// One world over several processes, started as users would start them.
#include <csignal>
#include <limits>
#include <sstream>

#include "crowd_hosts.hpp"
#include "wrong_host.hpp"

namespace rave::cli_test {
namespace {

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

TEST_F(Hosts, ARunWithAnOpenEndIsCompleteWhenItIsEnded) {
  start("run", "run", "crowd.yaml", {"--set", "duration_s=none"});
  wait_for_more("run/hosts/one");
  signal("run", SIGINT);
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_EQ(console("run").find("problem:"), std::string::npos) << console("run");
  const auto result = this->result("run");
  EXPECT_EQ(result["whole"], true);
  EXPECT_EQ(result["hash"].get<std::string>().size(), 16U) << result;
  EXPECT_TRUE(result["ended_by_hand_s"].is_number());
  for (const char* const host : {"one", "two"}) {
    EXPECT_EQ(this->result(std::string("run/hosts/") + host)["whole"], true) << host;
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
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "with the thread sanitizer plug-ins stay loaded once they were looked at";
#endif
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
  EXPECT_EQ(end_of("env"), 0);
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
  EXPECT_EQ(end_of("env"), 0);
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
      run_rave({"run", "good_scenario.yaml", "--processes", "2", "--multicast", "non"});
  EXPECT_EQ(multicast.exit_code, 2);
  EXPECT_NE(multicast.err.find("did you mean `none`"), std::string::npos) << multicast.err;
}

}  // namespace
}  // namespace rave::cli_test
