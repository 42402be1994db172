// SPDX-License-Identifier: Apache-2.0
// Experiments: whatever ends a sweep, the next one goes on, and the table is the same to the byte.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The processes whose command line has a text.
std::size_t processes_with(const std::string& text) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    if (has(content_of(entry.path() / "cmdline"), text)) ++count;
  }
  return count;
}

class Sweep : public testing::Test {
 protected:
  [[nodiscard]] std::string out(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] Ended sweep(const std::string& name, const std::vector<std::string>& more = {},
                            const std::string& experiment = "study.yaml") const {
    std::vector<std::string> words = {"sweep", experiment, "--output", out(name)};
    words.insert(words.end(), more.begin(), more.end());
    return run_rave(words);
  }
  [[nodiscard]] std::string table(const std::string& name) const {
    return content_of(fs::path(out(name)) / "runs.csv");
  }
  /// An experiment of this test, beside a link to the data.
  [[nodiscard]] std::string written(const std::string& text) const {
    const std::string path = folder_.path() / "experiment.yaml";
    std::ofstream(path, std::ios::trunc) << text;
    return path;
  }

  TemporaryFolder folder_;
};

TEST_F(Sweep, DoesAllRunsOnceAndThenOnlyWhatIsMissing) {
  const Ended first = sweep("a");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(has(first.out, "28 runs, 28 of them now\n")) << first.out;
  const std::string all = table("a");
  EXPECT_EQ(lines_of(all), 29U);
  EXPECT_TRUE(all.starts_with(
      "condition,duration,mass,seed,failure,way,contacts,simulated_s,hash,command\n"));
  EXPECT_TRUE(has(all, "\n4,2,4,7,,")) << all;
  const Ended second = sweep("a");
  EXPECT_TRUE(has(second.out, "28 runs, 0 of them now\n")) << second.out;
  EXPECT_EQ(table("a"), all);
  // What the command of a row gives is what the row says.
  const std::size_t row = all.find("\n4,2,4,7,,");
  const Ended again =
      run_rave({"run", "good_scenario.yaml", "--set",
                "robots.herd={name: herd, file: crowd_robot.yaml, scatter: {count: "
                "3, x_m: [-3, 3], y_m: [-3, 3]}}",
                "--set", "duration_s=2", "--set", "robots.anna.robot.body.mass_kg=4", "--seed", "7",
                "--output", out("run"), "--no-picture", "--no-record"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const std::string result = content_of(fs::path(out("run")) / "result.json");
  const std::size_t at = result.find("\"hash\": \"") + 9;
  EXPECT_TRUE(has(all.substr(row), "," + result.substr(at, 16) + ","));
}

TEST_F(Sweep, DoesAgainWhatHasOtherInputs) {
  std::string text = content_of(fs::path(RAVE_SOURCE_DIR) / "tests/cli/data/study.yaml");
  const std::string folder = RAVE_SOURCE_DIR "/tests/cli/data/";
  text.replace(text.find("good_scenario"), 0, folder);
  EXPECT_EQ(sweep("a", {}, written(text)).exit_code, 0);
  text.replace(text.find("values: [1, 4]"), 14, "values: [1, 5]");
  const Ended changed = sweep("a", {}, written(text));
  EXPECT_TRUE(has(changed.out, "28 runs, 14 of them now\n")) << changed.out << changed.err;
}

TEST_F(Sweep, ThatIsKilledAtAnyMomentLosesNothing) {
  ASSERT_EQ(sweep("whole").exit_code, 0);
  std::mt19937 random(std::random_device{}());
  int rounds = 0;
  for (; rounds < 10; ++rounds) {
    const pid_t process = start_rave({"sweep", "study.yaml", "--output", out("killed")});
    const int wait_ms = std::uniform_int_distribution<int>(20, 500)(random);
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    ::kill(process, rounds % 2 == 0 ? SIGKILL : SIGINT);
    if (wait_for(process) == 0) break;
    // Runs end with their sweep, as soon as the system gets to it.
    for (int wait = 0; wait < 500 && processes_with(out("killed")) > 0; ++wait) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(processes_with(out("killed")), 0U);
  }
  const Ended last = sweep("killed");
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(table("killed"), table("whole")) << "after " << rounds << " rounds";
}

TEST_F(Sweep, InShardsGivesTheSameTable) {
  ASSERT_EQ(sweep("whole", {"--jobs", "1"}).exit_code, 0);
  const Ended first = sweep("parts", {"--shard", "2/3"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(has(first.out, "9 runs, 9 of them now")) << first.out;
  EXPECT_FALSE(fs::exists(fs::path(out("parts")) / "runs.csv"));
  EXPECT_EQ(sweep("parts", {"--shard", "1/3"}).exit_code, 0);
  const Ended rest = sweep("parts");
  EXPECT_TRUE(has(rest.out, "28 runs, 9 of them now")) << rest.out;
  EXPECT_EQ(table("parts"), table("whole"));
  EXPECT_EQ(sweep("parts", {"--shard", "4/3"}).exit_code, 2);
}

TEST_F(Sweep, OfAnotherExperimentIsRefused) {
  ASSERT_EQ(sweep("a").exit_code, 0);
  const Ended other =
      sweep("a", {},
            written("name: other\nscenario: " RAVE_SOURCE_DIR "/tests/cli/data/good_scenario.yaml\n"
                    "factors: [{name: t, key: duration_s, values: [1]}]\n"
                    "metrics: [{name: way, value: robots.anna.way_m}]\n"));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(has(other.err, "has the runs of the experiment `study`")) << other.err;
}

TEST_F(Sweep, RepeatsASampleAndFindsWhatDiffers) {
  ASSERT_EQ(sweep("a").exit_code, 0);
  const Ended equal = sweep("a", {"--verify", "4"});
  EXPECT_EQ(equal.exit_code, 0) << equal.err;
  EXPECT_EQ(equal.out, "equal\n");
  const fs::path ledger = fs::path(out("a")) / "ledger.jsonl";
  std::string text = content_of(ledger);
  for (std::size_t at = 0; (at = text.find("\"hash\": \"", at)) != std::string::npos; ++at) {
    text[at + 9] = text[at + 9] == '0' ? '1' : '0';
  }
  std::ofstream(ledger, std::ios::trunc) << text;
  const Ended differs = sweep("a", {"--verify", "2"});
  EXPECT_EQ(differs.exit_code, 1);
  EXPECT_TRUE(has(differs.err, "differs: duration=")) << differs.err;
}

/// One robot, whose program is a factor.
std::string with_programs(const std::string& programs, const std::string& more) {
  return "name: programs\nscenario: " RAVE_SOURCE_DIR "/tests/cli/data/good_scenario.yaml\n" +
         ("factors: [{name: program, key: robots.anna.robot.program.driver, values: [" + programs) +
         "]}]\nrepetitions: 2\nmetrics: [{name: way, value: robots.anna.way_m}]\n" + more;
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST_F(Sweep, ARunThatCrashesIsARowWithItsReason) {
  const std::string experiment = written(with_programs("wander, crash", "recordings: failures\n"));
  const std::vector<std::string> plugins = {"--plugins", RAVE_BINARY_DIR "/tests/plugins/crash"};
  const Ended ended = sweep("a", plugins, experiment);
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_TRUE(has(ended.out, "4 runs, 4 of them now, 2 failed")) << ended.out;
  EXPECT_TRUE(has(ended.err, "failed: program=crash, seed 1: ended by signal 11")) << ended.err;
  EXPECT_TRUE(has(ended.err, "--set 'robots.anna.robot.program.driver=\"crash\"' --seed 1"));
  EXPECT_TRUE(has(table("a"), "2,crash,1,ended by signal 11")) << table("a");
  EXPECT_TRUE(has(table("a"), "crashed (segmentation fault) in program `crash` of robot `anna`"));
  EXPECT_TRUE(fs::exists(fs::path(out("a")) / "runs/c2-s1"));
  EXPECT_FALSE(fs::exists(fs::path(out("a")) / "runs/c1-s1"));
  EXPECT_TRUE(has(sweep("a", plugins, experiment).out, "4 runs, 0 of them now, 2 failed"));
  std::vector<std::string> retry = plugins;
  retry.emplace_back("--retry");
  EXPECT_TRUE(has(sweep("a", retry, experiment).out, "4 runs, 2 of them now, 2 failed"));
}

#endif

TEST_F(Sweep, IsRefusedWhereAnotherIsAtWork) {
  const std::string endless = written(with_programs("wander", "set: {duration_s: 1000000}\n"));
  const pid_t process = start_rave({"sweep", endless, "--output", out("a")});
  while (!fs::exists(fs::path(out("a")) / "plan.json")) std::this_thread::yield();
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--shard", "1/2"}}) {
    const Ended second = sweep("a", more, endless);
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_TRUE(has(second.err, "another sweep is at work in")) << second.err;
  }
  ::kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 1) << "Ctrl-C ends the runs";
}

TEST_F(Sweep, ARunThatTakesTooLongIsARowWithItsReason) {
  const Ended ended = sweep(
      "a", {},
      written(with_programs("wander", "set: {duration_s: 1000000}\nlimits: {wall_s: 0.5}\n")));
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_TRUE(has(table("a"), "1,wander,2,no end within 0.5 s of wall time,")) << table("a");
}

TEST_F(Sweep, KeepsTheRecordingsOfTheBestAndTheWorst) {
  const Ended ended = sweep(
      "a", {},
      written(with_programs("wander, cruise", "recordings: extremes\n") +
              "set: {robots.anna.pose: null, robots.anna.scatter: {x_m: [-1, 1], y_m: [0, 1]}}\n"));
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* const run : {"c1-s1", "c1-s2", "c2-s1", "c2-s2"}) {
    EXPECT_TRUE(fs::exists(fs::path(out("a")) / "runs" / run / "run.mcap")) << run;
  }
}

TEST_F(Sweep, FindsBadValuesBeforeTheFirstRun) {
  const auto expect = [&](const std::string& text, const std::string& part) {
    const std::string file = written(text);
    for (const Ended& ended : {sweep("a", {}, file), run_rave({"check", file})}) {
      EXPECT_EQ(ended.exit_code, 2);
      EXPECT_TRUE(has(ended.err, part)) << ended.err;
    }
    EXPECT_FALSE(fs::exists(out("a")));
  };
  const std::string head = "name: bad\nscenario: " RAVE_SOURCE_DIR
                           "/tests/cli/data/good_scenario.yaml\nmetrics: [{name: way, value: "
                           "robots.anna.way_m}]\nfactors:\n";
  expect(head + "  - {name: t, key: duration_s, values: [1, 2, -3]}\n",
         "experiment.yaml:5:47: condition 3 of 3 (t=-3): ");
  expect(head + "  - {name: t, key: durations_s, values: [1]}\n", "did you mean `duration_s`?");
  expect(head + "  - {name: t, key: robots.ana.pose.x_m, values: [1]}\n", "did you mean `anna`?");
  expect(head + "  - {name: p, key: robots.anna.robot.program.params, values: [{avoid_m: -1}]}\n",
         "condition 1 of 1");
  expect(
      "name: bad\nscenario: nowhere.yaml\nmetrics: [{name: way, value: w}]\nfactors:\n"
      "  - {name: t, key: duration_s, values: [1]}\n",
      "experiment.yaml:2:11: there is no scenario `nowhere.yaml`");
}

TEST_F(Sweep, AMetricThatNoRunHasEndsItWithTheNearestName) {
  const Ended ended =
      sweep("a", {},
            written("name: bad\nscenario: " RAVE_SOURCE_DIR "/tests/cli/data/good_scenario.yaml\n"
                    "metrics: [{name: way, value: robots.anna.wy_m}]\n"
                    "factors: [{name: t, key: duration_s, values: [1]}]\n"));
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_TRUE(has(ended.err, "experiment.yaml:3:30: the metric `way`: result.json has no `wy_m`"))
      << ended.err;
  EXPECT_TRUE(has(ended.err, "did you mean `way_m`?")) << ended.err;
}

TEST_F(Sweep, TheReportSaysWhetherTheRunsShowWhatTheFileExpects) {
  ASSERT_EQ(sweep("a").exit_code, 0);
  const Ended good = run_rave({"report", out("a")});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_TRUE(good.out.starts_with("Does a longer way take longer?\n")) << good.out;
  const std::string page = content_of(fs::path(out("a")) / "report.html");
  EXPECT_TRUE(has(page, "<h1>Does a longer way take longer?</h1>"));
  EXPECT_TRUE(has(content_of(fs::path(out("a")) / "conditions.csv"), "\n4,2,4,way,7,7,"));
  std::string text = content_of(fs::path(out("a")) / "experiment.yaml");
  text.replace(text.find("expect: more"), 12, "expect: less");
  std::ofstream(fs::path(out("a")) / "experiment.yaml", std::ios::trunc) << text;
  const Ended bad = run_rave({"report", out("a"), "--output", out("page")});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_TRUE(has(content_of(fs::path(out("page")) / "report.html"), "expected: less"));
  EXPECT_EQ(run_rave({"report"}).exit_code, 2);
  EXPECT_TRUE(has(run_rave({"report", out("nowhere")}).err, "is not the folder of a sweep"));
}

/// What comes with RAVE shows what its file expects.
TEST_F(Sweep, ShippedExperimentsHaveTheirExpectedConclusion) {
  for (const char* const name : {"prey-speed", "rear-sonar"}) {
    const Ended swept = sweep(name, {}, name);
    EXPECT_EQ(swept.exit_code, 0) << swept.err;
    const Ended report = run_rave({"report", out(name)});
    EXPECT_EQ(report.exit_code, 0) << report.out;
    EXPECT_TRUE(has(report.out, "As expected.")) << report.out;
  }
}

TEST_F(Sweep, CheckPrintsThePlan) {
  const Ended ended = run_rave({"check", "study.yaml"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(has(ended.out, "experiment with 4 conditions of 7 runs each, 28 in all\n"))
      << ended.out;
  EXPECT_TRUE(has(ended.out, "question: Does a longer way take longer?\n"));
  EXPECT_TRUE(has(ended.out, "seeds 3 to 9, the same in every condition\n"));
  EXPECT_TRUE(has(ended.out, "  at most about "));
}

}  // namespace
}  // namespace rave::cli_test
