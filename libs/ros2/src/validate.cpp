// SPDX-License-Identifier: Apache-2.0
// Messages come from any node, so numbers, lengths and texts are checked before a driver sees them.
#include "rave/ros2/validate.hpp"

#include <cmath>
#include <span>
#include <string_view>

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::ros2 {
namespace {

constexpr ErrorCode kBad = ErrorCode::kInvalidArgument;
/// A quaternion with a length outside of these is not a rotation.
constexpr double kLeastNorm = 0.9;
constexpr double kMostNorm = 1.1;
constexpr double kMostAngle_rad = 100;
constexpr double kMostVariance = 1e14;

Status check_number(std::string_view field, double value, double limit) {
  // NaN fails this condition.
  if (std::fabs(value) <= limit) return {};
  return fail(kBad, "{} is {}, not within +-{}", field, value, limit);
}

Status check_text(std::string_view field, const char* text, std::size_t longest) {
  const std::string_view view(text == nullptr ? "" : text);
  if (view.size() > longest) {
    return fail(kBad, "{} has {} bytes, more than {}", field, view.size(), longest);
  }
  return {};
}

/// Names appear in logs and on terminals.
Status check_frame(std::string_view field, const char* frame) {
  RAVE_TRY(check_text(field, frame, kLongestFrame));
  if (!has_control_characters(frame == nullptr ? "" : frame)) return {};
  return fail(kBad, "{} has control characters", field);
}

Status check_stamp(std::string_view field, const Time& stamp) {
  if (stamp.nanosec < 1'000'000'000U) return {};
  return fail(kBad, "{} has {} ns, a second or more", field, stamp.nanosec);
}

Status check(const Header& header) {
  RAVE_TRY(check_stamp("header.stamp", header.stamp));
  return check_frame("header.frame_id", header.frame_id);
}

/// Points and vectors.
template <class Triple>
Status check_triple(std::string_view field, const Triple& triple, double limit) {
  for (const double value : {triple.x, triple.y, triple.z}) {
    RAVE_TRY(check_number(field, value, limit));
  }
  return {};
}

Status check_rotation(std::string_view field, const Quaternion& q) {
  // Drivers round, so the length need not be 1; one of 0 is the default of a message that no node
  // filled in.
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (norm >= kLeastNorm && norm <= kMostNorm) return {};
  return fail(kBad, "{} has the length {}; a rotation has 1", field, norm);
}

/// Unknown entries are marked in many ways, so only NaN is refused.
Status check_covariance(std::string_view field, std::span<const double> covariance) {
  for (const double value : covariance) RAVE_TRY(check_number(field, value, kMostVariance));
  return {};
}

Status check(const Pose& pose) {
  RAVE_TRY(check_triple("pose.position", pose.position, kMostMetres));
  return check_rotation("pose.orientation", pose.orientation);
}

Status check(const Twist& twist) {
  RAVE_TRY(check_triple("twist.linear", twist.linear, kMostSpeed));
  return check_triple("twist.angular", twist.angular, kMostSpeed);
}

Status check_limits(double min_m, double max_m) {
  RAVE_TRY(check_number("range_min", min_m, kMostMetres));
  RAVE_TRY(check_number("range_max", max_m, kMostMetres));
  if (min_m >= 0 && min_m <= max_m) return {};
  return fail(kBad, "ranges from {} m to {} m", min_m, max_m);
}

Status check_beams(const LaserScan& scan) {
  const std::uint32_t beams = scan.ranges._length;
  if (beams == 0 || beams > kMostBeams) {
    return fail(kBad, "ranges has {} entries, not 1 to {}", beams, kMostBeams);
  }
  const std::uint32_t lit = scan.intensities._length;
  if (lit != 0 && lit != beams) {
    return fail(kBad, "intensities has {} entries for {} ranges", lit, beams);
  }
  // Drivers disagree on whether the last ray is at angle_max, and angles have single precision.
  const double expected =
      std::fabs((double{scan.angle_max} - scan.angle_min) / scan.angle_increment) + 1;
  const double off = std::fabs(expected - beams);
  if (beams > 1 && off > 2 && off > 0.01 * beams) {
    return fail(kBad, "ranges has {} entries where its angles make {:.0f}", beams, expected);
  }
  return {};
}

/// A range may be infinite, but not NaN.
template <class Sonar>
Status check_sonar(const Sonar& message) {
  RAVE_TRY(check(message.header));
  RAVE_TRY(check_number("field_of_view", message.field_of_view, kMostAngle_rad));
  RAVE_TRY(check_limits(message.min_range, message.max_range));
  if (std::isnan(message.range)) return fail(kBad, "range is nan");
  if (message.field_of_view < 0) return fail(kBad, "field_of_view is {}", message.field_of_view);
  return {};
}

}  // namespace

Status validate(const String& message) { return check_text("data", message.data, kLongestText); }

Status validate(const PoseStamped& message) {
  RAVE_TRY(check(message.header));
  return check(message.pose);
}

Status validate(const Twist& message) { return check(message); }

Status validate(const TwistStamped& message) {
  RAVE_TRY(check(message.header));
  return check(message.twist);
}

Status validate(const LaserScan& message) {
  RAVE_TRY(check(message.header));
  RAVE_TRY(check_number("angle_min", message.angle_min, kMostAngle_rad));
  RAVE_TRY(check_number("angle_max", message.angle_max, kMostAngle_rad));
  RAVE_TRY(check_number("angle_increment", message.angle_increment, kMostAngle_rad));
  if (message.angle_increment == 0 && message.ranges._length > 1) {
    return fail(kBad, "angle_increment is 0");
  }
  RAVE_TRY(check_limits(message.range_min, message.range_max));
  return check_beams(message);
}

Status validate(const Range& message) { return check_sonar(message); }
Status validate(const RangeReading& message) { return check_sonar(message); }

Status validate(const Imu& message) {
  RAVE_TRY(check(message.header));
  RAVE_TRY(check_covariance("orientation_covariance", message.orientation_covariance));
  RAVE_TRY(check_covariance("angular_velocity_covariance", message.angular_velocity_covariance));
  RAVE_TRY(
      check_covariance("linear_acceleration_covariance", message.linear_acceleration_covariance));
  // An unmeasured quantity is marked and may contain anything.
  if (message.orientation_covariance[0] != -1) {
    RAVE_TRY(check_rotation("orientation", message.orientation));
  }
  if (message.angular_velocity_covariance[0] != -1) {
    RAVE_TRY(check_triple("angular_velocity", message.angular_velocity, kMostSpeed));
  }
  if (message.linear_acceleration_covariance[0] == -1) return {};
  return check_triple("linear_acceleration", message.linear_acceleration, kMostSpeed);
}

Status validate(const NavSatFix& message) {
  RAVE_TRY(check(message.header));
  if (message.status.status < 0) return {};  // no fix, so the other fields are meaningless
  RAVE_TRY(check_number("latitude", message.latitude, 90));
  RAVE_TRY(check_number("longitude", message.longitude, 180));
  if (!std::isnan(message.altitude)) {
    RAVE_TRY(check_number("altitude", message.altitude, kMostMetres));
  }
  return check_covariance("position_covariance", message.position_covariance);
}

Status validate(const BatteryState& message) {
  RAVE_TRY(check(message.header));
  RAVE_TRY(check_text("location", message.location, kLongestFrame));
  RAVE_TRY(check_text("serial_number", message.serial_number, kLongestFrame));
  for (const std::uint32_t cells :
       {message.cell_voltage._length, message.cell_temperature._length}) {
    if (cells > kMostCells) return fail(kBad, "{} cells, more than {}", cells, kMostCells);
  }
  // NaN means not measured.
  for (const float value : {message.voltage, message.temperature, message.current, message.charge,
                            message.capacity, message.percentage}) {
    if (std::isinf(value)) return fail(kBad, "an infinite value of a battery");
  }
  return {};
}

Status validate(const Odometry& message) {
  RAVE_TRY(check(message.header));
  RAVE_TRY(check_frame("child_frame_id", message.child_frame_id));
  RAVE_TRY(check(message.pose.pose));
  RAVE_TRY(check_covariance("pose.covariance", message.pose.covariance));
  RAVE_TRY(check(message.twist.twist));
  return check_covariance("twist.covariance", message.twist.covariance);
}

Status validate(const TfMessage& message) {
  if (message.transforms._length > kMostTransforms) {
    return fail(kBad, "{} transforms, more than {}", message.transforms._length, kMostTransforms);
  }
  for (const TransformStamped& each : bus::elements(message.transforms)) {
    RAVE_TRY(check(each.header));
    RAVE_TRY(check_frame("child_frame_id", each.child_frame_id));
    RAVE_TRY(check_triple("transform.translation", each.transform.translation, kMostMetres));
    RAVE_TRY(check_rotation("transform.rotation", each.transform.rotation));
  }
  return {};
}

Status validate(const Clock& message) { return check_stamp("clock", message.clock); }

}  // namespace rave::ros2
