// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "programs/testing/program_harness.hpp"

namespace rave {
namespace {

using testing::ProgramUnderTest;
using testing::Rig;
using testing::RigSensor;

constexpr std::int64_t kTenth_ns = 100'000'000;

class ObeyTest : public ::testing::Test {
 protected:
  void start() {
    rig_.controllers.push_back({"navigate", CommandKind::kGoal, 0});
    ASSERT_EQ(program_.start(1), "");
  }
  /// Both commands of the decision at `k` tenths of a second.
  std::pair<Command, Command> decide(std::int64_t k) {
    for (Command& command : rig_.commands) command = {};
    program_.decide({k * kTenth_ns});
    return {rig_.commands[0], rig_.commands[1]};
  }

  ProgramUnderTest program_{rave_register_plugin, "obey"};
  Rig& rig_ = program_.add_robot();
  RigSensor& velocity_ = rig_.add(ReadingKind::kVelocity, "cmd_vel");
};

TEST_F(ObeyTest, VelocitiesCountAsLongAsTheyAreFresh) {
  start();
  EXPECT_EQ(decide(0).first, velocity_command(0, 0)) << "before the first";
  velocity_.give<VelocityReading>({{0.3, -0.2}}, 1 * kTenth_ns);
  EXPECT_EQ(decide(1).first, velocity_command(0.3, -0.2));
  EXPECT_EQ(decide(6).first, velocity_command(0.3, -0.2));
  EXPECT_EQ(decide(7).first, velocity_command(0, 0));
}

TEST_F(ObeyTest, AGoalCountsUntilAVelocityComes) {
  RigSensor& goal = rig_.add(ReadingKind::kPose, "goal_pose");
  rig_.params.set("speed_mps", 0.4);
  start();
  goal.give<PoseReading>({{3, -1, 0, 0, 0}}, 2 * kTenth_ns);
  EXPECT_EQ(decide(2).second, goal_command(3, -1, 0.4));
  EXPECT_EQ(decide(50).second, goal_command(3, -1, 0.4)) << "goals do not age";
  velocity_.give<VelocityReading>({{0.1, 0}}, 51 * kTenth_ns);
  EXPECT_EQ(decide(51), std::pair(velocity_command(0.1, 0), Command{}));
  EXPECT_EQ(decide(60), std::pair(velocity_command(0, 0), Command{})) << "it does not go back";
  goal.give<PoseReading>({{4, 0, 0, 0, 0}}, 61 * kTenth_ns);
  EXPECT_EQ(decide(61).second, goal_command(4, 0, 0.4));
}

TEST(Obey, NeedsOneOfTheTwo) {
  ProgramUnderTest program(rave_register_plugin, "obey");
  Rig& rig = program.add_robot();
  rig.add(ReadingKind::kPose, "mocap");
  EXPECT_NE(program.start(1).find("cmd_vel"), std::string::npos);
}

TEST(Obey, AGoalNeedsAControllerThatTakesIt) {
  ProgramUnderTest program(rave_register_plugin, "obey");
  Rig& rig = program.add_robot();
  rig.add(ReadingKind::kPose, "goal_pose");
  EXPECT_NE(program.start(1), "");
}

}  // namespace
}  // namespace rave
