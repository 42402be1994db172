// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// The UDP ports of DDS: DDSI-RTPS 2.2 (OMG formal/2014-09-01), section 9.6.1.1, with its default
/// numbers PB = 7400, DG = 250, PG = 2, d0 = 0, d1 = 10, d2 = 1, d3 = 11. A domain has 250 ports.
/// DDS never uses those from 2 to 9; the doctor uses two of them, so that a firewall that permits a
/// domain also permits the doctor.
namespace rave::doctor {

inline constexpr std::uint32_t kMostDomain = 230;
/// The default multicast group for discovery (section 9.6.1.4.1).
inline constexpr const char* kMulticastGroup = "239.255.0.1";

[[nodiscard]] constexpr std::uint16_t first_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(7400 + 250 * domain);
}
[[nodiscard]] constexpr std::uint16_t last_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 249);
}
/// The port for discovery by multicast, common to all participants.
[[nodiscard]] constexpr std::uint16_t multicast_port(std::uint32_t domain) noexcept {
  return first_port(domain);
}
/// The discovery port of the participant with this index on its machine, 0 to 119.
[[nodiscard]] constexpr std::uint16_t discovery_port(std::uint32_t domain, int index) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 10 + 2 * index);
}
/// The data port of that participant.
[[nodiscard]] constexpr std::uint16_t data_port(std::uint32_t domain, int index) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 11 + 2 * index);
}
/// The port at which a doctor listens, and the one from which it asks.
[[nodiscard]] constexpr std::uint16_t doctor_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 2);
}
[[nodiscard]] constexpr std::uint16_t asking_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 3);
}

}  // namespace rave::doctor
