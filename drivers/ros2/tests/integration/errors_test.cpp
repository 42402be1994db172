// SPDX-License-Identifier: Apache-2.0
#include "rave/base_testing/no_threads.hpp"
#include "ros2_bench.hpp"

namespace rave::ros2_driver {
namespace {

using testing::LiveActuator;
using testing::LiveSensor;

TEST(Ros2Errors, WhoIsNotThereIsLookedForAndNamed) {
  Ros2Bench bench;
  bench.given["start_timeout_s"] = 2.0;
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  ASSERT_EQ(bench.odometry.configure({}, bench.device.base()), "") << "now all is known of it";
  LiveSensor laser(bench.plugin, "ros2_laser");
  EXPECT_EQ(laser.configure({{"topic", "front"}}, bench.device.base()),
            "no message came on `/cart/front` within 2 s: no participant writes `/cart/front`; the "
            "type sensor_msgs/msg/LaserScan is at /cart/scan");
  EXPECT_EQ(laser.configure({{"topic", "imu"}}, bench.device.base()),
            "no message came on `/cart/imu` within 2 s: topic `/cart/imu` has the type "
            "sensor_msgs/msg/Imu; expected sensor_msgs/msg/LaserScan");
  LiveActuator drive(bench.plugin, "ros2_velocity");
  EXPECT_EQ(drive.open({{"message", "twist_stamped"}}, bench.device.base()),
            "no robot to drive was found within 2 s: topic `/cart/cmd_vel` has the type "
            "geometry_msgs/msg/Twist; expected geometry_msgs/msg/TwistStamped");
  LiveSensor tf(bench.plugin, "ros2_tf_pose");
  EXPECT_EQ(tf.configure({{"base_frame", "gripper"}}, bench.device.base()),
            "`/tf` has no pose of the robot: no transform leads from `map` to `gripper`: `gripper` "
            "has no parent");
}

TEST(Ros2Errors, WithoutAThreadTheRobotIsNotOpenedAndLaterItIs) {
  Ros2Bench bench;
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(bench.device.open().find("cannot start the thread of the robot: "), 0U);
  }
  ASSERT_EQ(bench.odometry.configure({}, bench.device.base()), "");
  ASSERT_EQ(bench.laser.configure({}, bench.device.base()), "");
  ASSERT_NO_FATAL_FAILURE(bench.open());
}

TEST(Ros2Errors, SatelliteNavigationNeedsAPlaceOfTheWorldAndAFix) {
  Ros2Bench bench;
  bench.given["start_timeout_s"] = 2.0;
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  LiveSensor gps(bench.plugin, "ros2_gps");
  EXPECT_EQ(gps.configure({}, bench.device.base()).substr(0, 57),
            "`geo_origin` has 0 numbers; expected that of the scenario");
  bench.peer->tell("lose-fix");
  EXPECT_EQ(gps.configure({{"geo_origin", std::vector<double>{47, 8}}}, bench.device.base()),
            "no usable message on `/cart/fix` within 2 s: the receiver has no fix");
}

TEST(Ros2Errors, AMismatchIsToldWithItsRemedy) {
  Ros2Bench bench({"--forgets-static", "1"});
  bench.given["start_timeout_s"] = 2.0;
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  LiveSensor tf(bench.plugin, "ros2_tf_pose");
  // The transform to the body is a static one, which never comes; what odometry writes suffices.
  ASSERT_EQ(tf.configure({{"base_frame", "base_footprint"}}, bench.device.base()), "");
  testing::LiveSink<PoseReading> poses(ReadingKind::kPose, 1);
  ASSERT_EQ(bench.device.open(), "");
  ASSERT_EQ(tf.open(poses), "");
  poses.await_more(3);
  EXPECT_EQ(
      tf.report()["trouble"],
      "`/tf_static`: a writer gets nothing through to us: durability does not match; make the "
      "writer transient-local, or the reader volatile");
  EXPECT_NE(bench.said().find("durability does not match"), std::string::npos);
  tf.close();
}

TEST(Ros2Errors, WrongParametersAreNamed) {
  testing::LivePlugin plugin("ros2");
  testing::LiveDevice device(plugin, "ros2");
  EXPECT_EQ(device.configure({{"namespace", "cart-1"}}),
            "`/cart-1/topic` is not a valid topic name: `cart-1` must be letters, digits and "
            "underscores, no digit first, as in `/cart/scan`");
  const std::string missing = "interface: this machine has no `no_such_interface`; ";
  EXPECT_EQ(device.configure({{"interface", "no_such_interface"}}).substr(0, missing.size()),
            missing);
  EXPECT_EQ(device.open(), "opened before it was configured");
  LiveSensor laser(plugin, "ros2_laser");
  EXPECT_EQ(laser.configure({}), "has no `device`");
  LiveActuator drive(plugin, "ros2_velocity");
  EXPECT_EQ(drive.open({}), "has no `device`");
}

TEST(Ros2Errors, AnEmptyDomainIsSaidToBeEmpty) {
  testing::LivePlugin plugin("ros2");
  testing::LiveDevice device(plugin, "ros2");
  const double domain = Ros2Bench::domain();
  ASSERT_EQ(device.configure({{"domain", domain}, {"start_timeout_s", 0.2}}), "");
  LiveSensor laser(plugin, "ros2_laser");
  EXPECT_EQ(laser.configure({}, device.base()),
            "no message came on `/scan` within 0.2 s: no other participant is in domain " +
                std::to_string(Ros2Bench::domain()) +
                " at 127.0.0.1; compare ROS_DOMAIN_ID, `interface`, `multicast` and `peers`");
}

}  // namespace
}  // namespace rave::ros2_driver
