// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/doctor/finding.hpp"
#include "rave/doctor/machine.hpp"

/// The checks of one machine; each may be called alone. Those that take a Machine look at nothing
/// else. `config` is how a process would take part; it need not be valid.
namespace rave::doctor {

/// Whether the interface is there, up, has an address, and leads to the peers at all.
[[nodiscard]] Finding check_interface(const Machine& machine, const bus::BusConfig& config);
/// Whether the kernel is as new as RAVE needs it (5.3, for pidfd_open).
[[nodiscard]] Finding check_kernel(const Machine& machine);
[[nodiscard]] Finding check_open_files(const Machine& machine);
/// Whether a world of many robots fits into the buffer of a socket.
[[nodiscard]] Finding check_receive_buffer(const Machine& machine);
/// Whether the kernel hands ports of the domain to others.
[[nodiscard]] Finding check_domain(const Machine& machine, const bus::BusConfig& config);
/// What CYCLONEDDS_URI says, and for whom that counts.
[[nodiscard]] Finding check_cyclone_uri(const Machine& machine);
/// Whether the clock of day can be right at all.
[[nodiscard]] Finding check_clock(const Machine& machine);

/// Addresses of the peers: what cannot be found, and whether there are any. `addresses` gets those
/// that could.
[[nodiscard]] Finding check_peers(const Machine& machine, const bus::BusConfig& config,
                                  std::vector<std::string>& addresses);
/// Whether there are UDP ports left for another process in the domain; binds and frees them.
[[nodiscard]] Finding check_ports(const bus::BusConfig& config);
/// Whether what this machine sends to a port of the domain of its own arrives: real packets. Where
/// it does not, a process of DDS can neither find its neighbours nor end.
[[nodiscard]] Finding check_own_way(const Machine& machine, const bus::BusConfig& config);
/// Whether what is sent to the group of DDS comes back on the interface: real packets.
[[nodiscard]] Finding check_multicast(const Machine& machine, const bus::BusConfig& config);
/// Whether the certificates of a member can be used at `now_s`.
[[nodiscard]] Finding check_keys(const std::filesystem::path& folder, std::int64_t now_s);

}  // namespace rave::doctor
