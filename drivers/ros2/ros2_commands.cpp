// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_commands.hpp"

#include "rave/ros2/convert.hpp"
#include "ros2/readings.hpp"

namespace rave::ros2_driver {

Status Ros2Command::prepare(const Params& params, HardwareDeclaration& /*declaration*/) {
  allow_silence();
  const std::string_view topic = params.text("topic");
  return params.text("message") == "twist_stamped" ? make_reader(topic, stamped_)
                                                   : make_reader(topic, plain_);
}

// Only vx and wz: a robot on wheels has no other velocity, and other parts are usually left at 0.
void Ros2Command::take(const ros2::Twist& twist, std::int64_t stamp_ns) {
  const VelocityReading reading{twist.linear.x, twist.angular.z};
  publish(stamp_ns, &reading, 1);
}

void Ros2Command::drain() {
  if (plain_) plain_->take([this](const ros2::Twist& message) { take(message, 0); });
  // A command counts from its arrival, because the sender's clock is unknown.
  if (stamped_) stamped_->take([this](const ros2::TwistStamped& m) { take(m.twist, 0); });
}

void Ros2Command::look_after(TopicState& state) {
  if (plain_) look_at(*plain_, state);
  if (stamped_) look_at(*stamped_, state);
}

std::string Ros2Command::explain_silence() const {
  return plain_ ? plain_->explain_silence() : stamped_->explain_silence();
}

std::vector<dds_entity_t> Ros2Command::readers() const {
  return {plain_ ? plain_->handle() : stamped_->handle()};
}

const std::string& Ros2Command::topic() const {
  return plain_ ? plain_->topic() : stamped_->topic();
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
