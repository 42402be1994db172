// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include "idl/ros2/nav_msgs.h"
#include "idl/ros2/rosgraph_msgs.h"
#include "idl/ros2/sensor_msgs.h"
#include "idl/ros2/tf2_msgs.h"

/// The messages of schemas/idl/ros2 under their ROS 2 names.
namespace rave::ros2 {

using Time = builtin_interfaces_msg_dds__Time_;
using Header = std_msgs_msg_dds__Header_;
using Vector3 = geometry_msgs_msg_dds__Vector3_;
using Point = geometry_msgs_msg_dds__Point_;
using Quaternion = geometry_msgs_msg_dds__Quaternion_;
using Pose = geometry_msgs_msg_dds__Pose_;
using TransformStamped = geometry_msgs_msg_dds__TransformStamped_;

// Messages that have topics.
using String = std_msgs_msg_dds__String_;
using PoseStamped = geometry_msgs_msg_dds__PoseStamped_;
using Twist = geometry_msgs_msg_dds__Twist_;
using TwistStamped = geometry_msgs_msg_dds__TwistStamped_;
using LaserScan = sensor_msgs_msg_dds__LaserScan_;
/// The format written since 2023. To read, use RangeReading, which accepts both formats.
using Range = sensor_msgs_msg_dds__Range_;
using RangeReading = sensor_msgs_msg_dds__RangeBefore2023_;
using Imu = sensor_msgs_msg_dds__Imu_;
using NavSatFix = sensor_msgs_msg_dds__NavSatFix_;
using BatteryState = sensor_msgs_msg_dds__BatteryState_;
using Odometry = nav_msgs_msg_dds__Odometry_;
using TfMessage = tf2_msgs_msg_dds__TFMessage_;
using Clock = rosgraph_msgs_msg_dds__Clock_;

/// The descriptor of a message type for Cyclone DDS.
template <class Message>
[[nodiscard]] dds_topic_descriptor_t descriptor_of();

template <>
inline dds_topic_descriptor_t descriptor_of<String>() {
  return std_msgs_msg_dds__String__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<PoseStamped>() {
  return geometry_msgs_msg_dds__PoseStamped__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<Twist>() {
  return geometry_msgs_msg_dds__Twist__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<TwistStamped>() {
  return geometry_msgs_msg_dds__TwistStamped__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<LaserScan>() {
  return sensor_msgs_msg_dds__LaserScan__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<Range>() {
  return sensor_msgs_msg_dds__Range__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<RangeReading>() {
  dds_topic_descriptor_t descriptor = sensor_msgs_msg_dds__RangeBefore2023__desc;
  descriptor.m_typename = sensor_msgs_msg_dds__Range__desc.m_typename;
  return descriptor;
}
template <>
inline dds_topic_descriptor_t descriptor_of<Imu>() {
  return sensor_msgs_msg_dds__Imu__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<NavSatFix>() {
  return sensor_msgs_msg_dds__NavSatFix__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<BatteryState>() {
  return sensor_msgs_msg_dds__BatteryState__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<Odometry>() {
  return nav_msgs_msg_dds__Odometry__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<TfMessage>() {
  return tf2_msgs_msg_dds__TFMessage__desc;
}
template <>
inline dds_topic_descriptor_t descriptor_of<Clock>() {
  return rosgraph_msgs_msg_dds__Clock__desc;
}

}  // namespace rave::ros2
