// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/ros2/messages.hpp"

namespace rave::ros2 {

// ROS 2 defines no bounds. RAVE accepts messages up to these.
inline constexpr std::uint32_t kMostBeams = 100'000;
inline constexpr std::uint32_t kMostTransforms = 10'000;
inline constexpr std::uint32_t kMostCells = 1'000;
inline constexpr std::size_t kLongestFrame = 255;
inline constexpr std::size_t kLongestText = 1'000'000;
inline constexpr double kMostMetres = 1e7;
inline constexpr double kMostSpeed = 1e4;

/// Checks what any receiver can check: non-finite numbers where ROS 2 gives them no meaning;
/// numbers too large for any vehicle; quaternions of length 0; arrays that are too long or of
/// inconsistent length; frames with control characters. Infinite and NaN ranges are accepted as in
/// REP-117. Error kInvalidArgument with field and value. Pure; any thread.
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
