// SPDX-License-Identifier: Apache-2.0
// Managers and hosts that are killed, hang or give up in the middle of a run.
#include <csignal>

#include "crowd_hosts.hpp"

namespace rave::cli_test {
namespace {

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
  EXPECT_EQ(end_of("second"), 0);
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
  EXPECT_EQ(end_of("two"), 0);
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
  EXPECT_EQ(end_of("second"), 0);
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
  wait_for_line("env", "its robots stop from this step on");
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
  EXPECT_NE(console("again").find("was absent from step 0"), std::string::npos);
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

}  // namespace
}  // namespace rave::cli_test
