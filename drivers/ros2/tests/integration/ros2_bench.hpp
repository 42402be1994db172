// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "rave/live_testing/live_plugin.hpp"
#include "rave/live_testing/live_sink.hpp"
#include "rave/live_testing/peer_process.hpp"

namespace rave::ros2_driver {

/// A robot of ROS 2 on the bench: the peer, in a domain of this test alone, and the device with its
/// sensors. The room is 6 m by 3 m and empty; the robot stands at (1, 1.5) and looks along x.
class Ros2Bench {
 public:
  template <class Record>
  using Sink = testing::LiveSink<Record>;

  explicit Ros2Bench(std::vector<std::string> options = {})
      : folder_(std::filesystem::temp_directory_path() /
                ("ros2_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "room") << "3 1.5 0 6 3\n";
    options.insert(options.end(), {"--room", (folder_ / "room").string(), "--pose", "1,1.5,0",
                                   "--domain", std::to_string(domain())});
    peer = std::make_unique<testing::PeerProcess>("peer_ros2", options);
    given = {{"namespace", "/cart"},
             {"domain", static_cast<double>(domain())},
             {"start_timeout_s", 60.0}};
  }
  Ros2Bench(const Ros2Bench&) = delete;
  Ros2Bench& operator=(const Ros2Bench&) = delete;
  ~Ros2Bench() {
    stop_driving();
    close();
    peer.reset();
    std::filesystem::remove_all(folder_);
  }

  /// Tests of several processes at once must not meet; there is no tag in ROS 2.
  static std::uint32_t domain() { return 1 + static_cast<std::uint32_t>(::getpid()) % 90; }

  HostServices host() {
    HostServices services;
    services.context = this;
    services.log = [](void* context, LogLevel, const char* text, std::uint64_t size) {
      auto& bench = *static_cast<Ros2Bench*>(context);
      const std::lock_guard lock(bench.log_mutex_);
      bench.log_ += std::string(text, size) + "\n";
    };
    return services;
  }

  /// Configures and opens odometry, laser and wheels as a host does, and waits for the first of
  /// both.
  void start() {
    ASSERT_EQ(device.configure(given, host()), "");
    ASSERT_EQ(odometry.configure({}, device.base()), "");
    ASSERT_EQ(laser.configure({}, device.base()), "");
    open();
  }
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

  /// Goes on giving a velocity, as a robot's controller does, until stop_driving().
  void keep_driving(double v_mps, double w_radps) {
    stop_driving();
    driver_ = std::jthread(
        [this, command = velocity_command(v_mps, w_radps)](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            (void)drive.write(command);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
          }
        });
  }
  void stop_driving() {
    if (!driver_.joinable()) return;
    driver_.request_stop();
    driver_.join();
    (void)drive.write(velocity_command(0, 0));
  }

  [[nodiscard]] nlohmann::json state() { return nlohmann::json::parse(peer->ask("state")); }
  /// Waits until the peer is as wanted.
  template <class Wanted>
  nlohmann::json await_state(Wanted wanted) {
    const auto end = std::chrono::steady_clock::now() + testing::kLong;
    nlohmann::json now = state();
    while (!wanted(now) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      now = state();
    }
    EXPECT_TRUE(wanted(now)) << now.dump();
    return now;
  }
  nlohmann::json await_standstill() {
    auto now = await_state(
        [](const nlohmann::json& s) { return s["left_mps"] == 0.0 && s["right_mps"] == 0.0; });
    poses->await_more(3);  // by now one came that was made after it
    return now;
  }
  [[nodiscard]] std::string said() const {
    const std::lock_guard lock(log_mutex_);
    return log_;
  }

  testing::Given given;
  testing::Given driving;
  std::unique_ptr<testing::PeerProcess> peer;
  testing::LivePlugin plugin{"ros2"};
  testing::LiveDevice device{plugin, "ros2"};
  testing::LiveSensor odometry{plugin, "ros2_odometry"};
  testing::LiveSensor laser{plugin, "ros2_laser"};
  testing::LiveActuator drive{plugin, "ros2_velocity"};
  std::unique_ptr<Sink<OdometryReading>> poses;
  std::unique_ptr<Sink<float>> scans;

 private:
  std::filesystem::path folder_;
  mutable std::mutex log_mutex_;  // guards log_
  std::string log_;
  std::jthread driver_;
};

}  // namespace rave::ros2_driver
