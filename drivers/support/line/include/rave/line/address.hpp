// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/plugin/params.hpp"

namespace rave::line {

/// The address of a byte stream: a serial device, or a TCP server.
struct Address {
  std::string device;  ///< Path; empty for TCP.
  std::int64_t baud = 0;
  std::string host;
  std::string port;  ///< Decimal.

  [[nodiscard]] bool is_serial() const noexcept { return !device.empty(); }
  /// The path, or `host:port`, for messages.
  [[nodiscard]] std::string text() const;
};

/// Makes an address from the parameters `device`, `baud` and `address` (`host:port`, an IPv6 host
/// in brackets). Errors (kInvalidArgument): both or none of device and address, an unsupported baud
/// rate, an invalid address.
[[nodiscard]] Result<Address> parse_address(std::string_view device, std::int64_t baud,
                                            std::string_view address);

/// The parameter `address` of drivers that also have `device`.
inline constexpr ParamSpec kAddressParam =
    text_param("address", "", "TCP server, `host:port`; or give `device`.");

/// Like parse_address(), for a driver with these three parameters.
[[nodiscard]] Result<Address> read_address(const Params& params);

/// The termios constant for a bit rate; 0 if there is none.
[[nodiscard]] unsigned speed_of(std::int64_t baud) noexcept;

/// A port number in decimal, 0 to 65535. Error: kInvalidArgument.
[[nodiscard]] Result<std::uint16_t> parse_port(std::string_view text);

}  // namespace rave::line
