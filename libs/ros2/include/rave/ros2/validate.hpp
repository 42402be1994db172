// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/ros2/messages.hpp"

namespace rave::ros2 {

// ROS 2 bounds nothing; these are what RAVE accepts of others.
inline constexpr std::uint32_t kMostBeams = 100'000;
inline constexpr std::uint32_t kMostTransforms = 10'000;
inline constexpr std::uint32_t kMostCells = 1'000;
inline constexpr std::size_t kLongestFrame = 255;
inline constexpr std::size_t kLongestText = 1'000'000;
inline constexpr double kMostMetres = 1e7;
inline constexpr double kMostSpeed = 1e4;

/// What makes a message unusable whoever looks at it: numbers that are not finite where ROS 2 gives
/// that no meaning, or beyond any vehicle; quaternions without length; arrays that are too long or
/// do not fit together; frames with control characters. Infinite and missing ranges are as REP-117
/// has them, and pass. Error kInvalidArgument with field and value. Pure; any thread.
[[nodiscard]] Status validate(const String& message);
[[nodiscard]] Status validate(const PoseStamped& message);
[[nodiscard]] Status validate(const Twist& message);
[[nodiscard]] Status validate(const TwistStamped& message);
[[nodiscard]] Status validate(const LaserScan& message);
[[nodiscard]] Status validate(const Range& message);
[[nodiscard]] Status validate(const RangeReading& message);
[[nodiscard]] Status validate(const Imu& message);
[[nodiscard]] Status validate(const NavSatFix& message);
[[nodiscard]] Status validate(const BatteryState& message);
[[nodiscard]] Status validate(const Odometry& message);
[[nodiscard]] Status validate(const TfMessage& message);
[[nodiscard]] Status validate(const Clock& message);

}  // namespace rave::ros2
