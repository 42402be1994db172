// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace rave::cli_test {
namespace {

nlohmann::json json_of(const Ended& ended) {
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1) << ended.out;
  return nlohmann::json::parse(ended.out, nullptr, false);
}

TEST(BenchSwarm, PrintsWhatItMeasured) {
  const Ended ended = run_rave({"bench", "swarm", "--workload", "B", "--robots", "60", "--threads",
                                "2", "--steps", "100", "--noise", "gaussian", "--seed", "5"});
  const auto json = json_of(ended);
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(json.at("workload"), "B");
  EXPECT_EQ(json.at("robots"), 60);
  EXPECT_EQ(json.at("threads"), 2);
  EXPECT_EQ(json.at("noise"), "gaussian");
  EXPECT_EQ(json.at("seed"), 5);
  EXPECT_EQ(json.at("steps"), 100);
  EXPECT_EQ(json.at("measured_steps"), 95);
  const double wall_s = json.at("wall_s");
  EXPECT_NEAR(json.at("steps_per_s"), 95 / wall_s, 1e-6 * 95 / wall_s);
  EXPECT_NEAR(json.at("robot_steps_per_s"), 5700 / wall_s, 1e-6 * 5700 / wall_s);
  EXPECT_NEAR(json.at("rays_per_s"), 180 * 5700 / wall_s, 1e-6 * 180 * 5700 / wall_s);
  EXPECT_NEAR(json.at("rtf"), 9.5 / wall_s, 1e-6 * 9.5 / wall_s);
  EXPECT_GT(json.at("startup_s"), 0);
  EXPECT_GT(json.at("rss_mb"), json.at("rss_start_mb"));
  EXPECT_GT(json.at("rss_start_mb"), 0);
  // They move, but not faster than they can, and see something, but not everywhere.
  EXPECT_GT(json.at("mean_disp_m"), 0.3);
  EXPECT_LT(json.at("mean_disp_m"), 4.0);
  EXPECT_GT(json.at("mean_range_m"), 0.3);
  EXPECT_LT(json.at("mean_range_m"), 8.0);
  EXPECT_EQ(json.at("hash").get<std::string>().size(), 16U);
  double sum_ns = 0;
  for (const char* const phase :
       {"ingest", "sense", "radio", "decide", "act", "resolve", "publish"}) {
    EXPECT_GE(json.at("phases").at(phase), 0) << phase;
    sum_ns += json.at("phases").at(phase).get<double>();
  }
  EXPECT_EQ(json.at("phases").size(), 7U);
  EXPECT_GT(json.at("phases").at("sense"), 0);
  // They are parts of what was measured.
  EXPECT_LE(sum_ns, 1e9 * wall_s / 5700 * (1 + 1e-9));
}

TEST(BenchSwarm, MeasuresForSomeTime) {
  const auto json = json_of(run_rave({"bench", "swarm", "--robots", "20", "--seconds", "0.05"}));
  EXPECT_GE(json.at("wall_s"), 0.05);
  EXPECT_GE(json.at("steps"), 2);
  EXPECT_EQ(json.at("workload"), "A");
}

TEST(BenchSwarm, RaveRunOfTheWrittenScenarioHasTheSameHash) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--workload", "A", "--robots", "100"},
        std::vector<std::string>{"--workload", "B", "--robots", "30", "--noise", "gaussian",
                                 "--seed", "18446744073709551615"},
        std::vector<std::string>{"--robots", "1", "--noise", "gaussian"}}) {
    const TemporaryFolder folder;
    const std::string written = folder.path() / "scenario";
    std::vector<std::string> words = {"bench", "swarm", "--steps", "150", "--write", written};
    words.insert(words.end(), options.begin(), options.end());
    const auto json = json_of(run_rave(words));
    const std::string output = folder.path() / "run";
    const Ended ended = run_rave({"run", written, "--output", output, "--quiet", "--no-picture"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto result = nlohmann::json::parse(content_of(output + "/result.json"));
    EXPECT_EQ(result.at("hash"), json.at("hash"));
    // Another seed is another run: that they are equal says something.
    const Ended other = run_rave({"run", written, "--output", output, "--replace", "--quiet",
                                  "--no-picture", "--no-record", "--seed", "4711"});
    EXPECT_EQ(other.exit_code, 0) << other.err;
    const auto others = nlohmann::json::parse(content_of(output + "/result.json"));
    EXPECT_NE(others.at("hash"), json.at("hash"));
  }
}

TEST(BenchSwarm, BadOptions) {
  EXPECT_EQ(run_rave({"bench"}).exit_code, 2);
  EXPECT_EQ(run_rave({"bench", "swarm", "--robots", "0"}).exit_code, 2);
  EXPECT_EQ(run_rave({"bench", "swarm", "--robots", "100001"}).exit_code, 2);
  EXPECT_EQ(run_rave({"bench", "swarm", "--workload", "C"}).exit_code, 2);
  EXPECT_EQ(run_rave({"bench", "swarm", "--noise", "pink"}).exit_code, 2);
  const Ended both = run_rave({"bench", "swarm", "--steps", "5", "--seconds", "5"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("--steps excludes --seconds"), std::string::npos) << both.err;
  EXPECT_EQ(run_rave({"bench", "swarm", "--robts=3"}).err,
            "rave: there is no option `--robts`; did you mean `--robots`?\n"
            "for usage: `rave bench swarm --help`\n");
}

TEST(BenchCompare, ABuildIsAsFastAsItselfAndDoesTheSame) {
  const std::string program = std::string(RAVE_BINARY_DIR) + "/bin/rave";
  const std::vector<std::string> words = {"bench",    "compare", RAVE_BINARY_DIR, program,
                                          "--robots", "50",      "--steps",       "40",
                                          "--rounds", "3"};
  const Ended ended = run_rave(words);
  const auto json = json_of(ended);
  EXPECT_EQ(json.at("same_hash"), true);
  EXPECT_EQ(json.at("rounds"), 3);
  EXPECT_GT(json.at("ratio").at("p10"), 0);
  EXPECT_GE(json.at("ratio").at("p90"), json.at("ratio").at("p10"));
  EXPECT_EQ(json.at("a").at("rave"), RAVE_BINARY_DIR "/bin/rave");
  EXPECT_TRUE(ended.err.starts_with("B does ")) << ended.err;
  EXPECT_TRUE(ended.err.ends_with("the same hash\n")) << ended.err;
}

TEST(BenchCompare, NamesTheBuildThatIsMissing) {
  const Ended ended = run_rave({"bench", "compare", RAVE_BINARY_DIR, "no/such/build"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err,
            "rave: there is no build `no/such/build`: expected a folder with `bin/rave`, or an "
            "executable file\n");
}

}  // namespace
}  // namespace rave::cli_test
