// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "create_oi/oi_code.hpp"

namespace rave::oi {

/// The last reported state of the robot, in units of the protocol.
struct OiState {
  bool bump_left = false;
  bool bump_right = false;
  bool drop_left = false;  ///< The wheel hangs in the air.
  bool drop_right = false;
  bool cliff_left = false;
  bool cliff_front_left = false;
  bool cliff_front_right = false;
  bool cliff_right = false;
  Mode mode = Mode::kOff;
  std::uint8_t charging_state = 0;
  std::uint16_t voltage_mv = 0;
  std::int16_t current_ma = 0;  ///< Negative: discharging.
  std::int8_t temperature_c = 0;
  std::uint16_t charge_mah = 0;
  std::uint16_t capacity_mah = 0;
  std::uint16_t left_counts = 0;  ///< Encoder counts; wraps around.
  std::uint16_t right_counts = 0;

  [[nodiscard]] bool any_drop() const noexcept { return drop_left || drop_right; }
  [[nodiscard]] bool any_cliff() const noexcept {
    return cliff_left || cliff_front_left || cliff_front_right || cliff_right;
  }
};

/// Decodes the packets of a frame (number and data of each) into a state; unknown packets are
/// skipped. False: the body ends within a packet or has one of unknown size; the state then has the
/// packets before.
bool read_packets(std::span<const std::uint8_t> body, OiState& state) noexcept;

}  // namespace rave::oi
