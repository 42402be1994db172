// SPDX-License-Identifier: Apache-2.0
// Drives that come over the bus: whose they are, which of them count, and how many.
#include "rave/control/commands.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "rave/control/host_leases.hpp"

namespace rave::control {
namespace {

using runtime::RunRequest;

/// A run of two robots that hears a writer of the bus.
class CommandsTest : public ::testing::Test {
 public:
  CommandsTest() {
    scenario_.robots.resize(2);
    scenario_.robots[0].name = "anna";
    scenario_.robots[1].name = "bert";
    control_.begin({});
    take_ = commands_of(control_, scenario_);
  }
  ~CommandsTest() override { control_.end(); }

 protected:
  void hear(std::uint64_t writer, std::uint32_t robot, std::uint64_t number, double v_mps,
            std::string by = "lisa") {
    RunRequest drive;
    drive.by = std::move(by);
    drive.v_mps = v_mps;
    drive.page = 7;
    bus::Command command = drive_command(drive, robot, number);
    command.writer = writer;
    take_(command);
  }
  /// What the run is asked now.
  std::vector<RunRequest> asked() {
    std::vector<RunRequest> asked;
    control_.serve(
        [&asked](const RunRequest& request) -> Result<std::string> {
          asked.push_back(request);
          return "done";
        },
        [](runtime::RunStatus&) {});
    return asked;
  }

  runtime::RunControl control_;
  config::ExpandedScenario scenario_;
  bus::OnCommand take_;
};

TEST_F(CommandsTest, AreDrivesOfTheirAuthorAndPage) {
  hear(1, 1, 1, 0.25);
  const auto requests = asked();
  ASSERT_EQ(requests.size(), 1U);
  EXPECT_EQ(requests[0].kind, RunRequest::Kind::kDrive);
  EXPECT_EQ(requests[0].robot, "bert");
  EXPECT_EQ(requests[0].by, "lisa");
  EXPECT_EQ(requests[0].v_mps, 0.25);
  EXPECT_EQ(requests[0].page, 7U);
  EXPECT_FALSE(requests[0].overrides) << "nobody is a super-user by what they say themselves";
}

TEST_F(CommandsTest, OfAWriterNothingOlderThanWhatItSaidLastCounts) {
  hear(1, 0, 5, 0.5);
  hear(1, 0, 4, 0.4);
  hear(1, 0, 5, 0.6);
  hear(1, 1, 3, 0.3);
  hear(2, 0, 1, 0.1);
  hear(1, 0, 6, 0.7);
  std::vector<double> speeds;
  for (const RunRequest& request : asked()) speeds.push_back(request.v_mps);
  EXPECT_EQ(speeds, (std::vector<double>{0.5, 0.3, 0.1, 0.7}))
      << "each writer counts for itself, and of each robot";
}

TEST_F(CommandsTest, NobodyOnTheBusIsTheTerminalAndOtherKindsAreNotTaken) {
  hear(1, 0, 1, 0.5, std::string(runtime::HostLeases::kTerminal));
  hear(1, 2, 1, 0.5);
  bus::Command command{};
  command.kind = rave_wire_COMMAND_GOAL;
  command.number = 9;
  take_(command);
  EXPECT_TRUE(asked().empty());
}

TEST_F(CommandsTest, AProcessTakesFiveThousandInASecond) {
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t i = 1; i <= 20'000; ++i) hear(i % 8 + 1, 0, i, 0.1);
  const double passed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::size_t taken = asked().size();
  EXPECT_GE(taken, 5000U);
  EXPECT_LE(static_cast<double>(taken), 5001 + 5000 * passed_s);
}

}  // namespace
}  // namespace rave::control
