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

/// A robot with two wheels on the bench: the peer, a folder for its files, and the driver of its
/// wheels. Sensors and devices are the test's. The room is 6 m by 3 m and empty; the robot stands
/// at (1, 1.5) and looks along x.
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
  /// What the driver said to its host.
  [[nodiscard]] std::string said() const {
    const std::lock_guard lock(log_mutex_);
    return log_;
  }

  /// Goes on giving a velocity, as a robot's controller does, until stop_driving().
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
  /// Waits until the peer is as wanted.
  template <class Wanted>
  nlohmann::json await_state(Wanted wanted) {
    return await_answer([this] { return state(); }, wanted);
  }
  nlohmann::json await_standstill() {
    auto now = await_state(wheels_stand);
    poses->await_more(3);  // by now one came that was made after it
    return now;
  }

  Given given;  ///< To the device.
  std::unique_ptr<PeerProcess> peer;
  LivePlugin plugin;
  std::unique_ptr<LiveSink<OdometryReading>> poses;

 protected:
  /// `drive` is the test's own, of the plug-in; it need not be there yet.
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
