// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
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

namespace rave::oi {

/// A robot on the bench: the peer, a folder for its files, the device and all that is part of it.
/// The room is 6 m by 3 m and empty; the robot stands at (1, 1.5) and looks along x.
class CreateBench {
 public:
  using Sink = testing::LiveSink<OdometryReading>;

  explicit CreateBench(std::vector<std::string> options = {}, bool tcp = false)
      : folder_(std::filesystem::temp_directory_path() /
                ("create_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "room") << "3 1.5 0 6 3\n";
    options.insert(options.end(), {"--room", (folder_ / "room").string(), "--log", log_path()});
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
  CreateBench(const CreateBench&) = delete;
  CreateBench& operator=(const CreateBench&) = delete;
  ~CreateBench() {
    stop_driving();
    close();
    peer.reset();
    std::filesystem::remove_all(folder_);
  }

  /// Configures and opens everything as a host does, and waits for the first frame.
  void start() {
    HostServices host;
    host.context = this;
    host.log = [](void* context, LogLevel, const char* text, std::uint64_t size) {
      auto& bench = *static_cast<CreateBench*>(context);
      const std::lock_guard lock(bench.log_mutex_);
      bench.log_ += std::string(text, size) + "\n";
    };
    ASSERT_EQ(device.configure(given, host), "");
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
  template <class Wanted>
  nlohmann::json await_report(Wanted wanted) {
    const auto end = std::chrono::steady_clock::now() + testing::kLong;
    nlohmann::json now = device.report();
    while (!wanted(now) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      now = device.report();
    }
    EXPECT_TRUE(wanted(now)) << now.dump();
    return now;
  }
  /// The last odometry tells where the peer is, from the pose (1, 1.5, 0).
  void expect_true_pose(const nlohmann::json& now, double within_m, double within_rad) {
    const OdometryReading reading = poses->samples().back().records.front();
    EXPECT_NEAR(1 + reading.x_m, now["x"].get<double>(), within_m);
    EXPECT_NEAR(1.5 + reading.y_m, now["y"].get<double>(), within_m);
    EXPECT_NEAR(std::remainder(reading.yaw_rad - now["yaw"].get<double>(), 6.283185307179586), 0,
                within_rad);
  }
  [[nodiscard]] std::string said() const {
    const std::lock_guard lock(log_mutex_);
    return log_;
  }

  [[nodiscard]] std::string link() const { return (folder_ / "robot").string(); }
  [[nodiscard]] std::string log_path() const { return (folder_ / "log").string(); }

  testing::Given given;
  std::unique_ptr<testing::PeerProcess> peer;
  testing::LivePlugin plugin{"create_oi"};
  testing::LiveDevice device{plugin, "create_oi"};
  testing::LiveSensor odometry{plugin, "create_odometry"};
  testing::LiveSensor bumper{plugin, "create_bumper"};
  testing::LiveSensor cliff{plugin, "create_cliff"};
  testing::LiveSensor battery{plugin, "create_battery"};
  testing::LiveActuator drive{plugin, "create_drive"};
  std::unique_ptr<Sink> poses;
  std::unique_ptr<testing::LiveSink<ContactReading>> touches;
  std::unique_ptr<testing::LiveSink<double>> cliffs;
  std::unique_ptr<testing::LiveSink<double>> charges;

 private:
  static bool has(const std::vector<std::string>& options, const std::string& name) {
    return std::find(options.begin(), options.end(), name) != options.end();
  }

  std::filesystem::path folder_;
  mutable std::mutex log_mutex_;  // guards log_
  std::string log_;
  std::jthread driver_;
};

}  // namespace rave::oi
