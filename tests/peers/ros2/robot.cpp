// SPDX-License-Identifier: Apache-2.0
#include "ros2/robot.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "own_clock.hpp"
#include "ros2_messagesPubSubTypes.h"

namespace peer {

namespace dds = eprosima::fastdds::dds;
using namespace geometry_msgs::msg::dds_;  // NOLINT: half of what stands here is of it

namespace {

constexpr std::int64_t kTick_ns = 2'000'000;
constexpr double kRangeMin_m = 0.05;
constexpr double kRangeMax_m = 8;
constexpr double kLaserAhead_m = 0.05;

/// The stamp of a message: the wall's clock, as nodes of ROS 2 have it.
std::int64_t wall_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std_msgs::msg::dds_::Header_ header(std::int64_t stamp_ns, const char* frame) {
  std_msgs::msg::dds_::Header_ made;
  made.stamp().sec(static_cast<std::int32_t>(stamp_ns / 1'000'000'000));
  made.stamp().nanosec(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
  made.frame_id(frame);
  return made;
}

Quaternion_ turned(double yaw) {
  Quaternion_ made;
  made.z(std::sin(yaw / 2));
  made.w(std::cos(yaw / 2));
  return made;
}

Pose_ placed(double x, double y, double yaw) {
  Pose_ made;
  made.position().x(x);
  made.position().y(y);
  made.orientation(turned(yaw));
  return made;
}

TransformStamped_ transform(std::int64_t stamp_ns, const char* parent, const char* child, double x,
                            double y, double yaw) {
  TransformStamped_ made;
  made.header(header(stamp_ns, parent));
  made.child_frame_id(child);
  made.transform().translation().x(x);
  made.transform().translation().y(y);
  made.transform().rotation(turned(yaw));
  return made;
}

std::string within(const Arguments& given, const std::string& topic) {
  return given.text("namespace", "/cart") + "/" + topic;
}

}  // namespace

Ros2Robot::Ros2Robot(const Arguments& given)
    : plant_(given),
      random_(static_cast<std::uint64_t>(given.number("seed", 1))),
      watchdog_ns_(std::llround(given.number("watchdog-ms", 500) * 1e6)),
      rays_(parse_numbers(given.text("rays", "181"))),
      moved_ns_(true_ns()),
      plain_ear_([this](const Twist_& m, const auto& /*writer*/) {
        hear(m.linear().x(), m.angular().z());
      }),
      stamped_ear_([this](const TwistStamped_& m, const auto& /*writer*/) {
        hear(m.twist().linear().x(), m.twist().angular().z());
      }),
      node_("cart", static_cast<std::uint32_t>(given.number("domain", 0))) {
  start_ = {plant_.x(), plant_.y(), plant_.yaw()};
  const auto origin = given.numbers("origin", {47.3769, 8.5417, 408});
  std::copy(origin.begin(), origin.end(), origin_.begin());
  const Delivery plain;
  const Delivery sensor{.reliable = given.number("reliable-sensors", 0) != 0};
  const auto type = [](auto* made) { return dds::TypeSupport(made); };
  using namespace sensor_msgs::msg::dds_;  // NOLINT
  scan_ = node_.writer(within(given, "scan"), type(new LaserScan_PubSubType()), sensor);
  range_ = node_.writer(within(given, "range"), type(new Range_PubSubType()), sensor);
  imu_ = node_.writer(within(given, "imu"), type(new Imu_PubSubType()), sensor);
  battery_ =
      node_.writer(within(given, "battery_state"), type(new BatteryState_PubSubType()), plain);
  odometry_ = node_.writer(within(given, "odom"),
                           type(new nav_msgs::msg::dds_::Odometry_PubSubType()), plain);
  fix_ = node_.writer(within(given, "fix"), type(new NavSatFix_PubSubType()), sensor);
  pose_ = node_.writer(within(given, "pose"), type(new PoseStamped_PubSubType()), sensor);
  tf_ = node_.writer("/tf", type(new tf2_msgs::msg::dds_::TFMessage_PubSubType()), plain);
  // One that does not keep is what a reader of /tf_static cannot use.
  tf_static_ = node_.writer("/tf_static", type(new tf2_msgs::msg::dds_::TFMessage_PubSubType()),
                            {.keeps = given.number("forgets-static", 0) == 0, .depth = 1});
  if (given.number("stamped", 0) != 0) {
    (void)node_.reader(within(given, "cmd_vel"), type(new TwistStamped_PubSubType()), plain,
                       &stamped_ear_);
  } else {
    (void)node_.reader(within(given, "cmd_vel"), type(new Twist_PubSubType()), plain, &plain_ear_);
  }
  const auto period = [&](const char* option, double hz) {
    return std::llround(1e9 / given.number(option, hz));
  };
  tasks_ = {{{period("odom-hz", 50), moved_ns_, &Ros2Robot::write_odometry},
             {period("scan-hz", 10), moved_ns_, &Ros2Robot::write_scan},
             {period("range-hz", 10), moved_ns_, &Ros2Robot::write_range},
             {period("imu-hz", 50), moved_ns_, &Ros2Robot::write_imu},
             {period("battery-hz", 2), moved_ns_, &Ros2Robot::write_battery},
             {period("fix-hz", 10), moved_ns_, &Ros2Robot::write_fix},
             {period("pose-hz", 50), moved_ns_, &Ros2Robot::write_pose},
             {period("map-hz", 10), moved_ns_, &Ros2Robot::write_map}}};
  write_static(wall_ns());
}

void Ros2Robot::hear(double v_mps, double w_radps) {
  const std::lock_guard lock(mutex_);
  const bool good = std::isfinite(v_mps) && std::isfinite(w_radps);
  ++(good ? order_.count : order_.bad);
  if (!good) return;
  order_.v_mps = v_mps;
  order_.w_radps = w_radps;
  order_.at_ns = true_ns();
}

void Ros2Robot::move(std::int64_t now_ns) {
  Order order;
  {
    const std::lock_guard lock(mutex_);
    order = order_;
  }
  for (; moved_ns_ + kTick_ns <= now_ns; moved_ns_ += kTick_ns) {
    const bool wanted = order.v_mps != 0 || order.w_radps != 0;
    const bool late = watchdog_ns_ > 0 && moved_ns_ - order.at_ns > watchdog_ns_;
    if (moving_ && wanted && late) ++watchdog_stops_;
    moving_ = wanted && !late;
    const double v = moving_ ? order.v_mps : 0;
    const double turn = moving_ ? order.w_radps * Plant::kWheelBase_m / 2 : 0;
    plant_.advance(static_cast<double>(kTick_ns) * 1e-9, v - turn, v + turn, random_);
    farthest_x_ = std::max(farthest_x_, plant_.x());
  }
}

std::int64_t Ros2Robot::attend() {
  const std::int64_t now_ns = true_ns();
  // After a long pause of this process it does not make up for all of it.
  moved_ns_ = std::max(moved_ns_, now_ns - 200'000'000);
  move(now_ns);
  std::int64_t next_ns = moved_ns_ + kTick_ns;
  for (Task& task : tasks_) {
    if (now_ns >= task.due_ns) {
      if (!mute_) (this->*task.write)(wall_ns());
      task.due_ns = std::max(task.due_ns + task.period_ns, now_ns - task.period_ns);
    }
    next_ns = std::min(next_ns, task.due_ns);
  }
  return next_ns;
}

void Ros2Robot::write_odometry(std::int64_t stamp_ns) {
  if (wheels_ == Wheels::kSilent) return;
  ++written_;
  nav_msgs::msg::dds_::Odometry_ message;
  message.header(header(stamp_ns, "odom"));
  message.child_frame_id("base_link");
  // As its wheels have it: from where it began.
  const double dx = plant_.x() - start_[0];
  const double dy = plant_.y() - start_[1];
  const double c = std::cos(start_[2]);
  const double s = std::sin(start_[2]);
  double x = c * dx + s * dy;
  const double y = c * dy - s * dx;
  const double yaw = std::remainder(plant_.yaw() - start_[2], 2 * std::numbers::pi);
  double v = (plant_.left().speed_mps + plant_.right().speed_mps) / 2;
  const double w = (plant_.right().speed_mps - plant_.left().speed_mps) / Plant::kWheelBase_m;
  if (pattern_) {
    x = static_cast<double>(written_) * 1e-3;
    v = x / 2;
  }
  if (wheels_ == Wheels::kNan) x = std::numeric_limits<double>::quiet_NaN();
  message.pose().pose(placed(x, pattern_ ? -x : y, yaw));
  message.pose().covariance()[0] = 1e-4;
  message.pose().covariance()[7] = 1e-4;
  message.pose().covariance()[35] = 1e-5;
  message.twist().twist().linear().x(v);
  message.twist().twist().angular().z(w);
  odometry_->write(&message);
  tf2_msgs::msg::dds_::TFMessage_ tf;
  tf.transforms().push_back(transform(stamp_ns, "odom", "base_footprint", x, y, yaw));
  tf_->write(&tf);
}

sensor_msgs::msg::dds_::LaserScan_ Ros2Robot::scan(std::int64_t stamp_ns) const {
  sensor_msgs::msg::dds_::LaserScan_ message;
  message.header(header(stamp_ns, "laser"));
  const double field = std::numbers::pi;
  const auto rays = static_cast<std::size_t>(rays_[scans_ % rays_.size()]);
  const double step = field / static_cast<double>(rays - 1);
  message.angle_min(static_cast<float>(-field / 2));
  message.angle_max(static_cast<float>(field / 2));
  message.angle_increment(static_cast<float>(step));
  message.scan_time(0.1F);
  message.range_min(static_cast<float>(kRangeMin_m));
  message.range_max(static_cast<float>(kRangeMax_m));
  const double x = plant_.x() + kLaserAhead_m * std::cos(plant_.yaw());
  const double y = plant_.y() + kLaserAhead_m * std::sin(plant_.yaw());
  for (std::size_t i = 0; i < rays; ++i) {
    const auto place = static_cast<double>(i);
    double range = plant_.room().distance(x, y, plant_.yaw() - field / 2 + step * place);
    if (range > kRangeMax_m) range = std::numeric_limits<double>::infinity();
    if (pattern_) range = 1 + static_cast<double>(written_ % 1000) * 1e-3 + place * 1e-3;
    message.ranges().push_back(static_cast<float>(range));
    message.intensities().push_back(static_cast<float>(i));
  }
  return message;
}

void Ros2Robot::write_scan(std::int64_t stamp_ns) {
  if (laser_ == Laser::kSilent) return;
  ++written_;
  auto message = scan(stamp_ns);
  ++scans_;
  if (laser_ == Laser::kNegative) message.ranges().assign(message.ranges().size(), -1.0F);
  scan_->write(&message);
}

void Ros2Robot::write_range(std::int64_t stamp_ns) {
  ++written_;
  sensor_msgs::msg::dds_::Range_ message;
  message.header(header(stamp_ns, "sonar"));
  message.field_of_view(0.3F);
  message.min_range(0.02F);
  message.max_range(4);
  // Behind.
  const double range =
      plant_.room().distance(plant_.x(), plant_.y(), plant_.yaw() + std::numbers::pi);
  message.range(static_cast<float>(std::min(range, 1e9)));
  message.variance(1e-4F);
  range_->write(&message);
}

void Ros2Robot::write_imu(std::int64_t stamp_ns) {
  ++written_;
  sensor_msgs::msg::dds_::Imu_ message;
  message.header(header(stamp_ns, "imu"));
  message.orientation(turned(plant_.yaw()));
  message.angular_velocity().z((plant_.right().speed_mps - plant_.left().speed_mps) /
                               Plant::kWheelBase_m);
  message.linear_acceleration().z(9.81);
  imu_->write(&message);
}

void Ros2Robot::write_battery(std::int64_t stamp_ns) {
  ++written_;
  sensor_msgs::msg::dds_::BatteryState_ message;
  message.header(header(stamp_ns, "base_link"));
  message.voltage(14.5F);
  message.current(-0.75F);
  message.charge(1.5F);
  message.capacity(3);
  message.percentage(0.5F);
  message.temperature(std::numeric_limits<float>::quiet_NaN());
  message.present(true);
  message.cell_voltage() = {3.6F, 3.6F, 3.65F, 3.65F};
  message.serial_number("peer");
  battery_->write(&message);
}

void Ros2Robot::write_pose(std::int64_t stamp_ns) {
  ++written_;
  PoseStamped_ message;
  message.header(header(stamp_ns, "map"));
  message.pose(placed(plant_.x(), plant_.y(), plant_.yaw()));
  pose_->write(&message);
}

/// The radii of the earth's curvature say how many metres a degree has here; for a room that is
/// good to less than a millimetre.
void Ros2Robot::write_fix(std::int64_t stamp_ns) {
  ++written_;
  constexpr double kEquator_m = 6378137.0;
  constexpr double kEccentricity2 = 6.69437999014e-3;
  constexpr double kDegree = std::numbers::pi / 180;
  const double sine = std::sin(origin_[0] * kDegree);
  const double root = std::sqrt(1 - kEccentricity2 * sine * sine);
  const double meridian_m = kEquator_m * (1 - kEccentricity2) / (root * root * root) + origin_[2];
  const double circle_m = (kEquator_m / root + origin_[2]) * std::cos(origin_[0] * kDegree);
  sensor_msgs::msg::dds_::NavSatFix_ message;
  message.header(header(stamp_ns, "gps"));
  message.status().status(has_fix_ ? 0 : -1);
  message.status().service(1);
  message.latitude(has_fix_ ? origin_[0] + plant_.y() / meridian_m / kDegree : NAN);
  message.longitude(has_fix_ ? origin_[1] + plant_.x() / circle_m / kDegree : NAN);
  message.altitude(has_fix_ ? origin_[2] : NAN);
  message.position_covariance()[0] = 1e-4;
  message.position_covariance()[4] = 4e-4;
  message.position_covariance()[8] = 9e-4;
  message.position_covariance_type(2);
  fix_->write(&message);
}

/// What a localisation says: where the odometry began.
void Ros2Robot::write_map(std::int64_t stamp_ns) {
  tf2_msgs::msg::dds_::TFMessage_ message;
  message.transforms().push_back(
      transform(stamp_ns, "map", "odom", start_[0], start_[1], start_[2]));
  tf_->write(&message);
}

void Ros2Robot::write_static(std::int64_t stamp_ns) {
  tf2_msgs::msg::dds_::TFMessage_ message;
  message.transforms().push_back(transform(stamp_ns, "base_footprint", "base_link", 0, 0, 0));
  message.transforms().push_back(transform(stamp_ns, "base_link", "laser", kLaserAhead_m, 0, 0));
  tf_static_->write(&message);
}

void Ros2Robot::write_garbage(int count) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < count; ++i) {
    auto askew = scan(wall_ns());
    askew.angle_min(static_cast<float>(nan));
    scan_->write(&askew);
    auto shorter = scan(wall_ns());
    shorter.ranges().resize(3);
    scan_->write(&shorter);
    auto huge = scan(wall_ns());
    huge.ranges().assign(150'000, 1.0F);
    huge.intensities().clear();
    scan_->write(&huge);
    nav_msgs::msg::dds_::Odometry_ lost;
    lost.header(header(wall_ns(), "odom"));
    lost.pose().pose(placed(nan, 0, 0));
    odometry_->write(&lost);
    lost.pose().pose(placed(0, 0, 0));
    lost.pose().pose().orientation().w(0);
    odometry_->write(&lost);
  }
}

std::string Ros2Robot::state() {
  Order order;
  {
    const std::lock_guard lock(mutex_);
    order = order_;
  }
  char text[512];
  std::snprintf(text, sizeof text,
                "{\"x\":%.6f,\"y\":%.6f,\"yaw\":%.6f,\"left_mps\":%.6f,\"right_mps\":%.6f,"
                "\"commands\":%lld,\"bad_commands\":%lld,\"v_mps\":%.6f,\"w_radps\":%.6f,"
                "\"watchdog_stops\":%lld,\"touches\":%lld,\"written\":%lld,\"farthest_x\":%.6f}",
                plant_.x(), plant_.y(), plant_.yaw(), plant_.left().speed_mps,
                plant_.right().speed_mps, static_cast<long long>(order.count),
                static_cast<long long>(order.bad), order.v_mps, order.w_radps,
                static_cast<long long>(watchdog_stops_), static_cast<long long>(plant_.touches()),
                static_cast<long long>(written_), farthest_x_);
  return text;
}

}  // namespace peer
