// SPDX-License-Identifier: Apache-2.0
#include "ros2/listener.hpp"

#include <cmath>
#include <cstdio>

#include "ros2_messagesPubSubTypes.h"

namespace peer {

namespace dds = eprosima::fastdds::dds;
using namespace geometry_msgs::msg::dds_;  // NOLINT

namespace {

std::int64_t ns_of(const builtin_interfaces::msg::dds_::Time_& time) {
  return std::int64_t{time.sec()} * 1'000'000'000 + time.nanosec();
}

double yaw_of(const Quaternion_& q) { return 2 * std::atan2(q.z(), q.w()); }

template <class... Values>
std::string text(const char* format, Values... values) {
  char room[400];
  std::snprintf(room, sizeof room, format, values...);
  return room;
}

bool is_turn(const Quaternion_& q) {
  const double norm = q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w();
  return std::abs(norm - 1) < 1e-9;
}

}  // namespace

template <class Message, class PubSub>
void Ros2Listener::listen(const std::string& topic, const std::string& kind,
                          const Delivery& delivery) {
  auto ear = std::make_unique<Ear<Message>>([this, kind](const Message& message, const auto& from) {
    hear(kind, message);
    const std::lock_guard lock(mutex_);
    kinds_[kind].from.insert(digits_of(from));
  });
  (void)node_.reader(topic, dds::TypeSupport(new PubSub()), delivery, ear.get());
  ears_.push_back(std::move(ear));
}

Ros2Listener::Ros2Listener(const Arguments& given)
    : node_("listener", static_cast<std::uint32_t>(given.number("domain", 0)), &graph_),
      stamped_(given.number("stamped", 0) != 0) {
  const std::string robot = given.text("namespace", "/cart");
  const Delivery sensor{.reliable = false};
  const Delivery plain{.depth = 100};
  const Delivery kept{.keeps = true};
  using namespace sensor_msgs::msg::dds_;  // NOLINT
  listen<nav_msgs::msg::dds_::Odometry_, nav_msgs::msg::dds_::Odometry_PubSubType>(robot + "/odom",
                                                                                   "odom", plain);
  listen<LaserScan_, LaserScan_PubSubType>(robot + "/scan", "scan", sensor);
  listen<Range_, Range_PubSubType>(robot + "/range", "range", sensor);
  listen<NavSatFix_, NavSatFix_PubSubType>(robot + "/fix", "fix", sensor);
  listen<BatteryState_, BatteryState_PubSubType>(robot + "/battery_state", "battery", plain);
  listen<tf2_msgs::msg::dds_::TFMessage_, tf2_msgs::msg::dds_::TFMessage_PubSubType>("/tf", "tf",
                                                                                     plain);
  listen<tf2_msgs::msg::dds_::TFMessage_, tf2_msgs::msg::dds_::TFMessage_PubSubType>(
      "/tf_static", "tf_static", kept);
  listen<rosgraph_msgs::msg::dds_::Clock_, rosgraph_msgs::msg::dds_::Clock_PubSubType>(
      "/clock", "clock", sensor);
  listen<std_msgs::msg::dds_::String_, std_msgs::msg::dds_::String_PubSubType>(
      robot + "/robot_description", "description", kept);
  listen_to_nodes(given.number("gid-bytes", 16));
  drive_ =
      stamped_
          ? node_.writer(robot + "/cmd_vel", dds::TypeSupport(new TwistStamped_PubSubType()), plain)
          : node_.writer(robot + "/cmd_vel", dds::TypeSupport(new Twist_PubSubType()), plain);
  goal_ = node_.writer(robot + "/goal_pose", dds::TypeSupport(new PoseStamped_PubSubType()), plain);
}

void Ros2Listener::listen_to_nodes(double gid_bytes) {
  using namespace rmw_dds_common::msg::dds_;  // NOLINT
  const Delivery kept{.keeps = true, .depth = 100};
  const auto add = [&]<class Message, class PubSub>(Message* /*kind*/, PubSub* type) {
    auto ear = std::make_unique<Ear<Message>>(
        [this](const Message& message, const auto& /*from*/) { graph_.hear(message); });
    node_.raw_reader("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
                     dds::TypeSupport(type), kept, ear.get());
    ears_.push_back(std::move(ear));
  };
  if (gid_bytes == 24) {
    add(static_cast<ParticipantEntitiesInfoBefore2023_*>(nullptr),
        new ParticipantEntitiesInfoBefore2023_PubSubType());
  } else {
    add(static_cast<ParticipantEntitiesInfo_*>(nullptr), new ParticipantEntitiesInfo_PubSubType());
  }
}

void Ros2Listener::note(const std::string& kind, std::int64_t stamp_ns, bool good,
                        std::string said) {
  const std::lock_guard lock(mutex_);
  Kind& noted = kinds_[kind];
  ++noted.count;
  // Time never steps back within a topic.
  if (!good || stamp_ns < noted.newest_ns) ++noted.bad;
  noted.newest_ns = stamp_ns;
  noted.said = std::move(said);
}

void Ros2Listener::hear(const std::string& kind, const nav_msgs::msg::dds_::Odometry_& m) {
  const Pose_& pose = m.pose().pose();
  const bool good = is_turn(pose.orientation()) && !m.header().frame_id().empty() &&
                    !m.child_frame_id().empty() && std::isfinite(pose.position().x());
  note(kind, ns_of(m.header().stamp()), good,
       text("{\"x\":%.9f,\"y\":%.9f,\"yaw\":%.9f,\"v\":%.9f,\"frame\":\"%s\",\"child\":\"%s\"}",
            pose.position().x(), pose.position().y(), yaw_of(pose.orientation()),
            m.twist().twist().linear().x(), m.header().frame_id().c_str(),
            m.child_frame_id().c_str()));
}

void Ros2Listener::hear(const std::string& kind, const sensor_msgs::msg::dds_::LaserScan_& m) {
  bool good = !m.ranges().empty() && m.angle_max() > m.angle_min();
  const double expected = (m.angle_max() - m.angle_min()) / m.angle_increment() + 1;
  good = good && std::abs(expected - static_cast<double>(m.ranges().size())) < 0.5;
  float nearest = INFINITY;
  for (const float range : m.ranges()) {
    good = good && (range == INFINITY || (range >= 0 && range <= m.range_max()));
    nearest = std::fmin(nearest, range);
  }
  note(kind, ns_of(m.header().stamp()), good,
       text("{\"rays\":%zu,\"nearest\":%.6f,\"first\":%.6f,\"frame\":\"%s\"}", m.ranges().size(),
            std::isfinite(nearest) ? static_cast<double>(nearest) : -1.0,
            static_cast<double>(m.angle_min()), m.header().frame_id().c_str()));
}

void Ros2Listener::hear(const std::string& kind, const sensor_msgs::msg::dds_::Range_& m) {
  note(kind, ns_of(m.header().stamp()), m.field_of_view() > 0 && m.max_range() > m.min_range(),
       text("{\"range\":%.6f}", std::isfinite(m.range()) ? static_cast<double>(m.range()) : -1.0));
}

void Ros2Listener::hear(const std::string& kind, const sensor_msgs::msg::dds_::BatteryState_& m) {
  note(kind, ns_of(m.header().stamp()), m.present(),
       text("{\"percentage\":%.6f}", static_cast<double>(m.percentage())));
}

void Ros2Listener::hear(const std::string& kind, const sensor_msgs::msg::dds_::NavSatFix_& m) {
  const bool fixed = m.status().status() >= 0;
  const bool good = fixed ? std::abs(m.latitude()) <= 90 && std::abs(m.longitude()) <= 180 &&
                                m.position_covariance()[0] >= 0
                          : std::isnan(m.latitude());
  note(kind, ns_of(m.header().stamp()), good,
       text("{\"status\":%d,\"latitude\":%.12f,\"longitude\":%.12f,\"altitude\":%.6f,"
            "\"variance\":%.9f,\"frame\":\"%s\"}",
            int{m.status().status()}, fixed ? m.latitude() : 0.0, fixed ? m.longitude() : 0.0,
            fixed ? m.altitude() : 0.0, m.position_covariance()[0], m.header().frame_id().c_str()));
}

void Ros2Listener::hear(const std::string& kind, const tf2_msgs::msg::dds_::TFMessage_& m) {
  bool good = !m.transforms().empty();
  std::string frames;
  for (const TransformStamped_& each : m.transforms()) {
    good = good && is_turn(each.transform().rotation());
    frames += (frames.empty() ? "\"" : ",\"") + each.header().frame_id() + ">" +
              each.child_frame_id() + "\"";
  }
  const std::int64_t stamp = good ? ns_of(m.transforms().front().header().stamp()) : 0;
  note(kind, stamp, good, "[" + frames + "]");
}

void Ros2Listener::hear(const std::string& kind, const rosgraph_msgs::msg::dds_::Clock_& m) {
  note(kind, ns_of(m.clock()), true, text("%lld", static_cast<long long>(ns_of(m.clock()))));
}

void Ros2Listener::hear(const std::string& kind, const std_msgs::msg::dds_::String_& m) {
  note(kind, 0, m.data().rfind("<?xml", 0) == 0, text("%zu", m.data().size()));
}

void Ros2Listener::drive(double v_mps, double w_radps) {
  Twist_ twist;
  twist.linear().x(v_mps);
  twist.angular().z(w_radps);
  if (!stamped_) {
    drive_->write(&twist);
    return;
  }
  TwistStamped_ message;
  message.header().frame_id("base_link");
  message.twist(twist);
  drive_->write(&message);
}

void Ros2Listener::go_to(double x, double y) {
  PoseStamped_ message;
  message.header().frame_id("map");
  message.pose().position().x(x);
  message.pose().position().y(y);
  message.pose().orientation().w(1);
  goal_->write(&message);
}

std::string Ros2Listener::state() {
  const std::lock_guard lock(mutex_);
  std::string all = "{";
  for (const auto& [name, kind] : kinds_) {
    std::string from;
    for (const std::string& writer : kind.from)
      from += (from.empty() ? "\"" : ",\"") + writer + "\"";
    all += text("\"%s\":{\"count\":%lld,\"bad\":%lld,\"stamp_ns\":%lld,\"said\":", name.c_str(),
                static_cast<long long>(kind.count), static_cast<long long>(kind.bad),
                static_cast<long long>(kind.newest_ns)) +
           kind.said + ",\"from\":[" + from + "]},";
  }
  return all + graph_.json() + "}";
}

}  // namespace peer
