// SPDX-License-Identifier: Apache-2.0
// A recorded run is repeated up to a time, and another one goes on from there.
#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Branch : public testing::Test {
 protected:
  [[nodiscard]] std::string out(const std::string& name) const { return folder_.path() / name; }
  void run(const std::string& scenario, const std::string& name,
           const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"run",     scenario,       "--output",
                                      out(name), "--no-picture", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = run_rave(words);
    ASSERT_NE(ended.exit_code, 2) << ended.err;
  }
  [[nodiscard]] Ended branch(const std::string& of, const std::string& name,
                             const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"branch", out(of), "--output", out(name), "--no-picture"};
    words.insert(words.end(), more.begin(), more.end());
    return run_rave(words);
  }
  [[nodiscard]] std::string hash(const std::string& name) const {
    const std::string text = content_of(fs::path(out(name)) / "result.json");
    const std::size_t at = text.find("\"hash\": \"");
    return at == std::string::npos ? "none" : text.substr(at + 9, 16);
  }
  TemporaryFolder folder_;
};

TEST_F(Branch, WithoutAChangeHasTheHashOfItsParent) {
  for (const char* const scenario : {"predator-prey", "rear-sonar", "flock", "lua-patrol"}) {
    const std::string name = scenario;
    run(scenario, name, {"--duration", "20"});
    const Ended ended = branch(name, name + "-branch", {"--at", "10", "--quiet"});
    EXPECT_NE(ended.exit_code, 2) << ended.err;
    EXPECT_FALSE(has(ended.err, "differs:")) << ended.err;
    EXPECT_NE(hash(name), "none");
    EXPECT_EQ(hash(name + "-branch"), hash(name)) << scenario;
    EXPECT_EQ(run_rave({"diff", out(name), out(name + "-branch")}).exit_code, 0);
  }
}

TEST_F(Branch, OfThreeProcessesHasTheHashOfItsParent) {
  run("predator-prey", "parent", {"--duration", "5", "--processes", "2"});
  const Ended ended = branch("parent", "branch", {"--at", "2.5", "--quiet"});
  EXPECT_FALSE(has(ended.err, "differs:")) << ended.err;
  EXPECT_NE(hash("parent"), "none");
  EXPECT_EQ(hash("branch"), hash("parent"));
}

TEST_F(Branch, PartsWhereItIsAskedToAndCanBeVerified) {
  run("predator-prey", "parent", {"--duration", "30"});
  const Ended ended =
      branch("parent", "slow", {"--at", "12", "--set", "prey.program.max_speed_mps=0.1"});
  EXPECT_TRUE(has(ended.out, "branched at 12 s: 1200 steps before are equal to the recording"))
      << ended.out << ended.err;
  EXPECT_NE(hash("slow"), hash("parent"));
  const Ended verified = run_rave({"verify", out("slow")});
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  const Ended differ = run_rave({"diff", out("parent"), out("slow")});
  EXPECT_EQ(differ.exit_code, 1);
  EXPECT_TRUE(has(differ.out, "they part in step 1200 (12.000 s): ")) << differ.out;
  EXPECT_TRUE(has(differ.out, "│ prey ")) << differ.out;
  const std::string scenario = content_of(fs::path(out("slow")) / "scenario.yaml");
  EXPECT_TRUE(has(scenario, "Branch at 12 s of " + out("parent") + "/run.mcap (run hash " +
                                hash("parent") + ")"))
      << scenario;
  EXPECT_TRUE(has(content_of(fs::path(out("slow")) / "result.json"), "\"captured_at_s\": 1"));
  // A branch of a branch repeats what the first one asked for.
  const Ended again = branch("slow", "again", {"--at", "13", "--quiet"});
  EXPECT_FALSE(has(again.err, "differs:")) << again.err;
  EXPECT_EQ(hash("again"), hash("slow"));
  // And without what was asked for from there on, the parent is back.
  const Ended back = branch("slow", "back", {"--at", "12", "--quiet"});
  EXPECT_FALSE(has(back.err, "differs:")) << back.err;
  EXPECT_EQ(hash("back"), hash("parent"));
  const Ended people = branch("slow", "people", {"--at", "12", "--with-people", "--quiet"});
  EXPECT_FALSE(has(people.err, "refused:")) << people.err;
  EXPECT_EQ(hash("people"), hash("slow"));
}

TEST_F(Branch, ChangesObstaclesAndGoesOnLonger) {
  run("predator-prey", "parent", {"--duration", "5"});
  const Ended ended = branch(
      "parent", "open", {"--at", "2", "--until", "8", "--edit", R"({"remove_obstacle": "crate"})"});
  EXPECT_TRUE(has(ended.out, "200 steps before are equal")) << ended.out << ended.err;
  const std::string result = content_of(fs::path(out("open")) / "result.json");
  EXPECT_TRUE(has(result, "\"simulated_s\": 8.0")) << result.substr(0, 400);
  EXPECT_TRUE(has(result, "\"obstacle_removed\": 1"));
}

TEST_F(Branch, OfWrongInputSaysWhy) {
  run("good_scenario.yaml", "parent");
  const auto expect = [&](const std::vector<std::string>& more, int code, const std::string& part) {
    const Ended ended = branch("parent", "bad", more);
    EXPECT_EQ(ended.exit_code, code);
    EXPECT_TRUE(has(ended.err, part)) << ended.err;
  };
  expect({"--at", "3"}, 2, "--at 3: `");
  expect({"--at", "1", "--set", "anna"}, 2, "--set: found `anna`, expected ROBOT.KEY=VALUE");
  expect({"--at", "1", "--edit", "{}"}, 2, "--edit");
  expect({"--at", "1", "--set", "ana.program.cruise_mps=1"}, 1, "refused: ");
  EXPECT_EQ(run_rave({"branch", out("nowhere"), "--at", "1"}).exit_code, 2);
  EXPECT_EQ(run_rave({"diff", out("parent"), out("nowhere")}).exit_code, 2);
}

}  // namespace
}  // namespace rave::cli_test
