// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_commands.hpp"

#include "rave/ros2/convert.hpp"
#include "ros2/readings.hpp"

namespace rave::ros2_driver {

Status Ros2Command::prepare(const Params& params, HardwareDeclaration& /*declaration*/) {
  allow_silence();
  const std::string_view topic = params.text("topic");
  return params.text("message") == "twist_stamped" ? make_reader(topic, beside_)
                                                   : make_reader(topic, main_);
}

// Only vx and wz: a robot on wheels has no other velocity, and other parts are usually left at 0.
void Ros2Command::take(const ros2::Twist& twist) {
  const VelocityReading reading{twist.linear.x, twist.angular.z};
  // A command counts from its arrival, because the sender's clock is unknown.
  publish(0, &reading, 1);
}

void Ros2Command::drain() {
  if (main_) main_->take([this](const ros2::Twist& message) { take(message); });
  if (beside_) beside_->take([this](const ros2::TwistStamped& message) { take(message.twist); });
}

Status Ros2Goal::prepare(const Params& params, HardwareDeclaration& /*declaration*/) {
  allow_silence();
  return make_reader(params);
}

Status Ros2Goal::take(const ros2::PoseStamped& message) {
  RAVE_TRY_ASSIGN(const PoseReading reading, pose_of(message, {}));
  publish(0, &reading, 1);
  return {};
}

}  // namespace rave::ros2_driver
