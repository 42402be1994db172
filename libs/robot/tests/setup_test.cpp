// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/robot/program.hpp"

namespace rave {
namespace {

SensorInfo sensor(const char* name, ReadingKind kind) {
  SensorInfo info;
  info.name = name;
  info.kind = kind;
  return info;
}

class SetupTest : public testing::Test {
 protected:
  SetupTest() {
    raw_.robot.name = "rover";
    raw_.sensors = sensors_;
    raw_.sensor_count = std::size(sensors_);
    raw_.controllers = controllers_;
    raw_.controller_count = std::size(controllers_);
  }

  SensorInfo sensors_[4] = {
      sensor("odometry", ReadingKind::kOdometry), sensor("front_laser", ReadingKind::kRanges),
      sensor("camera", ReadingKind::kSightings), sensor("rear_laser", ReadingKind::kRanges)};
  ControllerInfo controllers_[3] = {{"drive", CommandKind::kVelocity, 0},
                                    {"go_to", CommandKind::kGoal, 0},
                                    {"slow_drive", CommandKind::kVelocity, 0}};
  ProgramSetup raw_;
  rave::Setup setup_{raw_};
};

TEST_F(SetupTest, FindsSensorsByName) {
  const auto found = setup_.sensor<float>("rear_laser");
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_TRUE(found->valid());
  EXPECT_EQ(found->index(), 3U);
  EXPECT_EQ(&found->info(), &sensors_[3]);
}

TEST_F(SetupTest, FindsTheFirstSensorOfAKind) {
  EXPECT_EQ(setup_.sensor<float>()->index(), 1U);
  EXPECT_EQ(setup_.sensor<Sighting>()->index(), 2U);
}

TEST_F(SetupTest, ListsAllSensorsOfAKind) {
  const auto lasers = setup_.all_sensors<float>();
  ASSERT_EQ(lasers.size(), 2U);
  EXPECT_EQ(lasers[0].index(), 1U);
  EXPECT_EQ(lasers[1].index(), 3U);
  EXPECT_TRUE(setup_.all_sensors<PoseReading>().empty());
}

TEST_F(SetupTest, NamesTheSensorsThereAre) {
  const auto missing = setup_.sensor<float>("laser");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(missing.error().text(),
            "robot `rover` has no sensor of kind `ranges` named `laser`, which its program "
            "requires; sensors of that kind: front_laser and rear_laser");
}

TEST_F(SetupTest, ASensorOfAnotherKindIsNotFound) {
  const auto missing = setup_.sensor<Sighting>("front_laser");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text(),
            "robot `rover` has no sensor of kind `sightings` named `front_laser`, which its "
            "program requires; sensors of that kind: camera");
}

TEST_F(SetupTest, SaysThatThereIsNoSensorOfAKind) {
  const auto missing = setup_.sensor<ContactReading>();
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text(),
            "robot `rover` has no sensor of kind `contact`, which its program requires; "
            "sensors of that kind: none");
}

TEST_F(SetupTest, FindsControllers) {
  EXPECT_EQ(setup_.controller(CommandKind::kVelocity)->index(), 0U);
  EXPECT_EQ(setup_.controller(CommandKind::kVelocity, "slow_drive")->index(), 2U);
  EXPECT_EQ(setup_.controller(CommandKind::kGoal)->index(), 1U);
}

TEST_F(SetupTest, NamesTheControllersThereAre) {
  const auto missing = setup_.controller(CommandKind::kVelocity, "go_to");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(missing.error().text(),
            "robot `rover` has no controller that accepts `velocity` named `go_to`, which its "
            "program requires; controllers that do: drive and slow_drive");
  const auto none = setup_.controller(CommandKind::kJoint);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().text(),
            "robot `rover` has no controller that accepts `joint`, which its program requires; "
            "controllers that do: none");
}

}  // namespace
}  // namespace rave
