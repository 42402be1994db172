// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/doctor/finding.hpp"
#include "rave/doctor/machine.hpp"

/// The checks of one machine; each may be called separately. Checks that take a Machine use nothing
/// else. `config` is the intended configuration of a process; it need not be valid.
namespace rave::doctor {

/// Whether the interface exists, is up, has an address, and can reach the peers.
[[nodiscard]] Finding check_interface(const Machine& machine, const bus::BusConfig& config);
/// Whether the kernel has pidfd_open (5.3), which RAVE needs.
[[nodiscard]] Finding check_kernel(const Machine& machine);
[[nodiscard]] Finding check_open_files(const Machine& machine);
/// Whether the socket buffer is large enough for the world message of many robots.
[[nodiscard]] Finding check_receive_buffer(const Machine& machine);
/// Whether the kernel may give ports of the domain to other programs.
[[nodiscard]] Finding check_domain(const Machine& machine, const bus::BusConfig& config);
/// The value of CYCLONEDDS_URI, and which programs use it.
[[nodiscard]] Finding check_cyclone_uri(const Machine& machine);
/// Whether the system clock is plausible.
[[nodiscard]] Finding check_clock(const Machine& machine);

/// Whether there are peers, and whether their names can be resolved. `addresses` receives the
/// resolved ones.
[[nodiscard]] Finding check_peers(const Machine& machine, const bus::BusConfig& config,
                                  std::vector<std::string>& addresses);
/// Whether there are free UDP ports for another process in the domain; binds and frees them.
[[nodiscard]] Finding check_ports(const bus::BusConfig& config);
/// Whether this machine receives packets that it sends to itself, at a port of the domain; sends
/// real packets. If not, a DDS process can neither discover its neighbours nor end.
[[nodiscard]] Finding check_own_way(const Machine& machine, const bus::BusConfig& config);
/// Whether multicast packets to the DDS group are received on the interface; sends real packets.
[[nodiscard]] Finding check_multicast(const Machine& machine, const bus::BusConfig& config);
/// Whether the certificates of a member are valid at `now_s`.
[[nodiscard]] Finding check_keys(const std::filesystem::path& folder, std::int64_t now_s);

}  // namespace rave::doctor
