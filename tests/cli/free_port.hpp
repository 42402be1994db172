// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>

namespace rave::cli_test {

/// A TCP port of the loopback that nobody has.
[[nodiscard]] inline std::uint16_t free_port() {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  static_cast<void>(::bind(file, reinterpret_cast<sockaddr*>(&address), size));
  static_cast<void>(::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size));
  ::close(file);
  return ntohs(address.sin_port);
}

}  // namespace rave::cli_test
