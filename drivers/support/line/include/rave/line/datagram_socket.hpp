// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/descriptor.hpp"
#include "rave/line/byte_line.hpp"

namespace rave::line {

/// The destination or sender of datagrams: a numeric IPv4 or IPv6 address with port.
struct Peer {
  sockaddr_storage address{};
  socklen_t size = 0;
  std::string text;  ///< As it was given, or `127.0.0.1:4711`.
};

/// Parses `host:port`, an IPv6 host in brackets; numeric only, without name resolution. Error:
/// kInvalidArgument.
[[nodiscard]] Result<Peer> parse_peer(std::string_view text);

/// Parses peers separated by blanks or commas; may be empty.
[[nodiscard]] Result<std::vector<Peer>> parse_peers(std::string_view text);

/// A bound non-blocking UDP socket. Owns its descriptor. receive() belongs to one thread, send() to
/// another.
class DatagramSocket {
 public:
  /// `host`: a numeric address of this machine. `group`: a multicast group of the same family to
  /// receive from as well, over the interface with address `host`; null for none. Its port is
  /// `port`. Errors: kInvalidArgument, kIo.
  [[nodiscard]] static Result<DatagramSocket> open(const std::string& host, std::uint16_t port,
                                                   const Peer* group);
  /// Receives the next datagram, truncated to the buffer; results as in ByteLine::read(). `from`,
  /// if given, becomes its sender.
  [[nodiscard]] ReadResult receive(std::span<std::byte> room, Wait limit, const Wake& wake,
                                   Peer* from = nullptr) const;
  /// Sends a datagram. Error: kIo. A missing receiver or a full buffer is no error: datagrams may
  /// be lost.
  [[nodiscard]] Status send(std::span<const std::byte> bytes, const Peer& to) const;
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }

 private:
  explicit DatagramSocket(int fd) : fd_(fd) {}

  Descriptor fd_;
  std::uint16_t port_ = 0;
};

}  // namespace rave::line
