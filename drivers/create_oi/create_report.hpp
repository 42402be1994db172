// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "create_oi/oi_state.hpp"

namespace rave::oi {

/// What the device's thread has seen, for the report. A plain value.
struct DeviceState {
  bool connected = false;
  std::uint64_t connects = 0;        ///< Times that the stream began, the first included.
  std::uint64_t frames = 0;          ///< Handed over.
  std::uint64_t bad_checksum = 0;    ///< Frames dropped.
  std::uint64_t bad_layout = 0;      ///< Frames dropped: other packets than were asked for.
  std::uint64_t skipped_bytes = 0;   ///< Of no frame.
  std::uint64_t missing_frames = 0;  ///< Should have come by the robot's clock and did not.
  double period_ms = 0;              ///< Mean time between frames since the last connect.
  double clock_drift_ppm = 0;        ///< How much faster the robot's clock runs than the host's.
  std::uint64_t drive_commands = 0;  ///< Sent, repetitions included.
  std::uint64_t watchdog_stops = 0;  ///< Nobody gave a command for `watchdog_s`.
  std::uint64_t mode_losses = 0;     ///< The robot left the mode in which it obeys.
  OiState robot;
  std::string trouble;  ///< The last one; empty if there was none.
};

/// One JSON object.
[[nodiscard]] std::string report_json(const std::string& where, const DeviceState& state);

}  // namespace rave::oi
