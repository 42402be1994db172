// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/plugin/params.hpp"
#include "rave/robot/hardware_sensor.hpp"

namespace rave::dds_transmitter {

/// The options that determine the air of a transmitter: those with equal options share one
/// participant.
struct AirOptions {
  std::string network;
  bus::RunId run;  ///< Derived from `network` unless given.
  std::uint32_t domain = 0;
  std::string interface;
  std::vector<std::string> peers;
  bus::Multicast multicast = bus::Multicast::kNone;
  std::string security;  ///< Folder with certificates; empty: none.
  std::size_t max_packet_bytes = 1400;
  std::size_t queue_bytes = 1'048'576;

  friend bool operator==(const AirOptions&, const AirOptions&) = default;
};

/// Reads the parameters of the driver. Error kParse: `run` is not a run id.
[[nodiscard]] Result<AirOptions> read_options(const HardwareSetup& setup);

/// The run id derived from the name of a network.
[[nodiscard]] bus::RunId run_of_network(std::string_view network);

/// The bus configuration for an air.
[[nodiscard]] bus::BusConfig bus_config(const AirOptions& options);

}  // namespace rave::dds_transmitter
