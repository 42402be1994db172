// SPDX-License-Identifier: Apache-2.0
// A driver that never opens or never closes: the run ends all the same.
#include <csignal>

#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

class StuckDriver : public SharedWorld {
 protected:
  /// Where the drivers are, and more options.
  static std::vector<std::string> plugins(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"--plugins",
                                      std::string(RAVE_BINARY_DIR) + "/tests/plugins/stuck"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  void interrupt(const std::string& who) {
    signal(who, SIGINT);
    // The driver would keep it for ever. A host that is ended by hand ends well, with its driver
    // named; a manager or a whole run that ends without it does not.
    EXPECT_EQ(end_of(who), who == "one" || who == "two" ? 0 : 1) << console(who);
  }
};

TEST_F(StuckDriver, HoldsUpNoEndAndIsNamed) {
  start("env", "env", "stuck.yaml", plugins());
  for (const char* const host : {"one", "two"}) start_host(host, "stuck.yaml", plugins());
  wait_for_line("one", "the device does not answer");
  interrupt("one");
  EXPECT_NE(console("one").find(
                "sensor `mocap` (driver `stuck_pose`) has not returned; the run ends without it"),
            std::string::npos)
      << console("one");
  const auto left = result("one");
  ASSERT_TRUE(left.is_object()) << console("one");
  EXPECT_EQ(left["host"], "one") << left.dump(1);
  EXPECT_GT(left["steps"], 0) << left.dump(1);

  EXPECT_TRUE(runs("two")) << console("two");
  interrupt("two");
  interrupt("env");
  const auto managed = result("env");
  ASSERT_EQ(managed["hosts"].size(), 2U) << managed.dump(1);
  for (const auto& host : managed["hosts"]) EXPECT_EQ(host["found"], true) << host;
  ASSERT_EQ(managed["robots"].size(), 2U) << managed.dump(1);
  EXPECT_EQ(managed["robots"][0]["name"], "left");
  EXPECT_EQ(managed["robots"][0]["reality"], "simulated") << "it was never handed over";
}

TEST_F(StuckDriver, HoldsUpNoEndOfARunInOneProcess) {
  start("run", "run", "stuck.yaml", plugins({"--processes", "1", "--no-picture"}));
  wait_for_line("run", "the device does not answer");
  interrupt("run");
  EXPECT_NE(console("run").find("(driver `stuck_pose`) has not returned"), std::string::npos)
      << console("run");
  EXPECT_TRUE(result("run").is_object()) << console("run");
}

TEST_F(StuckDriver, ThatNeverClosesHoldsUpNoEndEither) {
  start("run", "run", "endless.yaml", plugins({"--no-picture"}));
  EXPECT_EQ(end_of("run"), 0) << console("run");
  EXPECT_NE(console("run").find(
                "sensor `mocap` (driver `endless_pose`) is still closing; the run ends without it"),
            std::string::npos)
      << console("run");
  EXPECT_TRUE(result("run").is_object()) << console("run");
}

}  // namespace
}  // namespace rave::cli_test
