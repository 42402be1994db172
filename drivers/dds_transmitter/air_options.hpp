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

/// What decides which air a transmitter is in: those with the same options share one participant.
struct AirOptions {
  std::string network;
  bus::RunId run;  ///< Made of `network` unless one is given.
  std::uint32_t domain = 0;
  std::string interface;
  std::vector<std::string> peers;
  bus::Multicast multicast = bus::Multicast::kOff;
  std::string security;  ///< Folder with certificates; empty: none.
  std::size_t max_packet_bytes = 1400;
  std::size_t queue_bytes = 1'048'576;

  friend bool operator==(const AirOptions&, const AirOptions&) = default;
};

/// Reads the parameters of the driver. Error kParse: `run` is no number of a run.
[[nodiscard]] Result<AirOptions> read_options(const HardwareSetup& setup);

/// The run that all who know the name of a network share.
[[nodiscard]] bus::RunId run_of_network(std::string_view network);

/// How such an air is joined.
[[nodiscard]] bus::BusConfig bus_config(const AirOptions& options);

}  // namespace rave::dds_transmitter
