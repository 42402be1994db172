// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// Which UDP ports DDS uses: DDSI-RTPS 2.2 (OMG formal/2014-09-01), section 9.6.1.1, with its usual
/// numbers PB = 7400, DG = 250, PG = 2, d0 = 0, d1 = 10, d2 = 1, d3 = 11. A domain has 250 ports;
/// the ones from 2 to 9 are never used by DDS, and two of them belong to the doctor, so that a
/// firewall that lets a domain through lets the doctor through.
namespace rave::doctor {

inline constexpr std::uint32_t kMostDomain = 230;
/// The group at which DDS looks for others, unless it is told otherwise (section 9.6.1.4.1).
inline constexpr const char* kMulticastGroup = "239.255.0.1";

[[nodiscard]] constexpr std::uint16_t first_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(7400 + 250 * domain);
}
[[nodiscard]] constexpr std::uint16_t last_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 249);
}
/// Where all participants hear who is there, by multicast.
[[nodiscard]] constexpr std::uint16_t multicast_port(std::uint32_t domain) noexcept {
  return first_port(domain);
}
/// Where the participant of that index on its machine, 0 to 119, hears who is there.
[[nodiscard]] constexpr std::uint16_t discovery_port(std::uint32_t domain, int index) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 10 + 2 * index);
}
/// Where it gets its data.
[[nodiscard]] constexpr std::uint16_t data_port(std::uint32_t domain, int index) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 11 + 2 * index);
}
/// Where a doctor listens, and from where one asks.
[[nodiscard]] constexpr std::uint16_t doctor_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 2);
}
[[nodiscard]] constexpr std::uint16_t asking_port(std::uint32_t domain) noexcept {
  return static_cast<std::uint16_t>(first_port(domain) + 3);
}

}  // namespace rave::doctor
