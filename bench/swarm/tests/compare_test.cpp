// SPDX-License-Identifier: Apache-2.0
#include "rave/swarm/compare.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

namespace rave::swarm {
namespace {

namespace fs = std::filesystem;

/// Builds whose `rave` is a script, so that what they print is known.
class CompareTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "rave-compare-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// The folder of a build that notes its arguments in `calls` and then does what `body` says.
  fs::path build(const std::string& name, const std::string& body) {
    fs::create_directories(folder_ / name / "bin");
    const fs::path script = folder_ / name / "bin" / "rave";
    std::ofstream(script) << "#!/bin/sh\necho " << name << " \"$@\" >> " << calls() << "\n" << body;
    fs::permissions(script, fs::perms::owner_all);
    return folder_ / name;
  }
  /// A build that prints a rate, of which there are as many as it is called.
  fs::path build(const std::string& name, const std::vector<double>& rates,
                 const std::string& hash) {
    std::string body = "n=$(grep -c '^" + name + " ' " + calls().string() + ")\ncase $n in\n";
    for (std::size_t i = 0; i < rates.size(); ++i) {
      body += std::to_string(i + 1) + ") r=" + std::to_string(rates[i]) + ";;\n";
    }
    body += "esac\n";
    return build(name, body + "echo \"{\\\"steps\\\": 40, \\\"robot_steps_per_s\\\": $r, " +
                           "\\\"hash\\\": \\\"" + hash + "\\\"}\"\n");
  }
  [[nodiscard]] fs::path calls() const { return folder_ / "calls"; }
  [[nodiscard]] std::vector<std::string> called() const {
    std::vector<std::string> lines;
    std::ifstream file(calls());
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  static CompareOptions options(const fs::path& a, const fs::path& b, int rounds) {
    CompareOptions options;
    options.a = a;
    options.b = b;
    options.workload = {Sensing::kB, 50, Noise::kGaussian, 2, 9};
    options.end.steps = 40;
    options.rounds = rounds;
    return options;
  }

  fs::path folder_;
};

TEST_F(CompareTest, TakesTurnsAndDividesRoundByRound) {
  const fs::path a = build("a", {100, 200, 400}, "11");
  const fs::path b = build("b", {150, 240, 400}, "11");
  const auto comparison = compare(options(a, b, 3));
  ASSERT_TRUE(comparison) << comparison.error().text();
  const std::string arguments =
      " bench swarm --workload B --robots 50 --threads 2 --noise gaussian --seed 9 --steps 40";
  EXPECT_EQ(called(),
            (std::vector<std::string>{"a" + arguments, "b" + arguments, "b" + arguments,
                                      "a" + arguments, "a" + arguments, "b" + arguments}));
  EXPECT_TRUE(comparison->same_hash());
  // 1.5, 1.2 and 1.
  EXPECT_DOUBLE_EQ(comparison->ratio.median, 1.2);
  EXPECT_DOUBLE_EQ(comparison->ratio.p10, 1.04);
  EXPECT_DOUBLE_EQ(comparison->ratio.p90, 1.44);
  const auto json = nlohmann::json::parse(comparison_json(*comparison));
  EXPECT_EQ(json.at("ratio").at("median"), comparison->ratio.median);
  EXPECT_EQ(json.at("a").at("robot_steps_per_s").at("median"), 200);
  EXPECT_EQ(json.at("b").at("hash"), "11");
  EXPECT_EQ(json.at("same_hash"), true);
  EXPECT_EQ(json.at("rounds"), 3);
  EXPECT_EQ(comparison_text(*comparison),
            "B does 1.200 times the robot-steps of A (p10 1.040, p90 1.440; 3 rounds of 40 steps); "
            "the same hash");
}

TEST_F(CompareTest, SecondsBecomeTheStepsThatADoesInThem) {
  CompareOptions wanted = options(build("a", {1, 1}, "11"), build("b", {2}, "11"), 1);
  wanted.end = {std::nullopt, 0.5};
  const auto comparison = compare(wanted);
  ASSERT_TRUE(comparison) << comparison.error().text();
  const std::vector<std::string> lines = called();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(lines[0].starts_with("a ") && lines[0].ends_with(" --seconds 0.5")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("a ") && lines[1].ends_with(" --steps 40")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("b ") && lines[2].ends_with(" --steps 40")) << lines[2];
  EXPECT_EQ(comparison->steps, 40U);
  EXPECT_EQ(comparison->ratio.median, 2);
}

TEST_F(CompareTest, RefusesDifferentHashesAtOnceUnlessAllowed) {
  CompareOptions wanted =
      options(build("a", {100, 100, 100}, "11"), build("b", {100, 100, 100}, "22"), 2);
  const auto refused = compare(wanted);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kState);
  EXPECT_EQ(refused.error().message,
            "the builds do not do the same: after 40 steps `" + (folder_ / "a/bin/rave").string() +
                "` has the hash 11 and `" + (folder_ / "b/bin/rave").string() +
                "` has 22; --allow-different-hash compares them all the same");
  EXPECT_EQ(called().size(), 2U);
  wanted.allow_different_hash = true;
  const auto allowed = compare(wanted);
  ASSERT_TRUE(allowed) << allowed.error().text();
  EXPECT_FALSE(allowed->same_hash());
  EXPECT_NE(comparison_json(*allowed).find("\"same_hash\":false"), std::string::npos);
  EXPECT_NE(comparison_text(*allowed).find("the hashes DIFFER"), std::string::npos);
}

TEST_F(CompareTest, ABuildThatDoesNotRepeatItselfIsFound) {
  const fs::path a = build("a", {100, 100}, "11");
  const fs::path b =
      build("b", "echo '{\"steps\": 40, \"robot_steps_per_s\": 5, \"hash\": \"'$$'\"}'\n");
  CompareOptions wanted = options(a, b, 2);
  wanted.allow_different_hash = true;
  const auto comparison = compare(wanted);
  ASSERT_FALSE(comparison);
  EXPECT_NE(comparison.error().message.find("b/bin/rave` gave the hashes "), std::string::npos);
  EXPECT_NE(comparison.error().message.find("expected the same each time"), std::string::npos);
}

TEST_F(CompareTest, SaysWhatItLookedFor) {
  const fs::path b = build("b", {1, 1}, "11");
  fs::create_directories(folder_ / "empty");
  const auto no_rave = compare(options(folder_ / "empty", b, 1));
  ASSERT_FALSE(no_rave);
  EXPECT_EQ(no_rave.error().message, "there is no executable `" +
                                         (folder_ / "empty/bin/rave").string() + "` and no `" +
                                         (folder_ / "empty/rave").string() + "`");
  const auto nothing = compare(options(b, folder_ / "nowhere", 1));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(nothing.error().message,
            "there is no build `" + (folder_ / "nowhere").string() +
                "`: expected a folder with `bin/rave`, or an executable file");
  EXPECT_TRUE(called().empty());
  const auto itself = compare(options(b / "bin" / "rave", b, 1));
  EXPECT_TRUE(itself) << itself.error().text();
}

TEST_F(CompareTest, ARunThatFailsOrSaysSomethingElseIsAnError) {
  const fs::path good = build("good", {1, 1}, "11");
  const auto failed = compare(options(good, build("bad", "exit 3\n"), 1));
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kState);
  EXPECT_NE(failed.error().message.find("ended with exit code 3; expected 0"), std::string::npos);
  const auto killed = compare(options(good, build("killed", "kill -9 $$\n"), 1));
  ASSERT_FALSE(killed);
  EXPECT_NE(killed.error().message.find("exit code 137"), std::string::npos);
  for (const char* const words : {"hello", "[1]", "{\"steps\": 40, \"hash\": \"11\"}"}) {
    const auto other =
        compare(options(good, build("other", "echo '" + std::string(words) + "'\n"), 1));
    ASSERT_FALSE(other) << words;
    EXPECT_NE(other.error().message.find("expected JSON with `steps`, `robot_steps_per_s` and"),
              std::string::npos)
        << other.error().message;
  }
}

TEST_F(CompareTest, EachBuildUsesItsOwnPlugins) {
  ::setenv("RAVE_PLUGIN_PATH", "/elsewhere", 1);
  const fs::path a = build("a",
                           "[ -z \"$RAVE_PLUGIN_PATH\" ] && [ -n \"$PATH\" ] || exit 1\n"
                           "echo '{\"steps\": 40, \"robot_steps_per_s\": 5, \"hash\": \"1\"}'\n");
  const auto comparison = compare(options(a, a, 1));
  ::unsetenv("RAVE_PLUGIN_PATH");
  EXPECT_TRUE(comparison) << comparison.error().text();
}

TEST(Spread, InterpolatesBetweenValues) {
  const Spread ten = spread_of({10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0});
  EXPECT_DOUBLE_EQ(ten.median, 5);
  EXPECT_DOUBLE_EQ(ten.p10, 1);
  EXPECT_DOUBLE_EQ(ten.p90, 9);
  EXPECT_DOUBLE_EQ(spread_of({4, 2}).median, 3);
  EXPECT_DOUBLE_EQ(spread_of({7}).p10, 7);
}

}  // namespace
}  // namespace rave::swarm
