// SPDX-License-Identifier: Apache-2.0
// A run over two processes that a C++ program starts.
#include "rave/launch/shared_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <random>

#include "rave/host/run.hpp"
#include "rave/launch/plugin_folders.hpp"
#include "rave/launch/run_bus.hpp"
#include "rave/launch/run_folder.hpp"

namespace rave::launch::testing {
namespace {

namespace fs = std::filesystem;

/// A flock, whose robots sense and hear each other, in a folder of the test.
class SharedRunTest : public ::testing::Test {
 protected:
  SharedRunTest() {
    settings_.program = fs::path(RAVE_BINARY_DIR) / "bin" / "rave";
    settings_.no_picture = true;
    settings_.no_record = true;
    // Tests beside this one use the bus, too. Higher domains have ports that the kernel gives away.
    std::random_device chance;
    settings_.bus.tag = "launch-" + std::to_string(::getpid()) + "-" + std::to_string(chance());
    settings_.bus.domain = 1 + chance() % 90;
    fs::remove_all(folder_);
  }
  ~SharedRunTest() override { fs::remove_all(folder_); }

  static Result<config::ExpandedScenario> flock(int processes) {
    RAVE_TRY_ASSIGN(auto scenario,
                    config::expand_scenario(fs::path(RAVE_SOURCE_DIR) / "scenarios/flock"
                                                                        "/scenario.yaml"));
    scenario.scenario.duration_s = 2;
    scenario.scenario.pace = *config::parse_pace("max");
    scenario.scenario.picture.reset();
    scenario.scenario.processes = processes;
    if (processes == 1) scenario.scenario.processes.reset();
    return scenario;
  }

  Result<runtime::RunOutcome> run_alone() {
    RAVE_TRY_ASSIGN(const auto scenario, flock(1));
    RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue({}, settings_.program));
    runtime::RunOptions options;
    options.output = folder_ / "alone";
    options.picture = false;
    options.record = false;
    return runtime::run(scenario, *catalogue, options);
  }

  Result<runtime::RunOutcome> run_shared(int processes) {
    RAVE_TRY_ASSIGN(const auto scenario, flock(processes));
    RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
    RAVE_TRY_ASSIGN(const auto bus, bus_of_own_run(settings_.bus, scenario, hosts, false));
    RAVE_TRY_ASSIGN(const auto folder, RunFolder::create({folder_ / "shared"}, "flock"));
    RAVE_TRY_ASSIGN(const auto run,
                    SharedRun::start(scenario, hosts,
                                     {settings_, bus, folder.path(), log_, control_,
                                      [this](const auto& progress) { sim_s_ = progress.sim_s; }}));
    return run->finish();
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("rave_launch_" + std::to_string(::getpid()));
  RunSettings settings_;
  NullLogSink log_;
  runtime::RunControl control_;
  double sim_s_ = -1;  ///< Of the last progress; -1: there was none.
};

TEST_F(SharedRunTest, TwoProcessesGiveTheHashOfOne) {
  const auto alone = run_alone();
  ASSERT_TRUE(alone) << alone.error().text();
  ASSERT_EQ(alone->hash.size(), 16U);
  const auto shared = run_shared(2);
  ASSERT_TRUE(shared) << shared.error().text();
  EXPECT_TRUE(shared->whole) << (shared->problems.empty() ? "" : shared->problems.front());
  EXPECT_EQ(shared->hash, alone->hash);
  // A fast machine is through before the second one.
  EXPECT_GE(sim_s_, 0);
  // Each host was a process with a folder of its own.
  const auto folders = fs::directory_iterator(folder_ / "shared" / "hosts");
  EXPECT_EQ(std::distance(fs::begin(folders), fs::end(folders)), 2);
  EXPECT_TRUE(fs::exists(folder_ / "shared" / "result.json"));
}

TEST_F(SharedRunTest, AProgramThatIsMissingIsNamed) {
  settings_.program = fs::path(RAVE_BINARY_DIR) / "bin" / "no-such-rave";
  const auto shared = run_shared(2);
  ASSERT_FALSE(shared);
  EXPECT_EQ(shared.error().code, ErrorCode::kNotFound);
  EXPECT_NE(shared.error().message.find("bin/no-such-rave`"), std::string::npos)
      << shared.error().text();
}

}  // namespace
}  // namespace rave::launch::testing
