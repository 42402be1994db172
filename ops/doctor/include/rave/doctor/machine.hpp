// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rave::doctor {

/// A network interface with an IPv4 address.
struct Interface {
  std::string name;
  std::string address;  ///< Empty: none.
  bool up = false;
  bool multicast = false;
  bool loopback = false;
};

/// The properties of a machine that the checks use. A plain value, so that tests can use invented
/// machines.
struct Machine {
  std::string name;
  std::string kernel;  ///< Kernel version, such as `6.1.0-13-amd64`.
  std::vector<Interface> interfaces;
  std::uint64_t open_files = 0;                     ///< Limit of open files per process.
  std::optional<std::uint64_t> receive_buffer_max;  ///< Bytes; net.core.rmem_max.
  /// The range of ports that the kernel assigns to sockets without a port.
  std::optional<std::uint32_t> first_handed_out, last_handed_out;
  std::string cyclone_uri;  ///< The environment variable CYCLONEDDS_URI; empty: not set.
  std::int64_t now_s = 0;   ///< The system clock, seconds since 1970.

  /// The interface with this name or address; null if there is none.
  [[nodiscard]] const Interface* find(std::string_view interface) const noexcept;
  [[nodiscard]] bool has_address(std::string_view address) const noexcept;
};

/// The present state of this machine.
[[nodiscard]] Machine this_machine();

}  // namespace rave::doctor
