// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"

namespace rave::cli {

/// How a process of a shared run takes part in it, as the command line says.
struct BusOptions {
  std::string run;  ///< A name, or 32 hexadecimal digits; empty: that of the scenario.
  std::uint32_t domain = 0;
  std::string interface = "127.0.0.1";
  std::vector<std::string> peers;
  std::string multicast = "off";
  std::string security;   ///< A folder with certificates; empty: none.
  bool dds_only = false;  ///< No local transport between processes of one machine; to measure.
  std::string tag;        ///< Hides the run from processes with another one; for tests.

  /// Whether something says which bus, for people.
  [[nodiscard]] bool says_where() const;
};

/// `scenario` is the number of the scenario, from which the run's number is made if no run is
/// named. Errors: kInvalidArgument.
[[nodiscard]] Result<bus::BusConfig> bus_config(const BusOptions& options, std::string participant,
                                                std::uint64_t scenario);

/// The same, without a look at whether a bus can be made of it.
[[nodiscard]] Result<bus::BusConfig> read_bus_options(const BusOptions& options,
                                                      std::string participant,
                                                      std::uint64_t scenario);

/// As many processes as one command starts; who looks on may look for all of them.
inline constexpr std::size_t kMostHosts = 100;

/// Lets so many hosts find one another, or their manager, if all run on this machine. Each process
/// that there may be costs every other one a look now and then; of many, hosts look for their
/// manager alone. `reach`: what this process then is.
void make_room(bus::BusConfig& config, std::size_t hosts, bus::Reach reach = bus::Reach::kAll);

/// The same as words for the command line of another process of the run.
[[nodiscard]] std::vector<std::string> words_of(const BusOptions& options, const bus::RunId& run);

}  // namespace rave::cli
