// SPDX-License-Identifier: Apache-2.0
#include "ros2/ros2_velocity.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "rave/ros2/convert.hpp"
#include "rave/ros2/names.hpp"

namespace rave::ros2_driver {
namespace {

/// How long stop commands are sent; afterwards other nodes may drive the robot.
constexpr double kTellToStand_s = 1;
/// How long to wait until the last command has arrived.
constexpr Duration kLastWord{200'000'000};
constexpr const char* kTwist = "geometry_msgs/msg/Twist";
constexpr const char* kTwistStamped = "geometry_msgs/msg/TwistStamped";

double held(double value, double limit) {
  return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0;
}

ros2::Twist twist(double v_mps, double w_radps) { return {{v_mps, 0, 0}, {0, 0, w_radps}}; }

std::int64_t wall_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

Ros2Velocity::~Ros2Velocity() { close(); }

Status Ros2Velocity::open(const DeviceSetup& setup) {
  device_ = static_cast<Ros2Device*>(setup.device);
  if (device_ == nullptr) return fail(ErrorCode::kState, "has no `device`");
  const Params params = setup.parameters();
  watchdog_s_ = params.number("watchdog_s");
  refresh_s_ = params.number("refresh_s");
  max_v_mps_ = params.number("max_v_mps");
  max_w_radps_ = params.number("max_w_radps");
  most_readers_ = static_cast<std::size_t>(params.integer("most_readers"));
  RAVE_TRY_ASSIGN(topic_, device_->topic(params.text("topic")));
  // Twist and TwistStamped are both in use on cmd_vel, and a writer of the wrong type is never
  // heard. So the type is that of the robot's reader.
  RAVE_TRY_ASSIGN(const bool stamped, find_stamped(topic_, params.text("message")));
  RAVE_TRY(make_writer(topic_, stamped));
  device_->attach(*this);
  attached_ = true;
  return {};
}

Result<bool> Ros2Velocity::find_stamped(const std::string& topic, std::string_view wanted) const {
  const ros2::Participant& participant = device_->participant();
  RAVE_TRY_ASSIGN(const ros2::Waiter waiter, ros2::Waiter::create(participant));
  RAVE_TRY(waiter.watch(participant.news(false)));
  const double limit_s = device_->options().timing.start_timeout_s;
  const line::HostTime end = line::after_seconds(line::host_now(), limit_s);
  while (true) {
    for (const ros2::RemoteEnd& reader : participant.others(false)) {
      if (reader.topic != topic) continue;
      if (reader.type == kTwist && wanted != "twist_stamped") return false;
      if (reader.type == kTwistStamped && wanted != "twist") return true;
    }
    const line::Wait left = line::until(end);
    if (left == line::Wait::zero()) break;
    waiter.wait(Duration{left.count() * 1'000'000});
  }
  const char* const type = wanted == "twist_stamped" ? kTwistStamped : kTwist;
  return fail(ErrorCode::kTimeout, "no robot to drive was found within {} s: {}", limit_s,
              participant.explain_silence(topic, type, false));
}

Status Ros2Velocity::make_writer(const std::string& topic, bool stamped) {
  const std::lock_guard lock(mutex_);
  const ros2::Participant& participant = device_->participant();
  if (stamped) {
    RAVE_TRY_ASSIGN(auto writer, Stamped::create(participant, topic));
    writer_ = std::move(writer);
  } else {
    RAVE_TRY_ASSIGN(auto writer, Plain::create(participant, topic));
    writer_ = std::move(writer);
  }
  order_ = {};
  due_ = {};
  quiet_at_ = {};
  return {};
}

Status Ros2Velocity::write(const Command& command, SimTime /*now*/) {
  if (command.kind != CommandKind::kVelocity) {
    return fail(ErrorCode::kInvalidArgument, "expected velocities, found {}",
                to_string(command.kind));
  }
  // A command without values means stop.
  double v_mps = command.count >= 1 ? held(command.value[0], max_v_mps_) : 0;
  double w_radps = command.count >= 2 ? held(command.value[1], max_w_radps_) : 0;
  bool changed = false;
  std::string why_not;
  {
    const std::lock_guard lock(mutex_);
    why_not = objection();
    // All robots that receive it must stand.
    if (!why_not.empty()) v_mps = w_radps = 0;
    // A changed command is sent at once; an unchanged one only extends its validity, and the thread
    // repeats it at its own rate.
    changed = !order_.given || v_mps != order_.v_mps || w_radps != order_.w_radps;
    order_ = {v_mps, w_radps, line::after_seconds(line::host_now(), watchdog_s_), true,
              order_.fresh || changed};
  }
  if (changed) device_->ring();
  if (!why_not.empty()) return fail(ErrorCode::kIo, "{}", why_not);
  return {};
}

std::string Ros2Velocity::objection() {
  const ros2::End* const end = this->end();
  auto readers = end != nullptr ? end->matched() : std::vector<dds_instance_handle_t>();
  if (readers.empty()) {
    return fmt::format("`{}` has no reader any more; the robot cannot be commanded", topic_);
  }
  if (readers.size() > most_readers_) {
    if (readers != readers_) {
      crowd_ = fmt::format("`{}` has {} readers", topic_, readers.size());
      for (const dds_instance_handle_t reader : readers) {
        crowd_ += ", " + text_of(end->identify(reader).value_or(ros2::RemoteId{}));
      }
      crowd_ +=
          "; each may be a robot: give robots a `namespace` each, or allow recorders and "
          "monitors by `most_readers`";
      readers_ = std::move(readers);
    }
    return crowd_;
  }
  if (device_->away()) {
    return fmt::format("the robot behind `{}` is silent; it may not receive commands either",
                       topic_);
  }
  return {};
}

line::HostTime Ros2Velocity::attend(line::HostTime now) {
  const std::lock_guard lock(mutex_);
  look_after();
  if (order_.given && now < order_.until) {
    if (!order_.fresh && now < due_) return std::min(due_, order_.until);
    send(order_.v_mps, order_.w_radps);
    order_.fresh = false;
    due_ = line::after_seconds(now, refresh_s_);
    return std::min(due_, order_.until);
  }
  if (order_.given) {
    if (order_.v_mps != 0 || order_.w_radps != 0) {
      device_->log(
          LogLevel::kWarning,
          fmt::format("`{}`: no command for {} s; the robot is stopped", topic_, watchdog_s_));
    }
    order_ = {};
    due_ = now;
    // Stops are repeated for a while, because a single one may be lost, and end then, because
    // another node may want to drive.
    quiet_at_ = line::after_seconds(now, kTellToStand_s);
  }
  if (now >= quiet_at_) return line::HostTime::max();
  if (now >= due_) {
    send(0, 0);
    due_ = line::after_seconds(now, refresh_s_);
  }
  return due_;
}

void Ros2Velocity::send(double v_mps, double w_radps) {
  // objection() reveals a failure, or the robot's own watchdog stops it.
  if (auto* const plain = std::get_if<Plain>(&writer_)) {
    (void)plain->write(twist(v_mps, w_radps));
  } else if (auto* const stamped = std::get_if<Stamped>(&writer_)) {
    ros2::TwistStamped message{};
    message.header.stamp = ros2::time_of(wall_now_ns());
    message.twist = twist(v_mps, w_radps);
    (void)stamped->write(message);
  }
}

void Ros2Velocity::look_after() {
  std::optional<std::string> mismatch;
  if (auto* const plain = std::get_if<Plain>(&writer_)) mismatch = plain->take_mismatch();
  if (auto* const stamped = std::get_if<Stamped>(&writer_)) mismatch = stamped->take_mismatch();
  if (mismatch) device_->log(LogLevel::kWarning, fmt::format("`{}`: {}", topic_, *mismatch));
}

const ros2::End* Ros2Velocity::end() const {
  if (const auto* const plain = std::get_if<Plain>(&writer_)) return &plain->end();
  if (const auto* const stamped = std::get_if<Stamped>(&writer_)) return &stamped->end();
  return nullptr;
}

void Ros2Velocity::close() {
  if (!attached_) return;
  device_->detach(*this);
  attached_ = false;
  const std::lock_guard lock(mutex_);
  send(0, 0);
  if (const auto* const plain = std::get_if<Plain>(&writer_)) {
    (void)plain->wait_until_there(kLastWord);
  } else if (const auto* const stamped = std::get_if<Stamped>(&writer_)) {
    (void)stamped->wait_until_there(kLastWord);
  }
  writer_ = std::monostate{};
}

}  // namespace rave::ros2_driver
