// SPDX-License-Identifier: Apache-2.0
// Conditions and the script of a scenario, over processes that come and go.
#include <csignal>
#include <fstream>

#include "crowd_hosts.hpp"

namespace rave::cli_test {
namespace {

class Conducted : public Hosts {
 protected:
  /// The scenario beside its robots, with something to find and something in its place.
  [[nodiscard]] std::string changed(const std::string& found, const std::string& put) const {
    const fs::path data = RAVE_SOURCE_DIR "/tests/cli/data";
    const fs::path copy = fs::path(folder("scenario"));
    fs::create_directories(copy);
    for (const char* const file : {"conducted.lua", "crowd_robot.yaml"}) {
      fs::copy_file(data / file, copy / file, fs::copy_options::overwrite_existing);
    }
    std::string text = content_of(data / "conducted.yaml");
    const std::size_t at = text.find(found);
    EXPECT_NE(at, std::string::npos) << found;
    if (at != std::string::npos) text.replace(at, found.size(), put);
    std::ofstream(copy / "scenario.yaml") << text;
    return copy / "scenario.yaml";
  }
  [[nodiscard]] Ended alone(const std::string& scenario, const Words& more = {}) const {
    Words words = {"run", scenario, "--output", folder("alone"), "--processes",
                   "1",   "--pace", "max",      "--no-picture"};
    words.insert(words.end(), more.begin(), more.end());
    return run_rave(words);
  }
  [[nodiscard]] std::string events(const std::string& run) const {
    return content_of(folder(run) + "/events.log");
  }
};

constexpr const char* kScenario = "conducted.yaml";

TEST_F(Conducted, WhatTheScenarioSaysHappensAndEndsTheRun) {
  const Ended ended = alone(kScenario);
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  const std::string all = events("alone");
  for (const char* const what :
       {"the script begins with 9 robots", "goal 3.00, -3.00", "halfway", "stop", "release",
        "a second has passed", "the leader has arrived", "the run ends: success: all is done",
        "body.scale", "crowd to bob", "gate", "dock", "crowd-1 touches something"}) {
    EXPECT_NE(all.find(what), std::string::npos) << what << "\n" << all;
  }
  // A condition that fails says so once, and the run goes on.
  EXPECT_NE(all.find("broken: attempt to compare"), std::string::npos) << all;
  EXPECT_EQ(all.find("never"), std::string::npos) << all;
  const auto json = result("alone");
  EXPECT_EQ(json["whole"], true) << json["problems"];
  EXPECT_LT(json["steps"], 2000) << "it ended before its time";
  const Ended verified = run_rave({"verify", folder("alone")});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
}

TEST_F(Conducted, AnySplitGivesTheSame) {
  ASSERT_EQ(alone(kScenario, {"--threads", "2"}).exit_code, 0);
  start("run", "run", kScenario);
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_EQ(result("run")["hash"], result("alone")["hash"]) << events("run") << events("alone");
  EXPECT_EQ(result("run")["whole"], true) << result("run")["problems"];
  EXPECT_EQ(result("run")["steps"], result("alone")["steps"]);
  EXPECT_EQ(events("run"), events("alone"));
}

TEST_F(Conducted, AManagerThatDiesBetweenConditionAndActionIsReplaced) {
  const std::string scenario =
      changed("delay_s: 0.5, request: {do: stop", "delay_s: 3, request: {do: stop");
  ASSERT_EQ(alone(scenario).exit_code, 0);
  start("env", "env", scenario, {"--pace", "2x"});
  start_host("one", scenario);
  start_host("two", scenario);
  wait_for_line("env", "halfway");
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  start("second", "env", scenario, {"--resume"});
  EXPECT_EQ(end_of("second"), 0) << console("second");
  EXPECT_EQ(end_of("one"), 0) << console("one");
  EXPECT_EQ(end_of("two"), 0) << console("two");
  EXPECT_EQ(result("second")["hash"], result("alone")["hash"]);
}

TEST_F(Conducted, AFailureIsTheEndOfTheRun) {
  const std::string scenario = changed("end: success", "end: failure");
  EXPECT_EQ(alone(scenario).exit_code, 1);
  EXPECT_NE(result("alone")["problems"].dump().find("failure: all is done"), std::string::npos)
      << result("alone")["problems"];
}

TEST_F(Conducted, MistakesHaveTheirPlace) {
  const auto refused = [this](const char* found, const char* put, const char* why) {
    const Ended ended = run_rave({"check", changed(found, put)});
    EXPECT_EQ(ended.exit_code, 2) << put << ended.out;
    EXPECT_NE((ended.out + ended.err).find(why), std::string::npos) << ended.out << ended.err;
  };
  refused("when: x(\"leader\") > -1", "when: x(\"leader\" > -1", "scenario.yaml:25:27");
  refused("after: arrived", "after: arived", "did you mean `arrived`");
  refused("name: halfway, when: x(\"leader\") > -1 and t > 1", "name: halfway, after: slow",
          "`slow` waits for itself");
  refused("robot: leader, point", "robot: lader, point", "did you mean `leader`");
  refused("body.scale: 0.9", "body.scal: 0.9", "body.scal");
  refused("every_s: 1", "every_s: 1, at_s: 1", "exactly one of `at_s`");
  refused("do: stop", "do: stp", "stop");
  refused("script: conducted.lua", "script: no.lua", "no.lua");
}

TEST_F(Conducted, AScriptThatDoesNotEndIsGivenUp) {
  const std::string scenario = changed("mark: a second has passed", "mark: beat");
  std::ofstream(fs::path(scenario).parent_path() / "conducted.lua")
      << "function on_step(t)\n  while true do end\nend\n";
  EXPECT_EQ(alone(scenario).exit_code, 0);
  EXPECT_NE(events("alone").find("conducted.lua:2"), std::string::npos) << events("alone");
  EXPECT_NE(events("alone").find("the script is not called again"), std::string::npos);
}

}  // namespace
}  // namespace rave::cli_test
