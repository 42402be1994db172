// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace rave::carmen {

/// The two lasers of a robot for which CARMEN merges scans with poses.
enum class LaserSide : std::uint8_t { kFront, kRear };

/// What a scan message consists of, before the three words that end every message:
///   kOld    n r1 … rn, pose of the laser, pose of the robot
///   kRobot  type start_angle field_of_view angular_resolution maximum_range accuracy
///           remission_mode n r1 … rn m remission1 … m, pose of the laser, pose of the robot,
///           tv rv forward_safety_distance side_safety_distance turn_axis
///   kRaw    as kRobot up to the remissions
/// The header that the logger writes leaves out the remissions and turn_axis of kRobot; its own
/// readers expect both.
enum class ScanLayout : std::uint8_t { kOld, kRobot, kRaw };

struct ScanMessage {
  std::string_view name;
  LaserSide side = LaserSide::kFront;
  ScanLayout layout = ScanLayout::kOld;
};

inline constexpr std::array<ScanMessage, 6> kScanMessages{{
    {"FLASER", LaserSide::kFront, ScanLayout::kOld},
    {"ROBOTLASER1", LaserSide::kFront, ScanLayout::kRobot},
    {"RAWLASER1", LaserSide::kFront, ScanLayout::kRaw},
    {"RLASER", LaserSide::kRear, ScanLayout::kOld},
    {"ROBOTLASER2", LaserSide::kRear, ScanLayout::kRobot},
    {"RAWLASER2", LaserSide::kRear, ScanLayout::kRaw},
}};

/// The messages of the format; only others are mentioned to the user when they are not read.
inline constexpr std::array<std::string_view, 20> kKnownMessages{
    "FLASER",    "ODOM",      "PARAM",       "SYNC",        "RLASER",    "TRUEPOS",   "NEFF",
    "LASER3",    "LASER4",    "ROBOTLASER1", "ROBOTLASER2", "RAWLASER1", "RAWLASER2", "RAWLASER3",
    "RAWLASER4", "RAWLASER5", "BASEODOM",    "SIM_TRUE",    "NMEAGGA",   "NMEARMC"};

/// The scan message of this name, or null.
[[nodiscard]] inline const ScanMessage* scan_message(std::string_view name) noexcept {
  const auto* const found = std::ranges::find(kScanMessages, name, &ScanMessage::name);
  return found == kScanMessages.end() ? nullptr : found;
}

}  // namespace rave::carmen
