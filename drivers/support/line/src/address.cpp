// SPDX-License-Identifier: Apache-2.0
#include "rave/line/address.hpp"

#include <termios.h>

#include <array>
#include <charconv>
#include <utility>

namespace rave::line {
namespace {

// termios has a constant for each rate, whose value need not be the rate.
constexpr std::array<std::pair<std::int64_t, unsigned>, 13> kSpeeds{{{1200, B1200},
                                                                     {2400, B2400},
                                                                     {4800, B4800},
                                                                     {9600, B9600},
                                                                     {19200, B19200},
                                                                     {38400, B38400},
                                                                     {57600, B57600},
                                                                     {115200, B115200},
                                                                     {230400, B230400},
                                                                     {460800, B460800},
                                                                     {500000, B500000},
                                                                     {921600, B921600},
                                                                     {1000000, B1000000}}};

Result<Address> tcp_address(std::string_view text) {
  // The last colon: an IPv6 address contains colons itself and stands in brackets.
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0) {
    return fail(ErrorCode::kInvalidArgument, "`address` must be `host:port`, not `{}`", text);
  }
  std::string_view host = text.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  RAVE_TRY_ASSIGN(const std::uint16_t port, parse_port(text.substr(colon + 1)));
  if (host.empty() || port == 0) {
    return fail(ErrorCode::kInvalidArgument, "`address` must be `host:port`, not `{}`", text);
  }
  Address address;
  address.host = host;
  address.port = std::to_string(port);
  return address;
}

}  // namespace

std::string Address::text() const { return is_serial() ? device : host + ":" + port; }

unsigned speed_of(std::int64_t baud) noexcept {
  for (const auto& [rate, speed] : kSpeeds) {
    if (rate == baud) return speed;
  }
  return 0;
}

Result<std::uint16_t> parse_port(std::string_view text) {
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, port);
  if (error != std::errc() || stop != end) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not a port; expected 0 to 65535", text);
  }
  return port;
}

Result<Address> parse_address(std::string_view device, std::int64_t baud,
                              std::string_view address) {
  // Exactly one of the two: a default would connect to some device silently.
  if (device.empty() == address.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "give exactly one of `device` (a serial line) and `address` (host:port){}",
                device.empty() ? "; there is none" : "; there are both");
  }
  if (device.empty()) return tcp_address(address);
  if (speed_of(baud) == 0) {
    std::string known;
    for (const auto& [rate, speed] : kSpeeds) known += fmt::format(" {}", rate);
    return fail(ErrorCode::kInvalidArgument, "no serial line has {} baud; there are{}", baud,
                known);
  }
  Address serial;
  serial.device = device;
  serial.baud = baud;
  return serial;
}

Result<Address> read_address(const Params& params) {
  return parse_address(params.text("device"), params.integer("baud"), params.text("address"));
}

}  // namespace rave::line
