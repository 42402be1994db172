// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"

namespace rave::bus {

/// How a process takes part in a shared run, according to the command line.
struct BusOptions {
  std::string run;  ///< A name, or 32 hexadecimal digits; empty: that of the scenario.
  std::uint32_t domain = 0;
  std::string interface = "127.0.0.1";
  std::vector<std::string> peers;
  std::string multicast = "none";
  std::string security;   ///< A folder with certificates; empty: none.
  bool dds_only = false;  ///< No local transport between processes of one machine; to measure.
  std::string tag;        ///< Hides the run from processes with another one; for tests.

  /// Whether any option selects a bus.
  [[nodiscard]] bool says_where() const;
};

/// `scenario` is the number of the scenario, from which the run's number is made if no run is
/// named. Errors: kInvalidArgument.
[[nodiscard]] Result<BusConfig> bus_config(const BusOptions& options, std::string participant,
                                           std::uint64_t scenario);

/// The same, without checking that a bus can be opened with it.
[[nodiscard]] Result<BusConfig> read_bus_options(const BusOptions& options, std::string participant,
                                                 std::uint64_t scenario);

/// Largest number of hosts that one command starts; monitors search for as many.
inline constexpr std::size_t kMostHosts = 100;

/// Configures discovery for this number of hosts on this machine. Each possible process costs every
/// other one some traffic, so in large runs hosts search for their manager only. `reach`: the role
/// of this process.
void make_room(BusConfig& config, std::size_t hosts, Reach reach = Reach::kAll);

/// The same as words for the command line of another process of the run.
[[nodiscard]] std::vector<std::string> words_of(const BusOptions& options, const RunId& run);

}  // namespace rave::bus
