// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "create_oi/oi_state.hpp"

namespace rave::oi {

/// The state of the device's thread for the report. A plain value.
struct DeviceState {
  bool connected = false;
  std::uint64_t connects = 0;        ///< Number of times that the stream began, the first included.
  std::uint64_t frames = 0;          ///< Frames delivered.
  std::uint64_t bad_checksum = 0;    ///< Frames dropped.
  std::uint64_t bad_layout = 0;      ///< Frames dropped: packets differ from those requested.
  std::uint64_t skipped_bytes = 0;   ///< Bytes outside of frames.
  std::uint64_t missing_frames = 0;  ///< Frames missing according to the robot's clock.
  double period_ms = 0;              ///< Mean period of frames since the last connect.
  double clock_drift_ppm = 0;        ///< By how much the robot's clock runs faster than the host's.
  std::uint64_t drive_commands = 0;  ///< Sent, repetitions included.
  std::uint64_t watchdog_stops = 0;  ///< Stops because no command came for `watchdog_s`.
  std::uint64_t mode_losses = 0;     ///< Times that the robot left the commanded mode.
  OiState robot;
  std::string trouble;  ///< The last problem; empty if there was none.
};

/// One JSON object.
[[nodiscard]] std::string report_json(const std::string& where, const DeviceState& state);

}  // namespace rave::oi
