// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "rave/live_testing/robot_bench.hpp"

namespace rave::oi {

/// The device and all that is part of it.
class CreateBench : public testing::RobotBench {
 public:
  using Sink = testing::LiveSink<OdometryReading>;

  explicit CreateBench(std::vector<std::string> options = {}, bool tcp = false)
      : RobotBench("create_oi", drive) {
    options.insert(options.end(), {"--room", file("room"), "--log", log_path()});
    if (!has(options, "--pose")) options.insert(options.end(), {"--pose", "1,1.5,0"});
    options.emplace_back(tcp ? "--port" : "--link");
    options.push_back(tcp ? "0" : link());
    peer = std::make_unique<testing::PeerProcess>("peer_create", options);
    if (tcp) {
      given["address"] = "127.0.0.1:" + peer->where();
    } else {
      given["device"] = link();
    }
  }
  ~CreateBench() {
    stop_driving();
    close();
  }

  /// Configures and opens everything as a host does, and waits for the first frame.
  void start() {
    ASSERT_EQ(device.configure(given, host()), "");
    ASSERT_EQ(odometry.configure({}, device.base()), "");
    ASSERT_EQ(bumper.configure({}, device.base()), "");
    ASSERT_EQ(cliff.configure({}, device.base()), "");
    ASSERT_EQ(battery.configure({{"period_s", 0.1}}, device.base()), "");
    open();
  }
  void open() {
    ASSERT_EQ(device.open(), "");
    ASSERT_EQ(drive.open({}, device.base()), "");
    poses = std::make_unique<Sink>(ReadingKind::kOdometry, 1);
    touches = std::make_unique<testing::LiveSink<ContactReading>>(ReadingKind::kContact, 1);
    cliffs = std::make_unique<testing::LiveSink<double>>(ReadingKind::kValues, 6);
    charges = std::make_unique<testing::LiveSink<double>>(ReadingKind::kValues, 6);
    ASSERT_EQ(odometry.open(*poses), "");
    ASSERT_EQ(bumper.open(*touches), "");
    ASSERT_EQ(cliff.open(*cliffs), "");
    ASSERT_EQ(battery.open(*charges), "");
    poses->await_more(1);
  }
  /// In the order of a host.
  void close() {
    odometry.close();
    bumper.close();
    cliff.close();
    battery.close();
    drive.close();
    device.close();
  }

  template <class Wanted>
  nlohmann::json await_report(Wanted wanted) {
    return testing::await_answer([this] { return device.report(); }, wanted);
  }
  /// The last odometry tells where the peer is, from the pose (1, 1.5, 0).
  void expect_true_pose(const nlohmann::json& now, double within_m, double within_rad) {
    const OdometryReading reading = poses->samples().back().records.front();
    EXPECT_NEAR(1 + reading.x_m, now["x"].get<double>(), within_m);
    EXPECT_NEAR(1.5 + reading.y_m, now["y"].get<double>(), within_m);
    EXPECT_NEAR(std::remainder(reading.yaw_rad - now["yaw"].get<double>(), 6.283185307179586), 0,
                within_rad);
  }
  [[nodiscard]] std::string link() const { return file("robot"); }
  [[nodiscard]] std::string log_path() const { return file("log"); }

  testing::LiveDevice device{plugin, "create_oi"};
  testing::LiveSensor odometry{plugin, "create_odometry"};
  testing::LiveSensor bumper{plugin, "create_bumper"};
  testing::LiveSensor cliff{plugin, "create_cliff"};
  testing::LiveSensor battery{plugin, "create_battery"};
  testing::LiveActuator drive{plugin, "create_drive"};
  std::unique_ptr<testing::LiveSink<ContactReading>> touches;
  std::unique_ptr<testing::LiveSink<double>> cliffs;
  std::unique_ptr<testing::LiveSink<double>> charges;

 private:
  static bool has(const std::vector<std::string>& options, const std::string& name) {
    return std::find(options.begin(), options.end(), name) != options.end();
  }
};

}  // namespace rave::oi
