// SPDX-License-Identifier: Apache-2.0
// Runs whose machine does a third of what they ask: what they say of it.
#include <csignal>

#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class LateRun : public SharedWorld {
 protected:
  static Words plugins(const Words& more = {}) {
    Words words = {"--plugins", std::string(RAVE_BINARY_DIR) + "/tests/plugins/overload",
                   "--no-picture"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// What `rave top` says of the only run there is.
  [[nodiscard]] Json top(const Words& more) const {
    Words words = {"top", "--json", "--once"};
    words.insert(words.end(), more.begin(), more.end());
    for (const std::string& word : apart()) words.push_back(word);
    const Ended ended = run_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()});
    return Json::parse(ended.out, nullptr, false);
  }
  [[nodiscard]] static Json host(const Json& document, const std::string& name) {
    for (const Json& host : document.value("hosts", Json::array())) {
      if (host["name"] == name) return host;
    }
    return Json::object();
  }
};

void expect_late(const Json& result, const std::string& phase) {
  const Json& late = result["lateness"];
  ASSERT_TRUE(late.is_object()) << result.dump(1);
  EXPECT_GE(late["deadlines"], 50) << late;
  EXPECT_GT(late["missed_pct"], 90) << late;
  EXPECT_GT(late["worst_s"], 0.5) << late;
  EXPECT_GT(late["blame"].value(phase, 0), 40) << late;
  EXPECT_EQ(late["robots_stopped"], 0) << "none is real";
}

TEST_F(LateRun, InPacedLockStepIsWholeAndSaysHowLateItWas) {
  start("run", "run", "late.yaml", plugins());
  EXPECT_EQ(end_of("run"), 0) << console("run");
  const Json result = this->result("run");
  EXPECT_EQ(result["whole"], true) << "nothing depends on the clock";
  EXPECT_TRUE(result["hash"].is_string());
  ASSERT_NO_FATAL_FAILURE(expect_late(result, "decide"));
  EXPECT_NE(content_of(folder("run") + "/summary.txt").find(" missed ("), std::string::npos);
  EXPECT_NE(console("run").find("most of the time is spent in `decide`"), std::string::npos)
      << console("run");
  EXPECT_NE(console("run").find("deadlines of steps: "), std::string::npos) << console("run");
}

TEST_F(LateRun, OfSeveralProcessesInLockStepWaitsForTheHosts) {
  start("run", "run", "late.yaml", plugins({"--processes", "2"}));
  EXPECT_EQ(end_of("run"), 0) << console("run");
  const Json result = this->result("run");
  EXPECT_EQ(result["whole"], true);
  EXPECT_TRUE(result["hash"].is_string());
  ASSERT_NO_FATAL_FAILURE(expect_late(result, "exchange"));
}

TEST_F(LateRun, WithoutAPaceHasNoDeadlines) {
  start("run", "run", "late.yaml", plugins({"--pace", "max"}));
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_TRUE(this->result("run").at("lateness").is_null());
  EXPECT_EQ(content_of(folder("run") + "/summary.txt").find("deadlines"), std::string::npos);
}

TEST_F(LateRun, OnTheWallClockIsNotWholeThoughItEndsInTime) {
  start("run", "run", "late_live.yaml", plugins({"--duration", "3"}));
  EXPECT_EQ(end_of("run"), 1) << console("run");
  const Json result = this->result("run");
  EXPECT_EQ(result["whole"], false) << result.dump(1);
  const std::string problems = result["problems"].dump();
  EXPECT_NE(problems.find("host `slow`: more than 1 % of the deadlines were missed"),
            std::string::npos)
      << problems;
  const Json& late = result["lateness"];
  EXPECT_GT(late["missed_pct"], 40) << late << " of both hosts";
  EXPECT_GT(late["blame"].value("decide", 0), 100) << late;
  const Json slow = Json::parse(content_of(folder("run") + "/hosts/slow/result.json"));
  EXPECT_GT(slow["lateness"]["missed_pct"], 90) << slow["lateness"];
  EXPECT_EQ(slow["whole"], false);
}

TEST_F(LateRun, OnTheWallClockShowsTheSpeedOfItsSlowestHost) {
  start("run", "run", "late_live.yaml", plugins());
  Json seen;
  wait_until(
      [&] {
        seen = top({});
        return seen.is_object() && seen["phase"] == "running" && seen["speed"].is_number() &&
               seen["speed"] > 0 && host(seen, "slow").value("missed_pct", Json()).is_number();
      },
      "the speed is known");
  EXPECT_LT(seen["speed"], 0.6) << "it does a third of its steps";
  EXPECT_GT(host(seen, "slow")["missed_pct"], 90) << seen.dump(1);
  EXPECT_EQ(host(seen, "slow")["late_phase"], "decide");
  EXPECT_GT(host(seen, "slow")["behind_s"], 0.05);
  signal("run", SIGINT);
  EXPECT_EQ(end_of("run"), 1);
}

TEST_F(LateRun, OfOneProcessIsShownByTopToo) {
  start("run", "run", "late.yaml", plugins({"--duration", "1000"}));
  Json seen;
  wait_until(
      [&] {
        seen = top({});
        return seen.is_object() && seen["speed"].is_number() && seen["hosts"].size() == 1 &&
               seen["hosts"][0]["missed_pct"].is_number();
      },
      "the run is seen");
  EXPECT_LT(seen["speed"], 0.6);
  EXPECT_GT(seen["hosts"][0]["missed_pct"], 90) << seen.dump(1);
  EXPECT_EQ(seen["hosts"][0]["late_phase"], "decide");
  signal("run", SIGINT);
  EXPECT_EQ(end_of("run"), 0);
}

}  // namespace
}  // namespace rave::cli_test
