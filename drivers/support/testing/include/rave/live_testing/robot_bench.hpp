// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "rave/live_testing/live_plugin.hpp"
#include "rave/live_testing/live_sink.hpp"
#include "rave/live_testing/scratch.hpp"

namespace rave::testing {

/// A robot with two wheels for tests: the peer, a folder for its files, and the driver of its
/// wheels. The test adds sensors and devices. The room is 6 m by 3 m and empty; the robot stands at
/// (1, 1.5) and faces along x.
class RobotBench {
 public:
  RobotBench(const RobotBench&) = delete;
  RobotBench& operator=(const RobotBench&) = delete;

  HostServices host() {
    HostServices services;
    services.context = this;
    services.log = [](void* context, LogLevel, const char* text, std::uint64_t size) {
      auto& bench = *static_cast<RobotBench*>(context);
      const std::lock_guard lock(bench.log_mutex_);
      bench.log_ += std::string(text, size) + "\n";
    };
    return services;
  }
  /// The log lines of the driver.
  [[nodiscard]] std::string said() const {
    const std::lock_guard lock(log_mutex_);
    return log_;
  }

  /// Repeats a velocity command like a controller, until stop_driving().
  void keep_driving(double v_mps, double w_radps) {
    stop_driving();
    driver_ = std::jthread(
        [this, command = velocity_command(v_mps, w_radps)](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            (void)drive_.write(command);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
          }
        });
  }
  void stop_driving() {
    if (!driver_.joinable()) return;
    driver_.request_stop();
    driver_.join();
    (void)drive_.write(velocity_command(0, 0));
  }

  [[nodiscard]] nlohmann::json state() { return state_of(*peer); }
  /// Waits until the state of the peer satisfies `wanted`.
  template <class Wanted>
  nlohmann::json await_state(Wanted wanted) {
    return await_answer([this] { return state(); }, wanted);
  }
  nlohmann::json await_standstill() {
    auto now = await_state(wheels_stand);
    poses->await_more(3);  // by now a sample that was taken afterwards has arrived
    return now;
  }

  Given given;  ///< Parameters of the device.
  std::unique_ptr<PeerProcess> peer;
  LivePlugin plugin;
  std::unique_ptr<LiveSink<OdometryReading>> poses;

 protected:
  /// `drive` is owned by the test and made from the plug-in; it may be constructed later.
  RobotBench(const std::string& plugin_name, LiveActuator& drive)
      : plugin(plugin_name), drive_(drive), scratch_(plugin_name) {
    scratch_.write("room", "3 1.5 0 6 3\n");
  }
  ~RobotBench() { peer.reset(); }
  [[nodiscard]] std::string file(const std::string& name) const { return scratch_.file(name); }

 private:
  LiveActuator& drive_;
  Scratch scratch_;
  mutable std::mutex log_mutex_;  // guards log_
  std::string log_;
  std::jthread driver_;
};

}  // namespace rave::testing
