// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "line/byte_line.hpp"

namespace rave::line {

/// Where datagrams go: a numeric IPv4 or IPv6 address with its port.
struct Peer {
  sockaddr_storage address{};
  socklen_t size = 0;
  std::string text;  ///< As it was given.
};

/// Reads `host:port`, an IPv6 host in brackets; both numeric, so that nothing is looked up.
/// Error: kInvalidArgument.
[[nodiscard]] Result<Peer> parse_peer(std::string_view text);

/// Peers separated by blanks or commas; none is no error.
[[nodiscard]] Result<std::vector<Peer>> parse_peers(std::string_view text);

/// A bound UDP socket that does not block. Owns its descriptor. receive() belongs to one thread,
/// send() to another.
class DatagramSocket {
 public:
  /// `host`: a numeric address of this machine. `group`: a multicast group of the same family that
  /// is heard too, over the interface that has `host`; null for none. Its port is `port`.
  /// Errors: kInvalidArgument, kIo.
  [[nodiscard]] static Result<DatagramSocket> open(const std::string& host, std::uint16_t port,
                                                   const Peer* group);
  DatagramSocket(DatagramSocket&& other) noexcept;
  DatagramSocket& operator=(DatagramSocket&& other) noexcept;
  DatagramSocket(const DatagramSocket&) = delete;
  DatagramSocket& operator=(const DatagramSocket&) = delete;
  ~DatagramSocket();

  /// Takes the next datagram, cut off at the room there is; ends as ByteLine::read does.
  [[nodiscard]] ReadResult receive(std::span<std::byte> room, Wait limit,
                                   const Wake& wake) const noexcept;
  /// Error: kIo. That nobody listens there, or that the way is full, is none: datagrams get lost.
  [[nodiscard]] Status send(std::span<const std::byte> bytes, const Peer& to) const;
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }

 private:
  explicit DatagramSocket(int fd) : fd_(fd) {}

  int fd_;
  std::uint16_t port_ = 0;
};

}  // namespace rave::line
