// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <thread>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

TEST(Run, LeavesEverythingInOneFolder) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", output});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(ended.out.ends_with("done\n")) << ended.out;
  for (const char* const file : {"summary.txt", "result.json", "picture.svg", "picture.png",
                                 "events.log", "scenario.yaml", "console.log"}) {
    EXPECT_TRUE(fs::exists(output + "/" + file)) << file;
    EXPECT_NE(ended.out.find(file), std::string::npos) << file;
  }
}

TEST(Run, QuietWithoutPicture) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const Ended ended =
      run_rave({"run", "good_scenario.yaml", "--output", output, "--quiet", "--no-picture"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.out + ended.err, "");
  EXPECT_FALSE(fs::exists(output + "/picture.svg"));
}

TEST(Run, OverridesComeBeforeTheFile) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", output, "--seed", "41",
                                "--duration", "0.5", "--threads", "2", "--pace", "500x"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::string used = content_of(output + "/scenario.yaml");
  EXPECT_NE(used.find("\nseed: 41"), std::string::npos);
  EXPECT_NE(used.find("\nduration_s: 0.5"), std::string::npos);
  EXPECT_NE(used.find("\nthreads: 2"), std::string::npos);
  EXPECT_NE(used.find("\npace: \"500x\""), std::string::npos);
}

TEST(Run, UnknownScenarioNamesTheNearest) {
  const Ended ended = run_rave({"run", "smal"}, {"RAVE_SHARE=share"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err,
            "rave: there is no scenario `smal`: neither a file nor a folder, nor a name below "
            "`scenarios` of this folder or `share`; did you mean `small`?\n");
}

TEST(Run, ScenarioByName) {
  const TemporaryFolder folder;
  const Ended ended = run_rave({"run", "small", "--output", folder.path()}, {"RAVE_SHARE=share"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST(Run, BadInputLeavesNoFolder) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  for (const char* const file : {"empty_scenario.yaml", "unusable_driver.yaml"}) {
    const Ended ended = run_rave({"run", file, "--output", output});
    EXPECT_EQ(ended.exit_code, 2) << file;
    EXPECT_EQ(ended.out, "") << file;
    EXPECT_FALSE(fs::exists(output)) << file;
  }
  EXPECT_EQ(run_rave({"run", "good_scenario.yaml", "--pace", "fast"}).exit_code, 2);
}

TEST(Run, FirstSignalEndsItEarlyWithItsResults) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const pid_t process = start_rave({"run", "good_scenario.yaml", "--output", output, "--duration",
                                    "100000", "--pace", "realtime"});
  ASSERT_GT(process, 0);
  // The run writes this file after it began to listen.
  while (!fs::exists(output + "/scenario.yaml") && ::waitpid(process, nullptr, WNOHANG) == 0) {
    std::this_thread::yield();
  }
  ASSERT_EQ(::kill(process, SIGINT), 0);
  EXPECT_EQ(wait_for(process), 1);
  EXPECT_TRUE(fs::exists(output + "/result.json"));
}

}  // namespace
}  // namespace rave::cli_test
