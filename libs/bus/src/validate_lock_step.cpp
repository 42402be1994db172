// SPDX-License-Identifier: Apache-2.0
// As validate.cpp, for the messages of lock-step.
#include <algorithm>
#include <limits>

#include "sample_checks.hpp"

namespace rave::bus {
namespace {

/// Of a unit vector, with room for rounding.
constexpr double kMaxDirection = 2;
/// Of a parameter any finite number; its range is the driver's.
constexpr double kMaxValue = std::numeric_limits<double>::max();
/// Far beyond what an engine accepts.
constexpr double kMaxScale = 1e3;

Status check_place(std::string_view list, std::size_t index, double x_m, double y_m,
                   double yaw_rad) {
  if (std::fabs(x_m) <= kMaxPosition_m && std::fabs(y_m) <= kMaxPosition_m &&
      std::fabs(yaw_rad) <= kMaxAngle_rad) {
    return {};
  }
  return invalid("{}[{}] has the impossible pose {}, {}, {}", list, index, x_m, y_m, yaw_rad);
}

template <class Sequence>
Status check_poses(const Sequence& sequence) {
  const auto poses = elements(sequence);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& pose = poses[i];
    RAVE_TRY(check_place("poses", i, pose.x_m, pose.y_m, pose.yaw_rad));
    RAVE_TRY(check_number("poses.vx_mps", pose.vx_mps, kMaxSpeed_mps));
    RAVE_TRY(check_number("poses.vy_mps", pose.vy_mps, kMaxSpeed_mps));
    RAVE_TRY(check_number("poses.wz_radps", pose.wz_radps, kMaxTurn_radps));
    // Variances may be infinite: unknown.
    if (!(pose.variance_xy_m2 >= 0 && pose.variance_yaw_rad2 >= 0)) {
      return invalid("poses[{}] has an invalid variance", i);
    }
  }
  return {};
}

template <class Sequence>
Status check_samples(const Sequence& sequence) {
  const auto samples = elements(sequence);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    RAVE_TRY(check_place("samples", i, samples[i].x_m, samples[i].y_m, samples[i].yaw_rad));
  }
  return {};
}

/// Checks what the columns and poses do not have: pushes, touches and sizes.
Status check_marks(const WorldStep& sample) {
  const auto pushed = elements(sample.pushed);
  for (std::size_t i = 0; i < pushed.size(); ++i) {
    RAVE_TRY(check_place("pushed", i, pushed[i].x_m, pushed[i].y_m, pushed[i].yaw_rad));
  }
  for (const auto& point : elements(sample.touches)) {
    RAVE_TRY(check_number("touches.x", point.x, kMaxDirection));
    RAVE_TRY(check_number("touches.y", point.y, kMaxDirection));
  }
  for (const auto& robot : elements(sample.resized)) {
    RAVE_TRY(check_number("resized.scale", robot.scale, kMaxScale));
  }
  for (const auto& robot : elements(sample.authority.scales)) {
    RAVE_TRY(check_number("authority.scales.scale", robot.scale, kMaxScale));
  }
  return {};
}

Status check_sent(const rave_wire_SentPackets& sent) {
  const auto packets = elements(sent.packets);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const auto& packet = packets[i];
    // In 64 bits: the sum must not wrap.
    if (std::uint64_t{packet.first_byte} + packet.size > sent.bytes._length) {
      return invalid("sent.packets[{}] has {} bytes from {} on, of {}", i, packet.size,
                     packet.first_byte, sent.bytes._length);
    }
    if (packet.to_kind > rave_wire_TO_TEAM) {
      return invalid("sent.packets[{}].to_kind is unknown", i);
    }
    RAVE_TRY(check_number("sent.packets.x_m", packet.x_m, kMaxPosition_m));
    RAVE_TRY(check_number("sent.packets.y_m", packet.y_m, kMaxPosition_m));
    RAVE_TRY(check_number("sent.packets.antenna_z_m", packet.antenna_z_m, kMaxPosition_m));
    RAVE_TRY(check_range("sent.packets.range_m", packet.range_m));
  }
  return {};
}

/// Checks entries that each name a robot of the world.
template <class Sequence>
Status check_named(std::string_view list, const Sequence& sequence, std::size_t robots) {
  const auto entries = elements(sequence);
  const auto wrong = std::find_if(entries.begin(), entries.end(),
                                  [&](const auto& entry) { return entry.robot >= robots; });
  if (wrong == entries.end()) return {};
  return invalid("{}[{}] is of robot {}, but there are {}", list, wrong - entries.begin(),
                 wrong->robot, robots);
}

/// Like check_named(), but an event may concern the world instead of a robot.
template <class Sequence>
Status check_events(std::string_view list, const Sequence& sequence, std::size_t robots) {
  const auto events = elements(sequence);
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].robot < robots || events[i].robot == rave_wire_kNone) continue;
    return invalid("{}[{}] is of robot {}, but there are {}", list, i, events[i].robot, robots);
  }
  return {};
}

Status check_refused(const rave_wire_AuthorityState& authority, std::size_t robots) {
  RAVE_TRY(check_events("authority.refused", authority.refused, robots));
  const std::size_t told = authority.refused._length;
  if (told <= authority.refused_count) return {};
  return invalid("authority.refused has {} entries; expected at most {}", told,
                 authority.refused_count);
}

/// Checks an order; whether the robot takes it is decided by its host.
Status check_order(const rave_wire_WorldInput& input) {
  RAVE_TRY(check_label("inputs.by", input.by, false));
  RAVE_TRY(check_label("inputs.text", input.text, false));
  for (const auto& point : elements(input.points)) {
    RAVE_TRY(check_number("inputs.points.x_m", point.x_m, kMaxPosition_m));
    RAVE_TRY(check_number("inputs.points.y_m", point.y_m, kMaxPosition_m));
  }
  RAVE_TRY(check_number("inputs.yaw_rad", input.yaw_rad, kMaxAngle_rad));
  RAVE_TRY(check_number("inputs.v_mps", input.v_mps, kMaxSpeed_mps));
  RAVE_TRY(check_number("inputs.w_radps", input.w_radps, kMaxTurn_radps));
  RAVE_TRY(check_number("inputs.vy_mps", input.vy_mps, kMaxSpeed_mps));
  RAVE_TRY(check_pedals(input.pedals));
  return check_number("inputs.speed_mps", input.speed_mps, kMaxSpeed_mps);
}

template <class Sequence>
Status check_inputs(const Sequence& inputs) {
  for (const auto& input : elements(inputs)) {
    RAVE_TRY(check_order(input));
    for (const auto& change : elements(input.changes)) {
      RAVE_TRY(check_label("inputs.changes.name", change.name, true));
      if (change.kind > rave_wire_VALUE_LIST) return invalid("inputs.changes.kind is unknown");
      RAVE_TRY(check_number("inputs.changes.number", change.number, kMaxValue));
      for (const double value : elements(change.list)) {
        RAVE_TRY(check_number("inputs.changes.list", value, kMaxValue));
      }
    }
  }
  return {};
}

}  // namespace

Status validate(const HostReport& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("host", sample.host));
  if (sample.state > rave_wire_REPORT_FAILED) return invalid("state is unknown");
  RAVE_TRY(check_ids("proposals", sample.proposals.id));
  RAVE_TRY(check_twist_columns("proposals", sample.proposals, sample.proposals.id._length));
  RAVE_TRY(check_sent(sample.sent));
  RAVE_TRY(check_poses(sample.poses));
  RAVE_TRY(check_inputs(sample.inputs));
  return check_samples(sample.samples);
}

Status validate(const WorldStep& sample) {
  RAVE_TRY(check_writer(sample));
  if (sample.epoch == 0) return invalid("epoch is 0");
  // The columns say how many robots there are; all lists must name robots among them.
  const std::size_t robots = sample.flags._length;
  RAVE_TRY(check_pose_columns("world", sample, robots));
  RAVE_TRY(check_twist_columns("world", sample, robots));
  RAVE_TRY(check_named("pushed", sample.pushed, robots));
  RAVE_TRY(check_named("touches", sample.touches, robots));
  RAVE_TRY(check_named("poses", sample.poses, robots));
  RAVE_TRY(check_named("samples", sample.samples, robots));
  RAVE_TRY(check_named("resized", sample.resized, robots));
  RAVE_TRY(check_events("authority.events", sample.authority.events, robots));
  RAVE_TRY(check_refused(sample.authority, robots));
  RAVE_TRY(check_named("authority.scales", sample.authority.scales, robots));
  RAVE_TRY(check_marks(sample));
  RAVE_TRY(check_sent(sample.sent));
  RAVE_TRY(check_poses(sample.poses));
  RAVE_TRY(check_samples(sample.samples));
  RAVE_TRY(check_obstacle_changes("obstacles", sample.obstacles));
  RAVE_TRY(check_obstacle_changes("authority.obstacles", sample.authority.obstacles));
  return check_inputs(sample.inputs);
}

Status validate(const RunState& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_label("scenario", sample.scenario, false));
  if (sample.phase > rave_wire_RUN_FAILED) return invalid("phase is unknown");
  if (!(sample.step_s > 0)) return invalid("step_s is {}", sample.step_s);
  if (!(sample.speed >= 0)) return invalid("speed is {}", sample.speed);
  for (const auto& host : elements(sample.hosts)) {
    RAVE_TRY(check_label("hosts.name", host.name, true));
    if (host.phase > rave_wire_HOST_DROPPED) return invalid("hosts.phase is unknown");
    if (!std::isfinite(host.offset_s) || !std::isfinite(host.bound_s)) {
      return invalid("hosts.offset_s is not a number");
    }
  }
  return {};
}

}  // namespace rave::bus
