// SPDX-License-Identifier: Apache-2.0
#include "create_oi/oi_state.hpp"

namespace rave::oi {
namespace {

std::uint16_t word(std::span<const std::uint8_t> data) noexcept {
  // Big-endian.
  return static_cast<std::uint16_t>(unsigned{data[0]} << 8U | data[1]);
}

void read_packet(Packet packet, std::span<const std::uint8_t> data, OiState& state) noexcept {
  switch (packet) {
    case Packet::kBumpsAndDrops:
      state.bump_right = (data[0] & 1U) != 0;
      state.bump_left = (data[0] & 2U) != 0;
      state.drop_right = (data[0] & 4U) != 0;
      state.drop_left = (data[0] & 8U) != 0;
      break;
    case Packet::kCliffLeft:
      state.cliff_left = data[0] != 0;
      break;
    case Packet::kCliffFrontLeft:
      state.cliff_front_left = data[0] != 0;
      break;
    case Packet::kCliffFrontRight:
      state.cliff_front_right = data[0] != 0;
      break;
    case Packet::kCliffRight:
      state.cliff_right = data[0] != 0;
      break;
    case Packet::kChargingState:
      state.charging_state = data[0];
      break;
    case Packet::kVoltage:
      state.voltage_mv = word(data);
      break;
    case Packet::kCurrent:
      // Signed: negative while discharging.
      state.current_ma = static_cast<std::int16_t>(word(data));
      break;
    case Packet::kTemperature:
      state.temperature_c = static_cast<std::int8_t>(data[0]);
      break;
    case Packet::kBatteryCharge:
      state.charge_mah = word(data);
      break;
    case Packet::kBatteryCapacity:
      state.capacity_mah = word(data);
      break;
    case Packet::kMode:
      state.mode = static_cast<Mode>(data[0]);
      break;
    case Packet::kLeftCounts:
      state.left_counts = word(data);
      break;
    case Packet::kRightCounts:
      state.right_counts = word(data);
      break;
  }
}

}  // namespace

bool read_packets(std::span<const std::uint8_t> body, OiState& state) noexcept {
  while (!body.empty()) {
    const std::uint8_t id = body[0];
    const std::size_t size = packet_size(id);
    // An unknown packet has an unknown length, so nothing after it can be found.
    if (size == 0 || body.size() < 1 + size) return false;
    read_packet(static_cast<Packet>(id), body.subspan(1, size), state);
    body = body.subspan(1 + size);
  }
  return true;
}

}  // namespace rave::oi
