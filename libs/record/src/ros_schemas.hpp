// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

// Definitions of message types in MCAP's encoding `ros2msg`: the type, then each type it uses after
// a line of 80 equals signs. The fields of ROS 2 types are those of ROS 2 Humble
// (common_interfaces, geometry2, rcl_interfaces).
namespace rave::record {

struct RosSchema {
  std::string_view name;
  std::string_view text;
};

extern const RosSchema kRunSchema;
extern const RosSchema kEndSchema;
extern const RosSchema kPosesSchema;
extern const RosSchema kPerceptsSchema;
extern const RosSchema kCommandsSchema;
extern const RosSchema kActuatorsSchema;
extern const RosSchema kHashSchema;
extern const RosSchema kRadioSchema;
extern const RosSchema kEventSchema;
extern const RosSchema kInputSchema;
extern const RosSchema kChatSchema;
extern const RosSchema kShadowSchema;
extern const RosSchema kLogSchema;
extern const RosSchema kTfSchema;
extern const RosSchema kLaserScanSchema;
extern const RosSchema kTwistSchema;

}  // namespace rave::record
