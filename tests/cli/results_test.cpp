// SPDX-License-Identifier: Apache-2.0
// What a run leaves is the same, whether one process ran it or several.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

class Results : public SharedWorld {
 protected:
  /// Runs a scenario with so many processes; into the folder of that name.
  Ended run_in(const std::string& name, const std::string& scenario, int processes,
               const Words& more) {
    Words words = {"run",        scenario,      "--output",
                   folder(name), "--processes", std::to_string(processes),
                   "--pace",     "max"};
    if (processes > 1) {
      for (const std::string& word : apart()) words.push_back(word);
    }
    words.insert(words.end(), more.begin(), more.end());
    return run_rave(words);
  }
  /// result.json without what is of the processes: how long it took, and where their parts lie.
  [[nodiscard]] Json result_of(const std::string& name) const {
    Json json = result(name);
    json.erase("wall_s");
    json.erase("hosts");
    return json;
  }
  /// The summary without the line that says how long it took.
  [[nodiscard]] std::string summary_of(const std::string& name) const {
    std::istringstream lines(content_of(folder(name) + "/summary.txt"));
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      if (line.find("simulated in") == std::string::npos) text += line + "\n";
    }
    return text;
  }
  /// `rave info --json` without what is of the files, and without the console: hosts say more.
  [[nodiscard]] Json info_of(const std::string& name) const {
    const Ended ended = run_rave({"info", folder(name), "--json"});
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
    Json json = Json::parse(ended.out, nullptr, false);
    if (!json.is_object()) return json;
    for (const char* const key : {"file", "bytes", "chunks", "parts"}) json.erase(key);
    json["run"].erase("started");
    std::uint64_t lines = 0;
    Json channels = Json::array();
    for (const Json& channel : json["channels"]) {
      if (channel["topic"] == "/rosout") {
        lines = channel["messages"];
      } else {
        channels.push_back(channel);
      }
    }
    json["channels"] = channels;
    json["messages"] = json["messages"].get<std::uint64_t>() - lines;
    return json;
  }
  void expect_same(const std::string& a, const std::string& b) const {
    EXPECT_EQ(result_of(a).dump(1), result_of(b).dump(1));
    EXPECT_EQ(summary_of(a), summary_of(b));
    for (const char* const file : {"events.log", "picture.svg", "picture.png"}) {
      EXPECT_EQ(content_of(folder(a) + "/" + file), content_of(folder(b) + "/" + file)) << file;
    }
    EXPECT_EQ(info_of(a).dump(1), info_of(b).dump(1));
  }
  /// One process against two and three.
  void expect_any_split_the_same(const std::string& scenario, const Words& more, int exit_code,
                                 const std::vector<int>& splits) {
    const Ended alone = run_in("alone", scenario, 1, more);
    ASSERT_EQ(alone.exit_code, exit_code) << alone.out << alone.err;
    for (const int processes : splits) {
      SCOPED_TRACE(std::to_string(processes) + " processes");
      const std::string name = "of-" + std::to_string(processes);
      const Ended shared = run_in(name, scenario, processes, more);
      EXPECT_EQ(shared.exit_code, exit_code) << shared.out << shared.err << console(name);
      expect_same("alone", name);
      const Ended again = run_rave({"verify", folder(name)});
      EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
      EXPECT_NE(again.out.find(result("alone")["hash"].get<std::string>()), std::string::npos)
          << again.out;
    }
  }
  /// A crowd with checks, of which the last cannot hold.
  std::string checked_crowd() {
    std::string text = content_of(RAVE_SOURCE_DIR "/tests/cli/data/crowd.yaml");
    const std::string robot = "file: ";
    for (std::size_t at = 0; (at = text.find(robot, at)) != std::string::npos;) {
      at += robot.size();
      text.insert(at, RAVE_SOURCE_DIR "/tests/cli/data/");
    }
    text.resize(text.find("\nhosts:") + 1);
    text += R"(
checks:
  touches: [{robots: [left], most: 1000, least: 1}, {robots: [right], most: 0}]
  arrivals:
    - {robot: left, x_m: 0, y_m: 0, within_m: 100}
    - {robot: right-3, x_m: 90, y_m: 0, within_m: 1, before_s: 2}
picture: {title: Crowd, instant_s: 1}
)";
    std::string path = folder("crowd.yaml");
    std::ofstream(path) << text;
    return path;
  }
};

TEST_F(Results, RecordedAndSimulatedRobots) {
  // The sightings of four seconds are too few for the check of the scenario, in any split.
  const Words span = {"--duration", "4"};
  const int code = run_in("probe", "mixed-reality", 1, span).exit_code;
  expect_any_split_the_same("mixed-reality", span, code, {2, 3});
}

TEST_F(Results, MessagesBetweenHosts) {
  expect_any_split_the_same("flock", {"--duration", "6"}, 0, {2, 3});
}

TEST_F(Results, ACaptureEndsTheRunInTheSameStep) {
  expect_any_split_the_same("predator-prey", {}, 0, {2});
  EXPECT_EQ(result("of-2")["capture"]["captures"].size(), 1U);
}

TEST_F(Results, ChecksThatHoldAndChecksThatFail) {
  expect_any_split_the_same(checked_crowd(), {}, 1, {2, 3});
  const Json checks = result("of-3")["checks"];
  ASSERT_EQ(checks.size(), 13U) << checks;
  EXPECT_EQ(checks[0]["holds"], true);
  EXPECT_EQ(checks[1]["holds"], false);
}

TEST_F(Results, OfHostsThatWriteElsewhereAreThoseOfOneProcess) {
  const std::string scenario = checked_crowd();
  const Ended alone = run_in("alone", scenario, 1, {});
  ASSERT_EQ(alone.exit_code, 1) << alone.out << alone.err;
  const Words words = {"--processes", "2"};
  start("env", "env", scenario, words);
  start_host("host-1", scenario, words);
  start_host("host-2", scenario, words);
  EXPECT_EQ(end_of("host-1"), 0) << console("host-1");
  EXPECT_EQ(end_of("host-2"), 0) << console("host-2");
  EXPECT_EQ(end_of("env"), 1) << "a check fails, as in one process";
  const Json json = result("env");
  EXPECT_EQ(json["whole"], true) << json["problems"];
  for (const Json& host : json["hosts"]) EXPECT_EQ(host["found"], true) << host;
  EXPECT_EQ(result_of("alone").dump(1), result_of("env").dump(1));
  EXPECT_EQ(summary_of("alone"), summary_of("env"));
  for (const char* const file : {"events.log", "picture.svg", "picture.png"}) {
    EXPECT_EQ(content_of(folder("alone") + "/" + file), content_of(folder("env") + "/" + file))
        << file;
  }
}

TEST_F(Results, RecordsThatAreMissingOrTornAreNamedAndTheRestIsRead) {
  ASSERT_EQ(run_in("run", "flock", 3, {"--duration", "2", "--no-picture"}).exit_code, 0);
  ASSERT_EQ(run_rave({"info", folder("run")}).exit_code, 0);
  const std::string torn = folder("run") + "/hosts/host-1/run.mcap";
  fs::resize_file(torn, fs::file_size(torn) - 100);
  fs::remove(folder("run") + "/hosts/host-3/run.mcap");
  const Ended info = run_rave({"info", folder("run"), "--json"});
  EXPECT_EQ(info.exit_code, 1);
  EXPECT_NE(info.err.find("there is no recording of host `host-3`"), std::string::npos) << info.err;
  EXPECT_NE(info.err.find("host-1/run.mcap` is incomplete"), std::string::npos) << info.err;
  const Json json = Json::parse(info.out, nullptr, false);
  EXPECT_EQ(json["run"]["robots"].size(), 10U);
  EXPECT_EQ(json["missing"].size(), 2U);
  EXPECT_NEAR(json["end_s"].get<double>(), 1.99, 1e-9) << "of the whole";
  const Ended verify = run_rave({"verify", folder("run")});
  EXPECT_EQ(verify.exit_code, 2);
  EXPECT_NE(verify.err.find("a part of the run is missing"), std::string::npos) << verify.err;
}

TEST_F(Results, RobotsOfAllHostsArePlayedTogether) {
  ASSERT_EQ(run_in("run", "flock", 2, {"--duration", "2", "--no-picture"}).exit_code, 0);
  const Ended played = run_rave({"play", folder("run"), "--robot", "bird-1", "--robot", "tenth",
                                 "--output", folder("again"), "--no-picture"});
  EXPECT_EQ(played.exit_code, 0) << played.out << played.err;
  const Json json = result("again");
  ASSERT_EQ(json["robots"].size(), 2U) << json;
  const auto pose_of = [](const Json& robots, const std::string& name) {
    for (const Json& robot : robots) {
      if (robot["name"] == name) return robot["final_pose"];
    }
    return Json();
  };
  for (const char* const name : {"bird-1", "tenth"}) {
    EXPECT_EQ(pose_of(json["robots"], name)["x_m"], pose_of(result("run")["robots"], name)["x_m"])
        << name;
  }
}

}  // namespace
}  // namespace rave::cli_test
