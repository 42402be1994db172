// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "line/byte_line.hpp"

namespace rave::udp_pose {

/// A UDP socket that listens. Owns its descriptor. For one thread at a time.
class UdpSocket {
 public:
  /// `host`: a numeric address of this machine; 0.0.0.0 or :: for all. `port` 0: a free one.
  /// Errors: kInvalidArgument (no address), kIo.
  [[nodiscard]] static Result<UdpSocket> listen(const std::string& host, std::uint16_t port);
  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&& other) noexcept;
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  ~UdpSocket();

  /// Takes the next datagram, cut off at the room there is; ends as ByteLine::read does.
  [[nodiscard]] line::ReadResult receive(std::span<char> room, line::Wait limit,
                                         const line::Wake& wake) const noexcept;
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }

 private:
  UdpSocket(int fd, std::uint16_t port) : fd_(fd), port_(port) {}

  int fd_;
  std::uint16_t port_;
};

}  // namespace rave::udp_pose
