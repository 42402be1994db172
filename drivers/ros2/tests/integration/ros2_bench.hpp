// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rave/live_testing/robot_bench.hpp"

namespace rave::ros2_driver {

/// A robot of ROS 2, in a domain of this test alone, and the device with its sensors.
class Ros2Bench : public testing::RobotBench {
 public:
  template <class Record>
  using Sink = testing::LiveSink<Record>;

  explicit Ros2Bench(std::vector<std::string> options = {}) : RobotBench("ros2", drive) {
    options.insert(options.end(), {"--room", file("room"), "--pose", "1,1.5,0", "--domain",
                                   std::to_string(domain())});
    peer = std::make_unique<testing::PeerProcess>("peer_ros2", options);
    given = {{"namespace", "/cart"},
             {"domain", static_cast<double>(domain())},
             {"start_timeout_s", 60.0}};
  }
  ~Ros2Bench() {
    stop_driving();
    close();
  }

  /// Tests of several processes at once must not meet; there is no tag in ROS 2.
  static std::uint32_t domain() { return 1 + static_cast<std::uint32_t>(::getpid()) % 90; }

  /// Configures and opens odometry, laser and wheels as a host does, and waits for the first of
  /// both.
  void start() {
    ASSERT_EQ(device.configure(given, host()), "");
    ASSERT_EQ(odometry.configure({}, device.base()), "");
    ASSERT_EQ(laser.configure({}, device.base()), "");
    open();
  }
  [[nodiscard]] std::string room() const { return file("room"); }
  void open() {
    ASSERT_EQ(device.open(), "");
    ASSERT_EQ(drive.open(driving, device.base()), "");
    poses = std::make_unique<Sink<OdometryReading>>(ReadingKind::kOdometry, 1);
    scans = std::make_unique<Sink<float>>(ReadingKind::kRanges, laser.declaration().capacity);
    ASSERT_EQ(odometry.open(*poses), "");
    ASSERT_EQ(laser.open(*scans), "");
    poses->await_more(1);
    scans->await_more(1);
  }
  /// In the order of a host.
  void close() {
    odometry.close();
    laser.close();
    drive.close();
    device.close();
  }

  testing::Given driving;
  testing::LiveDevice device{plugin, "ros2"};
  testing::LiveSensor odometry{plugin, "ros2_odometry"};
  testing::LiveSensor laser{plugin, "ros2_laser"};
  testing::LiveActuator drive{plugin, "ros2_velocity"};
  std::unique_ptr<Sink<float>> scans;
};

}  // namespace rave::ros2_driver
