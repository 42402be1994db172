// SPDX-License-Identifier: Apache-2.0
// As many processes as a machine may be asked for.
#include <chrono>
#include <filesystem>
#include <fstream>

#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

// A process under a sanitizer takes 330 MB: a hundred of them are more than most machines have.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t kMany = 8;
#else
constexpr std::size_t kMany = 100;
#endif

class ManyHosts : public SharedWorld {
 protected:
  [[nodiscard]] std::string robots(std::size_t count) const {
    std::string path = folder("many.yaml");
    std::ofstream(path) << "name: many\nduration_s: 0.2\nrobots:\n  - {name: walker, file: "
                        << RAVE_SOURCE_DIR
                        << "/tests/cli/data/crowd_robot.yaml, scatter: {count: " << count
                        << ", x_m: [0, 20], y_m: [0, 20], clearance_m: 0.1}}\n";
    return path;
  }
};

TEST_F(ManyHosts, SoManyProcessesFindEachOtherAndGiveTheHashOfOne) {
  const std::string scenario = robots(kMany);
  const std::string alone = hash_alone(scenario, {});
  ASSERT_EQ(alone.size(), 16U);
  start("run", "run", scenario,
        {"--processes", std::to_string(kMany), "--pace", "max", "--no-record", "--no-picture"});
  wait_until([this] { return !runs("run"); }, "the run ends");
  if (HasFailure()) return;
  EXPECT_EQ(end_of("run"), 0) << console("run");
  const auto result = this->result("run");
  EXPECT_EQ(result["hash"], alone);
  EXPECT_EQ(result["hosts"].size(), kMany);
}

TEST_F(ManyHosts, MoreThanAMachineHasRoomForAreRefused) {
  const Ended ended = run_rave({"run", robots(101), "--processes", "101"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("expected 1 to 100, the number of hosts that fit"), std::string::npos)
      << ended.err;
}

TEST_F(ManyHosts, TooManyForRealTimeAreRefusedBeforeOneStarts) {
  const std::string scenario = robots(51);
  std::ofstream(scenario, std::ios::app) << "clock: real_time\n";
  const Ended ended = run_rave({"run", scenario, "--processes", "51", "--output", folder("run")});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("in real time at most 50 hosts can find each other"), std::string::npos)
      << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder("run") + "/hosts"));
}

TEST_F(ManyHosts, HostsOfARunThatCannotBeginAreInterrupted) {
  // The link looks like nothing, and no file can be made behind it.
  std::filesystem::create_directories(folder("run"));
  std::filesystem::create_symlink(folder("nowhere") + "/world.mcap", folder("run") + "/world.mcap");
  const auto began = std::chrono::steady_clock::now();
  const Ended ended =
      run_rave({"run", robots(2), "--processes", "2", "--no-picture", "--output", folder("run")});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("world.mcap"), std::string::npos) << ended.err;
  // They would wait a minute for a manager, and this process 20 s for each of them.
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(20));
}

}  // namespace
}  // namespace rave::cli_test
