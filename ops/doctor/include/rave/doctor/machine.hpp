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
  std::string address;     ///< Empty: it has none.
  std::uint32_t mask = 0;  ///< Of its network, in host byte order.
  bool up = false;
  bool multicast = false;
  bool loopback = false;
};

/// What the checks want to know of a machine. A plain value, so that they can be tried on machines
/// that there are not.
struct Machine {
  std::string name;
  std::string kernel;  ///< Such as `6.1.0-13-amd64`.
  std::vector<Interface> interfaces;
  std::uint64_t open_files = 0;                     ///< That a process may have.
  std::optional<std::uint64_t> receive_buffer_max;  ///< Bytes; net.core.rmem_max.
  /// Ports that the kernel hands out to whoever asks for any.
  std::optional<std::uint32_t> first_handed_out, last_handed_out;
  std::string cyclone_uri;  ///< The variable CYCLONEDDS_URI; empty: not set.
  std::int64_t now_s = 0;   ///< Its clock of day, seconds since 1970.

  /// The interface that a name or an address stands for; none if there is no such.
  [[nodiscard]] const Interface* find(std::string_view interface) const noexcept;
  [[nodiscard]] bool has_address(std::string_view address) const noexcept;
};

/// This machine, now.
[[nodiscard]] Machine this_machine();

}  // namespace rave::doctor
