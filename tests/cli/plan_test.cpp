// SPDX-License-Identifier: Apache-2.0
// `rave run --dry-run` says what a run would do.
#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

TEST(Run, ADryRunPrintsThePlanAndStartsNothing) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const std::string change = "changes=[{at_s: 1, robot: anna, set: {body.scale: 1.2}}]";
  const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", output, "--dry-run",
                                "--processes", "2", "--set", change});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.out,
            "scenario `small`: 2 s, step 0.01 s, seed 1, pace max\n"
            "processes:\n"
            "  this process: Environment Manager\n"
            "  host `host-1`, which this process starts: 1 robot: `anna`\n"
            "  host `host-2`, which this process starts: 2 robots: `herd-1` to `herd-2`\n"
            "people:\n"
            "  the rights of their roles\n"
            "what happens:\n"
            "  at 1 s: `anna`: body.scale = 1.2\n"
            "  at 2 s: the run ends\n");
  EXPECT_FALSE(fs::exists(output));
  const Ended alone = run_rave(
      {"run", "good_scenario.yaml", "--output", output, "--dry-run", "--set", "duration_s=none"});
  EXPECT_NE(alone.out.find("  this process: 3 robots: `anna`, `herd-1` to `herd-2`\n"),
            std::string::npos)
      << alone.out;
  EXPECT_NE(alone.out.find("  at Ctrl-C or `rave end`: the run ends\n"), std::string::npos)
      << alone.out;
  EXPECT_FALSE(fs::exists(output));
  EXPECT_EQ(run_rave({"run", "unusable_driver.yaml", "--dry-run"}).exit_code, 2);
}

TEST(Run, ThePlanHasPeopleAndCompanions) {
  const Ended convoy = run_rave({"run", RAVE_SOURCE_DIR "/scenarios/convoy", "--dry-run", "--set",
                                 "companions=[{name: helper, command: [sleep, \"5\"]}]"});
  EXPECT_EQ(convoy.exit_code, 0) << convoy.err;
  for (const char* const line :
       {"  `ann`, commander: front, rear\n", "  `bob`, commander: no team\n",
        "  `sue`, super-user: all teams\n",
        "  after `the front is through`, 10 s later: team `rear` is given to `bob`\n"}) {
    EXPECT_NE(convoy.out.find(line), std::string::npos) << line << convoy.out;
  }
  EXPECT_NE(convoy.out.find("  companion `helper`: sleep 5\n"), std::string::npos) << convoy.out;
}

}  // namespace
}  // namespace rave::cli_test
