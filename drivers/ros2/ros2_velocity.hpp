// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include "rave/robot/actuator.hpp"
#include "rave/ros2/writer.hpp"
#include "ros2/ros2_device.hpp"

namespace rave::ros2_driver {

/// Drives a robot by velocity: Twist or TwistStamped, whichever it reads. The host calls open(),
/// write() and close(), one after the other; the device's thread calls attend(). They share the
/// order.
class Ros2Velocity final : public HardwareActuator, public TopicUser {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Ros2Velocity() = default;
  Ros2Velocity(const Ros2Velocity&) = delete;
  Ros2Velocity& operator=(const Ros2Velocity&) = delete;
  ~Ros2Velocity() override;

  Status open(const DeviceSetup& setup) override;
  Status write(const Command& command, SimTime now) override;
  void close() override;
  line::HostTime attend(line::HostTime now) override;

 private:
  using Plain = ros2::Writer<ros2::Twist>;
  using Stamped = ros2::Writer<ros2::TwistStamped>;

  /// The commanded velocity and its expiry.
  struct Order {
    double v_mps = 0;
    double w_radps = 0;
    line::HostTime until{};
    bool given = false;
    bool fresh = false;  ///< Not sent yet.
  };

  /// Finds which of the messages others read on the topic; waits for a reader. Error kTimeout.
  [[nodiscard]] Result<bool> find_stamped(const std::string& topic, std::string_view wanted) const;
  [[nodiscard]] Status make_writer(const std::string& topic, bool stamped);
  void send(double v_mps, double w_radps);
  /// For those who drive: why a command may not be sent; empty: it may.
  [[nodiscard]] std::string objection();
  /// Null before open().
  [[nodiscard]] const ros2::End* end() const;
  /// Logs readers with incompatible QoS, and the reason.
  void look_after();

  Ros2Device* device_ = nullptr;
  std::string topic_;
  double watchdog_s_ = 0;
  double refresh_s_ = 0;
  double max_v_mps_ = 0;
  double max_w_radps_ = 0;
  std::size_t most_readers_ = 1;
  bool attached_ = false;

  std::mutex mutex_;  // guards what follows
  std::variant<std::monostate, Plain, Stamped> writer_;
  std::vector<dds_instance_handle_t> readers_;  // those that `crowd_` is about
  std::string crowd_;
  Order order_;
  line::HostTime due_{};       // time of the next repetition
  line::HostTime quiet_at_{};  // until then stop commands are sent without an order
};

}  // namespace rave::ros2_driver
