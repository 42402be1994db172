// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2_bridge/ros2_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/bus/sequence.hpp"
#include "rave/math/even_angles.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/ros2/names.hpp"

namespace rave::runtime {
namespace {

/// The values of the drivers of batteries and inertial sensors; their order is in
/// drivers/*/README.md.
/// RAVE carries batteries and inertial sensors as plain values, so their kind is known by the
/// driver's name and the number of values.
constexpr std::uint32_t kBatteryValues = 6;
constexpr std::uint32_t kImuValues = 10;
/// Places of x, y and the heading in a covariance of six by six.
constexpr std::size_t kXX = 0;
constexpr std::size_t kYY = 7;
constexpr std::size_t kYawYaw = 35;
// Of sensor_msgs/NavSatStatus and NavSatFix.
constexpr std::int8_t kNoFix = -1;
constexpr std::uint16_t kServiceGps = 1;
constexpr std::uint8_t kApproximated = 1;
/// Places of east, north and up in a covariance of three by three.
constexpr std::array<std::size_t, 3> kEastNorthUp{0, 4, 8};

template <class Record>
std::span<const Record> records_of(const sim::SensorSample& sample) {
  return {static_cast<const Record*>(sample.records), sample.header->count};
}

void append_shape(const world::Shape& shape, std::string& urdf) {
  const double height_m = shape.z1_m - shape.z0_m;
  Vec2 middle = shape.centre;
  std::string geometry =
      fmt::format("<cylinder radius=\"{}\" length=\"{}\"/>", shape.radius_m, height_m);
  if (shape.polygon) {
    // URDF has no prisms, so use the bounding box.
    Vec2 low = shape.vertices().front();
    Vec2 high = low;
    for (const Vec2& vertex : shape.vertices()) {
      low = {std::min(low.x, vertex.x), std::min(low.y, vertex.y)};
      high = {std::max(high.x, vertex.x), std::max(high.y, vertex.y)};
    }
    middle = 0.5 * (low + high);
    geometry = fmt::format("<box size=\"{} {} {}\"/>", high.x - low.x, high.y - low.y, height_m);
  }
  // The same geometry for both: RAVE has no separate shape for display.
  for (const char* const use : {"visual", "collision"}) {
    urdf += fmt::format("    <{0}><origin xyz=\"{1} {2} {3}\"/><geometry>{4}</geometry></{0}>\n",
                        use, middle.x, middle.y, (shape.z0_m + shape.z1_m) / 2, geometry);
  }
}

}  // namespace

Ros2Kind ros2_kind(const SensorInfo& info, std::string_view driver) noexcept {
  switch (info.kind) {
    case ReadingKind::kRanges:
      if (info.capacity == 1 && info.cone_rad > 0) return Ros2Kind::kRange;
      // LaserScan has a first angle and an increment, so it can only express evenly spread rays.
      return info.bearings_rad != nullptr && evenly_spread({info.bearings_rad, info.capacity})
                 ? Ros2Kind::kScan
                 : Ros2Kind::kNone;
    case ReadingKind::kOdometry:
      return Ros2Kind::kOdometry;
    case ReadingKind::kValues:
      if (driver.ends_with("_imu") && info.capacity == kImuValues) return Ros2Kind::kImu;
      if (driver.ends_with("_battery") && info.capacity == kBatteryValues) {
        return Ros2Kind::kBattery;
      }
      return Ros2Kind::kNone;
    case ReadingKind::kPose:
      // A goal is not the position of the robot, so it has no fix.
      return driver == "ros2_goal" ? Ros2Kind::kNone : Ros2Kind::kFix;
    default:
      return Ros2Kind::kNone;
  }
}

std::string_view ros2_topic(Ros2Kind kind) noexcept {
  switch (kind) {
    case Ros2Kind::kScan:
      return "scan";
    case Ros2Kind::kRange:
      return "range";
    case Ros2Kind::kOdometry:
      return "odom";
    case Ros2Kind::kImu:
      return "imu";
    case Ros2Kind::kBattery:
      return "battery_state";
    case Ros2Kind::kFix:
      return "fix";
    case Ros2Kind::kNone:
      break;
  }
  return "";
}

ros2::Header Ros2Reading::header(SimTime stamp) {
  ros2::Header header{};
  header.stamp = ros2::time_of(stamp.ns);
  header.frame_id = frame_.data();
  return header;
}

ros2::LaserScan Ros2Reading::scan(const sim::SensorSample& sample) {
  const SensorInfo& info = *sample.info;
  const auto ranges = records_of<float>(sample);
  ranges_m_.assign(ranges.begin(), ranges.end());
  ros2::LaserScan message{};
  message.header = header({sample.header->stamp_ns});
  const double first = info.bearings_rad[0];
  const double last = info.bearings_rad[info.capacity - 1];
  message.angle_min = static_cast<float>(first);
  message.angle_max = static_cast<float>(last);
  if (info.capacity > 1) {
    // The interval between two rays, so one less than the number of rays.
    message.angle_increment = static_cast<float>((last - first) / (info.capacity - 1));
  }
  message.scan_time = static_cast<float>(info.period_s);
  message.range_min = static_cast<float>(info.range_min_m);
  message.range_max = static_cast<float>(info.range_max_m);
  bus::borrow(message.ranges, ranges_m_);
  return message;
}

ros2::Range Ros2Reading::range(const sim::SensorSample& sample) {
  const SensorInfo& info = *sample.info;
  ros2::Range message{};
  message.header = header({sample.header->stamp_ns});
  message.field_of_view = static_cast<float>(info.cone_rad);
  message.min_range = static_cast<float>(info.range_min_m);
  message.max_range = static_cast<float>(info.range_max_m);
  message.range = records_of<float>(sample).front();
  return message;
}

ros2::Odometry Ros2Reading::odometry(const OdometryReading& reading, SimTime stamp) {
  ros2::Odometry message{};
  message.header = header(stamp);
  message.child_frame_id = child_.data();
  message.pose.pose = ros2::spatial({reading.x_m, reading.y_m, reading.yaw_rad}, 0);
  // Row-major 6 x 6 of (x, y, z, roll, pitch, yaw). What is left at zero is not estimated: a robot
  // stays on the plane.
  message.pose.covariance[kXX] = reading.variance_xy_m2;
  message.pose.covariance[kYY] = reading.variance_xy_m2;
  message.pose.covariance[kYawYaw] = reading.variance_yaw_rad2;
  message.twist.twist.linear.x = reading.v_mps;
  message.twist.twist.angular.z = reading.w_radps;
  return message;
}

ros2::Imu Ros2Reading::imu(const sim::SensorSample& sample) {
  const auto values = records_of<double>(sample);
  ros2::Imu message{};
  message.header = header({sample.header->stamp_ns});
  message.orientation = {values[0], values[1], values[2], values[3]};
  message.angular_velocity = {values[4], values[5], values[6]};
  message.linear_acceleration = {values[7], values[8], values[9]};
  // By convention of sensor_msgs/Imu, -1 in the first element of a covariance marks a value that is
  // not measured.
  if (std::isnan(values[0])) message.orientation_covariance[0] = -1;
  if (std::isnan(values[4])) message.angular_velocity_covariance[0] = -1;
  if (std::isnan(values[7])) message.linear_acceleration_covariance[0] = -1;
  return message;
}

ros2::BatteryState Ros2Reading::battery(const sim::SensorSample& sample) {
  const auto values = records_of<double>(sample);
  ros2::BatteryState message{};
  message.header = header({sample.header->stamp_ns});
  message.percentage = static_cast<float>(values[0]);
  message.voltage = static_cast<float>(values[1]);
  message.current = static_cast<float>(values[2]);
  message.charge = static_cast<float>(values[3]);
  message.capacity = static_cast<float>(values[4]);
  message.temperature = static_cast<float>(values[5]);
  message.design_capacity = std::numeric_limits<float>::quiet_NaN();
  message.present = true;
  return message;
}

ros2::NavSatFix Ros2Reading::fix(const sim::SensorSample& sample, const GeoFrame& earth,
                                 const Pose2& X_WM) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  ros2::NavSatFix message{};
  message.header = header({sample.header->stamp_ns});
  message.status.service = kServiceGps;
  const auto readings = records_of<PoseReading>(sample);
  if (readings.empty()) {
    message.status.status = kNoFix;
    message.latitude = message.longitude = message.altitude = kUnknown;
    return message;
  }
  const PoseReading& reading = readings.back();
  const Vec2 p_W = transform(X_WM, {reading.x_m, reading.y_m});
  const GeoPoint place = earth.place({p_W.x, p_W.y, 0});
  message.latitude = place.latitude_deg;
  message.longitude = place.longitude_deg;
  message.altitude = place.altitude_m;
  // Robots stay on the plane, so the height gets the variance of the plane.
  for (const std::size_t axis : kEastNorthUp) {
    message.position_covariance[axis] = reading.variance_xy_m2;
  }
  message.position_covariance_type = kApproximated;
  return message;
}

std::string urdf_of(const world::Body& body, const sim::RobotType& type, std::string_view robot,
                    std::string_view prefix) {
  std::string urdf = fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", robot);
  urdf += fmt::format("  <link name=\"{}base_link\">\n", prefix);
  for (const world::Shape& shape : body.shapes) append_shape(shape, urdf);
  urdf += "  </link>\n";
  for (const sim::SensorSpec& sensor : type.sensors) {
    const std::string link = std::string(prefix) + ros2::word_of(sensor.name);
    urdf += fmt::format(
        "  <link name=\"{0}\"/>\n  <joint name=\"{0}_mount\" type=\"fixed\"><parent "
        "link=\"{1}base_link\"/><child link=\"{0}\"/><origin xyz=\"{2} {3} {4}\" rpy=\"0 0 "
        "{5}\"/></joint>\n",
        link, prefix, sensor.X_RS.x, sensor.X_RS.y, sensor.z_m, sensor.X_RS.yaw);
  }
  return urdf + "</robot>\n";
}

}  // namespace rave::runtime
