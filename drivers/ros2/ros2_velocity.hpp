// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <variant>

#include "rave/robot/actuator.hpp"
#include "rave/ros2/writer.hpp"
#include "ros2/ros2_device.hpp"

namespace rave::ros2_driver {

/// Drives a robot by velocity: Twist or TwistStamped, whichever it reads. open(), write() and
/// close() belong to the host, one after the other; attend() to the device's thread. They share the
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

  /// What the robot is to do, until when.
  struct Order {
    double v_mps = 0;
    double w_radps = 0;
    line::HostTime until{};
    bool given = false;
    bool fresh = false;  ///< Has not been sent yet.
  };

  /// Which message others read at the topic; waits for somebody. Error kTimeout: nobody does.
  [[nodiscard]] Result<bool> find_stamped(const std::string& topic, std::string_view wanted) const;
  [[nodiscard]] Status make_writer(const std::string& topic, bool stamped);
  void send(double v_mps, double w_radps);
  [[nodiscard]] std::size_t readers() const;
  /// Says who at the topic gets nothing, and why.
  void look_after();

  Ros2Device* device_ = nullptr;
  std::string topic_;
  double watchdog_s_ = 0;
  double refresh_s_ = 0;
  double max_v_mps_ = 0;
  double max_w_radps_ = 0;
  bool attached_ = false;

  std::mutex mutex_;  // guards what follows
  std::variant<std::monostate, Plain, Stamped> writer_;
  Order order_;
  line::HostTime due_{};       // when the order is sent again
  line::HostTime quiet_at_{};  // until then a robot without an order is told to stand
};

}  // namespace rave::ros2_driver
