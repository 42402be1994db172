// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// The Open Interface of iRobot's Create 2 and Roomba: commands to the robot, packets from it.
/// Source: iRobot, "Create 2 Open Interface (OI) Specification based on the iRobot Roomba 600",
/// 2016. Pure.
namespace rave::oi {

/// The modes of the robot.
enum class Mode : std::uint8_t { kOff = 0, kPassive = 1, kSafe = 2, kFull = 3 };

[[nodiscard]] std::string_view to_string(Mode mode) noexcept;

/// Packets that a host may request, by number.
enum class Packet : std::uint8_t {
  kBumpsAndDrops = 7,
  kCliffLeft = 9,
  kCliffFrontLeft = 10,
  kCliffFrontRight = 11,
  kCliffRight = 12,
  kChargingState = 21,
  kVoltage = 22,
  kCurrent = 23,
  kTemperature = 24,
  kBatteryCharge = 25,
  kBatteryCapacity = 26,
  kMode = 35,
  kLeftCounts = 43,
  kRightCounts = 44,
};

/// Size of the data of a packet or group (0 to 6, 7 to 58, 100, 101, 106, 107); 0: unknown.
[[nodiscard]] std::size_t packet_size(std::uint8_t id) noexcept;

inline constexpr std::int32_t kMaxWheel_mmps = 500;  ///< In either direction.
inline constexpr double kStreamPeriod_s = 0.015;
inline constexpr std::uint8_t kStreamHeader = 19;

[[nodiscard]] std::string start_command();  ///< Opens the interface; the mode becomes passive.
[[nodiscard]] std::string mode_command(Mode mode);  ///< Safe or full; other values give passive.
[[nodiscard]] std::string pause_stream_command();
[[nodiscard]] std::string stream_command(std::span<const std::uint8_t> packets);
/// Wheel speeds in mm/s, forward positive; clamped to the limit.
[[nodiscard]] std::string drive_direct_command(std::int32_t left_mmps, std::int32_t right_mmps);

}  // namespace rave::oi
